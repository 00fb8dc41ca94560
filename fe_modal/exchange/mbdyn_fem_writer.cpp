// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "fe_modal/exchange/mbdyn_fem.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Text of a matrix in rows of numbers.
std::string text_of(const MatrixXd& matrix) {
  std::string text;
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (Index column = 0; column < matrix.cols(); ++column)
      text += " " + exact_text(matrix(row, column));
    text += "\n";
  }
  return text;
}

std::string group(int number, const std::string& title) {
  return "** RECORD GROUP " + std::to_string(number) + ", " + title + "\n";
}

/// Matrices side by side, in the order of the reader: row by row over all of them.
template <class Matrix>
MatrixXd side_by_side(const std::vector<Matrix>& list, double factor) {
  MatrixXd all(3, static_cast<Index>(list.size()) * Matrix::ColsAtCompileTime);
  Index column = 0;
  for (const Matrix& each : list) {
    all.middleCols(column, each.cols()) = factor * each;
    column += each.cols();
  }
  return all;
}

void write_nodes(OutputFile& file, const ModalBody& body) {
  file.write(group(1, "HEADER") +
             "**   REVISION, NODES, NORMAL, ATTACHMENT, CONSTRAINT, REJECTED MODES\n   REV0 " +
             std::to_string(body.interfaces.size()) + " " + std::to_string(body.mode_count()) +
             " 0 0 0\n**\n");
  std::string labels;
  std::string names;
  for (std::size_t k = 1; k <= body.interfaces.size(); ++k) {
    labels += " " + std::to_string(k);
    names += "** INTERFACE " + std::to_string(k) + " " + body.interfaces[k - 1].name + "\n";
  }
  file.write(group(2, "FINITE ELEMENT NODE LIST") + labels + "\n**\n" + names);
  for (const Index axis : {0, 1, 2}) {
    file.write(
        group(5 + static_cast<int>(axis), std::string("NODAL ") + "XYZ"[axis] + " COORDINATES"));
    for (const Interface& each : body.interfaces)
      file.write(exact_text(each.position_m[axis]) + "\n");
    file.write("**\n");
  }
  file.write(group(8, "MODE SHAPES"));
  for (Index mode = 0; mode < body.mode_count(); ++mode) {
    file.write("**    NORMAL MODE SHAPE # " + std::to_string(mode + 1) + ": " +
               text_of_mode(body.modes[static_cast<std::size_t>(mode)]) + "\n");
    for (const Interface& each : body.interfaces) {
      Eigen::RowVectorXd motion(6);
      motion << each.translation.col(mode).transpose(), each.rotation.col(mode).transpose();
      file.write(text_of(motion));
    }
  }
  file.write("**\n");
}

void write_inertia(OutputFile& file, const InertiaInvariants& inertia) {
  const Eigen::Vector3d center = inertia.S1 / inertia.mass;
  const Eigen::Matrix3d J =
      inertia.J0 - inertia.mass * (center.squaredNorm() * Eigen::Matrix3d::Identity() -
                                   center * center.transpose());
  file.write(group(12, "RIGID BODY INERTIA MATRIX") + exact_text(inertia.mass) + "\n" +
             text_of(center.transpose()) + text_of(J) + "**\n");
  file.write(group(14, "INVARIANT 3") + text_of(inertia.S2) + "**\n");
  file.write(group(15, "INVARIANT 4") + text_of(inertia.N0) + "**\n");
  file.write(group(16, "INVARIANT 8") + text_of(side_by_side(inertia.G0, 1)) + "**\n");
  file.write(group(17, "INVARIANT 5") + text_of(side_by_side(inertia.N, 1)) + "**\n");
  // Invariant 9 is int rho ~psi_j ~psi_k.
  file.write(group(18, "INVARIANT 9") + text_of(side_by_side(inertia.G, -1)) + "**\n");
}

}  // namespace

void write_mbdyn_fem(const std::filesystem::path& path, const ModalBody& body) {
  OutputFile file(path);
  file.write("** MBDyn MODAL DATA FILE, by flexneck; SI units; " + body.boundary + "\n");
  write_nodes(file, body);
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  file.write(group(9, "MODAL MASS MATRIX") + text_of(body.invariants.Maa) + "**\n");
  file.write(group(10, "MODAL STIFFNESS MATRIX") +
             text_of(MatrixXd(omega.cwiseAbs2().asDiagonal())) + "**\n");
  write_inertia(file, body.invariants);
  file.write("** END OF FILE\n");
  file.commit();
}

}  // namespace flexneck::fe_modal
