// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <fmt/core.h>

#include "fe_modal/exchange/sid_fem.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

enum Structure { zero = 0, diagonal = 1, full = 3, unit = 4 };

/// A matrix that depends on the modal coordinates q: m0 + sum_k q_k m1[k].
struct Series {
  MatrixXd m0;
  std::vector<MatrixXd> m1 = {};
  Structure structure = full;
};

/// Text of a number with seventeen digits and the D of Fortran.
std::string text_of(double number) {
  std::string text = fmt::format("{:24.16E}", number);
  text[text.find('E')] = 'D';
  return text;
}

class Writer {
 public:
  Writer(const std::filesystem::path& path, Index modes) : file_(path), modes_(modes) {}

  void line(int indent, const std::string& text) {
    file_.write(std::string(static_cast<std::size_t>(indent), ' ') + text + "\n");
  }
  void key(int indent, const std::string& name, const std::string& value) {
    line(indent, fmt::format("{:<{}}= {}", name, 48 - indent, value));
  }
  void block(int indent, const std::string& name, const Series& series) {
    line(indent, name);
    number("order", static_cast<Index>(series.m1.empty() ? 0 : 1));
    number("nrow", series.m0.rows());
    number("ncol", series.m0.cols());
    number("nq", modes_);
    number("nqn", 0);
    number("structure", series.structure);
    for (Index i = 0; i < series.m0.rows(); ++i)
      for (Index j = 0; j < series.m0.cols(); ++j)
        if (series.structure == full || (series.structure == diagonal && i == j))
          entry(fmt::format("m0({:2},{:2})", i + 1, j + 1), series.m0(i, j));
    for (std::size_t k = 0; k < series.m1.size(); ++k)
      for (Index i = 0; i < series.m0.rows(); ++i)
        for (Index j = 0; j < series.m0.cols(); ++j)
          entry(fmt::format("m1({:2},{:2},{:2})", i + 1, k + 1, j + 1), series.m1[k](i, j));
    line(indent, "end " + name);
  }
  void commit() { file_.commit(); }

 private:
  void number(const std::string& name, Index value) { key(26, name, fmt::format("{:4}", value)); }
  /// Writes an entry; exact zeros are left out, as by other programs.
  void entry(const std::string& name, double value) {
    if (value != 0) key(26, name, text_of(value));
  }

  OutputFile file_;
  Index modes_;
};

/// Components of a symmetric matrix: xx, yy, zz, xy, xz, yz.
Eigen::VectorXd six_of(const Eigen::Matrix3d& J) {
  Eigen::VectorXd six(6);
  six << J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2);
  return six;
}

/// Factors of wx^2, wy^2, wz^2, wx wy, wy wz, wx wz in the sum w^T G w.
Eigen::RowVectorXd products_of(const Eigen::Matrix3d& G) {
  Eigen::RowVectorXd six(6);
  six << G(0, 0), G(1, 1), G(2, 2), G(0, 1) + G(1, 0), G(1, 2) + G(2, 1), G(0, 2) + G(2, 0);
  return six;
}

void write_node(Writer& file, std::size_t number, const Interface& node) {
  const Index m = node.translation.cols();
  Series origin{node.position_m};
  Series axes{Eigen::Matrix3d::Identity()};
  for (Index k = 0; k < m; ++k) {
    const Eigen::Vector3d turn = node.rotation.col(k);
    Eigen::Matrix3d skew;
    skew << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
    origin.m1.emplace_back(node.translation.col(k));
    axes.m1.emplace_back(skew);
  }
  file.key(16, "new node", fmt::format("{:7}", number));
  file.key(21, "rframe", "   body ref");
  file.block(21, "origin", origin);
  file.block(21, "phi", {node.translation});
  file.block(21, "psi", {node.rotation});
  file.block(21, "AP", axes);
  file.line(16, "end node");
}

