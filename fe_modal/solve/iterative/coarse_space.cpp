// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/coarse_space.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/SparseCore>

#include "fe_modal/solve/iterative/interface_pieces.h"
#include "fe_modal/solve/iterative/submatrix.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// The upper half, by rows.
using Upper = Eigen::SparseMatrix<double, Eigen::RowMajor, PetscInt>;

std::unique_ptr<CholeskyFactor> factorise(Upper& matrix) {
  const auto size = static_cast<PetscInt>(matrix.rows());
  MatHandle handle;
  require(MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, size, size, matrix.outerIndexPtr(),
                                      matrix.innerIndexPtr(), matrix.valuePtr(), handle.out()),
          "making the coarse matrix");
  require(MatSetOption(handle.get(), MAT_SPD, PETSC_TRUE), "making the coarse matrix");
  return std::make_unique<CholeskyFactor>(handle.get(), 0);
}

Eigen::MatrixXf take(const Eigen::MatrixXf& field, const std::vector<std::int32_t>& nodes) {
  Eigen::MatrixXf result(3 * static_cast<Eigen::Index>(nodes.size()), field.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    result.middleRows<3>(static_cast<Eigen::Index>(3 * k)) = field.middleRows<3>(3 * nodes[k]);
  }
  return result;
}

void add(const Eigen::MatrixXf& part, const std::vector<std::int32_t>& nodes,
         Eigen::MatrixXf& field) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    field.middleRows<3>(3 * nodes[k]) += part.middleRows<3>(static_cast<Eigen::Index>(3 * k));
  }
}

}  // namespace

/// Makes the functions and C^T K C.
class CoarseSpace::Builder {
 public:
  Builder(const SymmetricMatrix& stiffness, const NodeGraph& graph, const NodeLists& subdomains,
          const Eigen::Matrix3Xd& positions_m)
      : stiffness_(stiffness),
        graph_(graph),
        interface_(interface_pieces(graph, subdomains)),
        place_in_piece_(interface_.piece_of.size()) {
    for (const std::vector<std::int32_t>& nodes : interface_.nodes) {
      pieces.push_back({nodes, rigid_motions(nodes, positions_m), size});
      size += pieces.back().motions.cols();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        place_in_piece_[static_cast<std::size_t>(nodes[k])] = static_cast<Eigen::Index>(k);
      }
    }
    for (const Piece& piece : pieces) couple_on_interface(piece);
    for (const std::vector<std::int32_t>& nodes : subdomains) follow_inside(nodes);
  }

  Upper matrix() const {
    Upper result(size, size);
    result.setFromTriplets(entries_.begin(), entries_.end());
    return result;
  }

  std::vector<Piece> pieces;
  std::vector<Inside> insides;
  Eigen::Index size = 0;

 private:
  std::int32_t piece_of(std::int32_t node) const {
    return interface_.piece_of[static_cast<std::size_t>(node)];
  }
  /// Motions of one node of a piece, (3, r).
  auto motions_of(std::int32_t node) const {
    return pieces[static_cast<std::size_t>(piece_of(node))].motions.middleRows<3>(
        3 * place_in_piece_[static_cast<std::size_t>(node)]);
  }

  void add_entry(Eigen::Index row, Eigen::Index column, double value) {
    if (row <= column) {
      entries_.emplace_back(static_cast<PetscInt>(row), static_cast<PetscInt>(column), value);
    }
  }

  /// What a piece takes to move while everything else stands still.
  void couple_on_interface(const Piece& piece) {
    std::map<std::int32_t, Eigen::MatrixXd> row;
    for (const std::int32_t node : piece.nodes) {
      for (const std::int32_t other : graph_.neighbours(node)) {
        const std::int32_t number = piece_of(other);
        if (number < 0) continue;
        const auto& motions = pieces[static_cast<std::size_t>(number)];
        if (motions.first < piece.first) continue;
        Eigen::MatrixXd& block =
            row.try_emplace(number,
                            Eigen::MatrixXd::Zero(piece.motions.cols(), motions.motions.cols()))
                .first->second;
        block +=
            motions_of(node).transpose() * coupling(stiffness_, node, other) * motions_of(other);
      }
    }
    for (const auto& [number, block] : row) {
      const Eigen::Index first = pieces[static_cast<std::size_t>(number)].first;
      for (Eigen::Index i = 0; i < block.rows(); ++i) {
        for (Eigen::Index j = 0; j < block.cols(); ++j) {
          add_entry(piece.first + i, first + j, block(i, j));
        }
      }
    }
  }

  /// The functions that move the interface of a subdomain.
  std::vector<std::int32_t> functions_around(const std::vector<std::int32_t>& nodes) const {
    std::vector<std::int32_t> functions;
    std::vector<std::int32_t> around;
    for (const std::int32_t node : nodes) {
      if (piece_of(node) >= 0) around.push_back(piece_of(node));
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const std::int32_t number : around) {
      const Piece& piece = pieces[static_cast<std::size_t>(number)];
      for (Eigen::Index k = 0; k < piece.motions.cols(); ++k) {
        functions.push_back(static_cast<std::int32_t>(piece.first + k));
      }
    }
    return functions;
  }

  void follow_inside(const std::vector<std::int32_t>& subdomain) {
    Inside inside;
    std::copy_if(subdomain.begin(), subdomain.end(), std::back_inserter(inside.nodes),
                 [&](std::int32_t node) { return piece_of(node) < 0; });
    inside.functions = functions_around(subdomain);
    if (inside.nodes.empty() || inside.functions.empty()) return;
    Eigen::MatrixXd forces =
        Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(inside.nodes.size()),
                              static_cast<Eigen::Index>(inside.functions.size()));
    for (std::size_t k = 0; k < inside.nodes.size(); ++k) {
      for (const std::int32_t other : graph_.neighbours(inside.nodes[k])) {
        if (piece_of(other) < 0) continue;
        const auto first =
            static_cast<std::int32_t>(pieces[static_cast<std::size_t>(piece_of(other))].first);
        const auto place =
            std::lower_bound(inside.functions.begin(), inside.functions.end(), first) -
            inside.functions.begin();
        const auto motions = motions_of(other);
        forces.block(static_cast<Eigen::Index>(3 * k), place, 3, motions.cols()) +=
            coupling(stiffness_, inside.nodes[k], other) * motions;
      }
    }
    const NodeGraph part = restrict_to(graph_, inside.nodes);
    const SymmetricMatrix matrix = principal_part(stiffness_, part, inside.nodes);
    const Eigen::MatrixXd motions =
        -CholeskyFactor(matrix.get(), 0, mesher::nested_dissection(part.offsets(), part.columns()))
             .solve(forces);
    const Eigen::MatrixXd relief = forces.transpose() * motions;
    for (Eigen::Index i = 0; i < relief.rows(); ++i) {
      for (Eigen::Index j = i; j < relief.cols(); ++j) {
        add_entry(inside.functions[static_cast<std::size_t>(i)],
                  inside.functions[static_cast<std::size_t>(j)], (relief(i, j) + relief(j, i)) / 2);
      }
    }
    inside.motions = motions.cast<float>();
    insides.push_back(std::move(inside));
  }

  const SymmetricMatrix& stiffness_;
  const NodeGraph& graph_;
  InterfacePieces interface_;
  std::vector<Eigen::Index> place_in_piece_;
  std::vector<Eigen::Triplet<double, PetscInt>> entries_;
};

