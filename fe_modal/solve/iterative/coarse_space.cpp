// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/coarse_space.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/SparseCore>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/solve/iterative/interface_pieces.h"
#include "fe_modal/solve/iterative/submatrix.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// The upper half, by rows.
using Upper = Eigen::SparseMatrix<double, Eigen::RowMajor, PetscInt>;

/// An entry of C^T K C in its upper half.
struct CoarseEntry {
  PetscInt row_;
  PetscInt column_;
  double value_;

  PetscInt row() const { return row_; }
  PetscInt col() const { return column_; }
  double value() const { return value_; }
};

/// Those of all ranks, on each. Collective.
std::vector<CoarseEntry> all_entries(const Ranks& ranks, const std::vector<CoarseEntry>& own) {
  if (!ranks.are_many()) return own;
  const MPI_Comm communicator = fe_modal::communicator(ranks);
  const int bytes = static_cast<int>(own.size() * sizeof(CoarseEntry));
  std::vector<int> counts(static_cast<std::size_t>(ranks.count()));
  require_mpi(MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator));
  std::vector<int> offsets(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), offsets.begin() + 1);
  std::vector<CoarseEntry> all(static_cast<std::size_t>(offsets.back()) / sizeof(CoarseEntry));
  require_mpi(MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), counts.data(), offsets.data(),
                             MPI_BYTE, communicator));
  return all;
}

std::unique_ptr<CholeskyFactor> factorise(const std::vector<CoarseEntry>& entries,
                                          Eigen::Index count) {
  Upper matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const auto size = static_cast<PetscInt>(count);
  MatHandle handle;
  require(MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, size, size, matrix.outerIndexPtr(),
                                      matrix.innerIndexPtr(), matrix.valuePtr(), handle.out()),
          "making the coarse matrix");
  require(MatSetOption(handle.get(), MAT_SPD, PETSC_TRUE), "making the coarse matrix");
  return std::make_unique<CholeskyFactor>(handle.get(), 0);
}

Eigen::MatrixXf take(const Eigen::MatrixXf& field, const std::vector<std::int32_t>& places) {
  Eigen::MatrixXf result(3 * static_cast<Eigen::Index>(places.size()), field.cols());
  for (std::size_t k = 0; k < places.size(); ++k) {
    result.middleRows<3>(static_cast<Eigen::Index>(3 * k)) = field.middleRows<3>(3 * places[k]);
  }
  return result;
}

void add(const Eigen::MatrixXf& part, const std::vector<std::int32_t>& places,
         Eigen::MatrixXf& field) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    field.middleRows<3>(3 * places[k]) += part.middleRows<3>(static_cast<Eigen::Index>(3 * k));
  }
}

}  // namespace