void write_reference(Writer& file, const ModalBody& body) {
  file.line(11, "refmod");
  file.key(16, "mass", text_of(body.invariants.mass));
  file.key(16, "nelastq", fmt::format("{:5}", body.mode_count()));
  for (Index k = 0; k < body.mode_count(); ++k)
    file.key(16, fmt::format("ielastq ({:4})", k + 1),
             fmt::format("Eigen Mode {:4} : {:12.3f} Hz: {}", k + 1, body.frequencies_Hz[k],
                         text_of_mode(body.modes[static_cast<std::size_t>(k)])));
  file.line(11, "end refmod");
}

void write_inertia(Writer& file, const InertiaInvariants& inertia) {
  const Index m = inertia.Maa.rows();
  const auto G = [&](Index k, Index l) -> const Eigen::Matrix3d& {
    return inertia.G[static_cast<std::size_t>(k * m + l)];
  };
  const auto N = [&](Index k, Index l) -> const Eigen::Vector3d& {
    return inertia.N[static_cast<std::size_t>(k * m + l)];
  };
  const auto G0 = [&](Index l) -> const Eigen::Matrix3d& {
    return inertia.G0[static_cast<std::size_t>(l)];
  };
  Series center{inertia.S1};
  Series J{six_of(inertia.J0)};
  Series Cr{inertia.N0.transpose()};
  Series Gr{MatrixXd(3, 3 * m)};
  Series Ge{MatrixXd(m, 3 * m)};
  Series Oe{MatrixXd(m, 6)};
  for (Index l = 0; l < m; ++l) {
    Gr.m0.middleCols<3>(3 * l) = 2 * G0(l);
    Oe.m0.row(l) = -products_of(G0(l));
  }
  for (Index k = 0; k < m; ++k) {
    center.m1.emplace_back(inertia.S2.col(k));
    J.m1.emplace_back(six_of(G0(k) + G0(k).transpose()));
    MatrixXd cr(m, 3), gr(3, 3 * m), oe(m, 6);
    for (Index l = 0; l < m; ++l) {
      cr.row(l) = N(k, l).transpose();
      gr.middleCols<3>(3 * l) = 2 * G(k, l);
      oe.row(l) = -products_of(G(k, l));
      Ge.m0.block<1, 3>(l, 3 * k) = 2 * N(k, l).transpose();
    }
    Cr.m1.push_back(std::move(cr));
    Gr.m1.push_back(std::move(gr));
    Oe.m1.push_back(std::move(oe));
  }
  file.block(11, "mdCM", center);
  file.block(11, "J", J);
  file.block(11, "Ct", {inertia.S2.transpose()});
  file.block(11, "Cr", Cr);
  file.block(11, "Me", {inertia.Maa});
  file.block(11, "Gr", Gr);
  file.block(11, "Ge", Ge);
  file.block(11, "Oe", Oe);
}

}  // namespace

void write_sid_fem(const std::filesystem::path& path, const ModalBody& body) {
  const Index m = body.mode_count();
  Writer file(path, m);
  std::string names;
  for (std::size_t k = 0; k < body.interfaces.size(); ++k)
    names += fmt::format("; {} = {}", k + 1, body.interfaces[k].name);
  file.line(0, fmt::format("{:5} {:3}   :No. nodes, No. modes: by flexneck, SI units{}",
                           body.interfaces.size(), m, names));
  file.line(1, "part");
  file.key(6, "new modal", "");
  write_reference(file, body);
  file.line(11, "frame");
  for (std::size_t k = 0; k < body.interfaces.size(); ++k)
    write_node(file, k + 1, body.interfaces[k]);
  file.line(11, "end frame");
  write_inertia(file, body.invariants);
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  file.block(11, "ksigma", {MatrixXd::Zero(m, 1), {}, zero});
  file.block(11, "Ke", {omega.cwiseAbs2().asDiagonal(), {}, diagonal});
  file.block(11, "De", {MatrixXd::Zero(m, m), {}, zero});
  file.line(6, "end modal");
  file.line(1, "end part");
  file.commit();
}

}  // namespace flexneck::fe_modal