CoarseSpace::CoarseSpace(const SymmetricMatrix& stiffness, const NodeGraph& graph,
                         const NodeLists& subdomains, const Eigen::Matrix3Xd& positions_m) {
  Builder builder(stiffness, graph, subdomains, positions_m);
  pieces_ = std::move(builder.pieces);
  insides_ = std::move(builder.insides);
  size_ = builder.size;
  if (size_ == 0) return;
  Upper matrix = builder.matrix();
  factor_ = factorise(matrix);
}

void CoarseSpace::add_correction(const Eigen::MatrixXf& residuals, Eigen::MatrixXf& result) const {
  if (size_ == 0) return;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(size_, residuals.cols());
  for (const Piece& piece : pieces_) {
    loads.middleRows(piece.first, piece.motions.cols()) +=
        piece.motions.transpose() * take(residuals, piece.nodes).cast<double>();
  }
  for (const Inside& inside : insides_) {
    const Eigen::MatrixXf own = inside.motions.transpose() * take(residuals, inside.nodes);
    loads(inside.functions, Eigen::all) += own.cast<double>();
  }
  const Eigen::MatrixXd shares = factor_->solve(loads);
  for (const Piece& piece : pieces_) {
    const Eigen::MatrixXd motion =
        piece.motions * shares.middleRows(piece.first, piece.motions.cols());
    add(motion.cast<float>(), piece.nodes, result);
  }
  for (const Inside& inside : insides_) {
    const Eigen::MatrixXf own = shares(inside.functions, Eigen::all).cast<float>();
    add(inside.motions * own, inside.nodes, result);
  }
}

}  // namespace flexneck::fe_modal