/// Makes the functions and C^T K C. Of the pieces of the interface that this rank's elements meet
/// all blocks are in its part.
class CoarseSpace::Builder {
 public:
  Builder(const CutBody& body, const PartMatrix& part)
      : layout_(body.fields.layout()),
        stiffness_(part.matrix),
        graph_(part.graph),
        blocks_(part.blocks),
        piece_of_(part.blocks.size(), -1),
        place_in_piece_(part.blocks.size(), 0) {
    const DofMap& dof_map = body.fields.dof_map();
    const InterfacePieces interface = interface_pieces(body.mesh, dof_map, body.subdomains);
    const Eigen::MatrixXd rigid = rigid_motions(body.mesh, dof_map);
    for (const std::vector<std::int32_t>& blocks : interface.blocks) {
      pieces_.push_back({blocks, rigid_motions_of(blocks, rigid), size});
      size += pieces_.back().motions.cols();
    }
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const std::int32_t number = interface.piece_of[static_cast<std::size_t>(blocks_[k])];
      if (number < 0) continue;
      const std::vector<std::int32_t>& all = interface.blocks[static_cast<std::size_t>(number)];
      piece_of_[k] = number;
      place_in_piece_[k] = std::lower_bound(all.begin(), all.end(), blocks_[k]) - all.begin();
    }
    const NodeLists local = local_pieces();
    for (std::size_t p = 0; p < local.size(); ++p) couple_on_interface(p, local[p]);
    for (std::size_t s = 0; s < body.subdomains.blocks.size(); ++s) {
      if (body.rank_of_subdomain[s] == layout_.ranks().own())
        follow_inside(places_in(blocks_, body.subdomains.blocks[s]));
    }
  }

  /// C^T K C of this rank's elements.
  std::vector<CoarseEntry> entries;
  std::vector<Inside> insides;
  Eigen::Index size = 0;

  /// Those whose blocks this rank owns.
  std::vector<Piece> own_pieces() {
    std::vector<Piece> own;
    for (WholePiece& piece : pieces_) {
      if (layout_.owner(piece.blocks.front()) != layout_.ranks().own()) continue;
      own.push_back({places(piece.blocks), std::move(piece.motions), piece.first});
    }
    return own;
  }

 private:
  struct WholePiece {
    std::vector<std::int32_t> blocks;
    Eigen::MatrixXd motions;
    Eigen::Index first;
  };

  std::vector<std::int32_t> places(const std::vector<std::int32_t>& blocks) const {
    std::vector<std::int32_t> result;
    result.reserve(blocks.size());
    for (const std::int32_t block : blocks) result.push_back(layout_.place(block));
    return result;
  }
  /// Blocks of each piece in the part, none of those that it does not meet.
  NodeLists local_pieces() const {
    NodeLists result(pieces_.size());
    for (std::size_t k = 0; k < piece_of_.size(); ++k) {
      if (piece_of_[k] < 0) continue;
      result[static_cast<std::size_t>(piece_of_[k])].push_back(static_cast<std::int32_t>(k));
    }
    return result;
  }

  std::int32_t piece_of(std::int32_t node) const {
    return piece_of_[static_cast<std::size_t>(node)];
  }
  /// Motions of one block of a piece, (3, r).
  auto motions_of(std::int32_t node) const {
    return pieces_[static_cast<std::size_t>(piece_of(node))].motions.middleRows<3>(
        3 * place_in_piece_[static_cast<std::size_t>(node)]);
  }

  void add_entry(Eigen::Index row, Eigen::Index column, double value) {
    if (row <= column) {
      entries.push_back({static_cast<PetscInt>(row), static_cast<PetscInt>(column), value});
    }
  }

  /// What a piece takes to move while everything else stands still.
  void couple_on_interface(std::size_t p, const std::vector<std::int32_t>& local) {
    const WholePiece& piece = pieces_[p];
    std::map<std::int32_t, Eigen::MatrixXd> row;
    for (const std::int32_t node : local) {
      for (const std::int32_t other : graph_.neighbours(node)) {
        const std::int32_t number = piece_of(other);
        if (number < 0) continue;
        const auto& motions = pieces_[static_cast<std::size_t>(number)];
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
      const Eigen::Index first = pieces_[static_cast<std::size_t>(number)].first;
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
      const WholePiece& piece = pieces_[static_cast<std::size_t>(number)];
      for (Eigen::Index k = 0; k < piece.motions.cols(); ++k) {
        functions.push_back(static_cast<std::int32_t>(piece.first + k));
      }
    }
    return functions;
  }

  void follow_inside(const std::vector<std::int32_t>& subdomain) {
    Inside inside;
    std::vector<std::int32_t> nodes;
    std::copy_if(subdomain.begin(), subdomain.end(), std::back_inserter(nodes),
                 [&](std::int32_t node) { return piece_of(node) < 0; });
    inside.functions = functions_around(subdomain);
    if (nodes.empty() || inside.functions.empty()) return;
    for (const std::int32_t node : nodes) {
      inside.places.push_back(layout_.place(blocks_[static_cast<std::size_t>(node)]));
    }
    Eigen::MatrixXd forces =
        Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(nodes.size()),
                              static_cast<Eigen::Index>(inside.functions.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const std::int32_t other : graph_.neighbours(nodes[k])) {
        if (piece_of(other) < 0) continue;
        const auto first =
            static_cast<std::int32_t>(pieces_[static_cast<std::size_t>(piece_of(other))].first);
        const auto place =
            std::lower_bound(inside.functions.begin(), inside.functions.end(), first) -
            inside.functions.begin();
        const auto motions = motions_of(other);
        forces.block(static_cast<Eigen::Index>(3 * k), place, 3, motions.cols()) +=
            coupling(stiffness_, nodes[k], other) * motions;
      }
    }
    const NodeGraph part = restrict_to(graph_, nodes);
    const SymmetricMatrix matrix = principal_part(stiffness_, part, nodes);
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

  const DofLayout& layout_;
  const SymmetricMatrix& stiffness_;
  const NodeGraph& graph_;
  const std::vector<std::int32_t>& blocks_;
  std::vector<WholePiece> pieces_;      ///< of the body
  std::vector<std::int32_t> piece_of_;  ///< of each block of the part, -1 inside
  std::vector<Eigen::Index> place_in_piece_;
};

CoarseSpace::CoarseSpace(const CutBody& body, const PartMatrix& part)
    : ranks_(body.fields.ranks()) {
  std::optional<Builder> builder;
  ranks_.together([&] { builder.emplace(body, part); });
  size_ = builder->size;
  insides_ = std::move(builder->insides);
  if (size_ > 0) {
    const std::vector<CoarseEntry> entries = all_entries(ranks_, builder->entries);
    ranks_.together([&] { factor_ = factorise(entries, size_); });
  }
  pieces_ = builder->own_pieces();
}

void CoarseSpace::add_correction(const Eigen::MatrixXf& residuals, Eigen::MatrixXf& result) const {
  if (size_ == 0) return;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(size_, residuals.cols());
  for (const Piece& piece : pieces_) {
    loads.middleRows(piece.first, piece.motions.cols()) +=
        piece.motions.transpose() * take(residuals, piece.places).cast<double>();
  }
  for (const Inside& inside : insides_) {
    const Eigen::MatrixXf own = inside.motions.transpose() * take(residuals, inside.places);
    loads(inside.functions, Eigen::all) += own.cast<double>();
  }
  ranks_.sum(loads);
  const Eigen::MatrixXd shares = factor_->solve(loads);
  for (const Piece& piece : pieces_) {
    const Eigen::MatrixXd motion =
        piece.motions * shares.middleRows(piece.first, piece.motions.cols());
    add(motion.cast<float>(), piece.places, result);
  }
  for (const Inside& inside : insides_) {
    const Eigen::MatrixXf own = shares(inside.functions, Eigen::all).cast<float>();
    add(inside.motions * own, inside.places, result);
  }
}

}  // namespace flexneck::fe_modal
