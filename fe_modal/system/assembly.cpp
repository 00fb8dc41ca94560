// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/assembly.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/dofs/constrained_element.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/dofs/point_element.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/geometric_kernel.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMaking = "creating the system matrices";
constexpr const char* kAdding = "assembling the system matrices";

void finish(Mat matrix) {
  require(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY), kAdding);
  require(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY), kAdding);
}

/// Sparsity pattern of the rows: counts of entries for a matrix with `width` rows for each block.
class Sparsity {
 public:
  Sparsity(const NodeGraph& graph, const DofLayout& layout)
      : graph_(graph),
        layout_(layout),
        begin_(static_cast<std::int32_t>(layout.first_own_dof() / 3)),
        end_(begin_ + static_cast<std::int32_t>(layout.own_dof_count() / 3)) {
    if (9.0 * static_cast<double>(graph.columns().size()) >
        static_cast<double>(std::numeric_limits<PetscInt>::max()))
      throw InputError(
          "the stiffness matrix has more entries than the integers of PETSc can count; use a "
          "coarser mesh");
  }

  /// Makes a matrix of the upper half, three rows a block.
  MatHandle upper() const {
    std::vector<PetscInt> inside;
    std::vector<PetscInt> outside;
    for (std::int32_t block = begin_; block < end_; ++block) {
      const auto others = graph_.neighbours(block);
      const auto later = std::upper_bound(others.begin(), others.end(), block);
      const auto beyond = std::lower_bound(later, others.end(), end_);
      for (PetscInt a = 0; a < 3; ++a) {
        inside.push_back(3 - a + 3 * static_cast<PetscInt>(beyond - later));
        outside.push_back(3 * static_cast<PetscInt>(others.end() - beyond));
      }
    }
    MatHandle matrix = sized(MATSBAIJ, 3);
    require(MatSeqSBAIJSetPreallocation(matrix.get(), 1, 0, inside.data()), kMaking);
    require(MatMPISBAIJSetPreallocation(matrix.get(), 1, 0, inside.data(), 0, outside.data()),
            kMaking);
    require(MatSetOption(matrix.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE), kMaking);
    require(MatSetOption(matrix.get(), MAT_SPD, PETSC_TRUE), kMaking);
    // Every row has its diagonal, even if no stiffness acts on its degree of freedom.
    for (PetscInt row = 3 * begin_; row < 3 * end_; ++row)
      require(MatSetValue(matrix.get(), row, row, 0, ADD_VALUES), kAdding);
    return matrix;
  }

  /// Makes a matrix of all entries, one row a block.
  MatHandle nodal() const {
    std::vector<PetscInt> inside;
    std::vector<PetscInt> outside;
    for (std::int32_t block = begin_; block < end_; ++block) {
      const auto others = graph_.neighbours(block);
      const auto own = std::lower_bound(others.begin(), others.end(), begin_);
      const auto beyond = std::lower_bound(own, others.end(), end_);
      inside.push_back(static_cast<PetscInt>(beyond - own));
      outside.push_back(static_cast<PetscInt>(others.size()) - inside.back());
    }
    MatHandle matrix = sized(MATAIJ, 1);
    require(MatSeqAIJSetPreallocation(matrix.get(), 0, inside.data()), kMaking);
    require(MatMPIAIJSetPreallocation(matrix.get(), 0, inside.data(), 0, outside.data()), kMaking);
    require(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
    return matrix;
  }

 private:
  MatHandle sized(MatType type, PetscInt width) const {
    MatHandle matrix;
    const PetscInt rows = width * (end_ - begin_);
    const auto all = static_cast<PetscInt>(width * layout_.dof_count() / 3);
    require(MatCreate(communicator(layout_.ranks()), matrix.out()), kMaking);
    require(MatSetSizes(matrix.get(), rows, rows, all, all), kMaking);
    require(MatSetType(matrix.get(), type), kMaking);
    return matrix;
  }

  const NodeGraph& graph_;
  const DofLayout& layout_;
  std::int32_t begin_, end_;  ///< range of blocks of this rank
};

/// Adds element matrices to those of a body, with the element's nodes in ascending blocks: PETSc
/// then finds the places of a row's entries in sequence.
class Adder {
 public:
  /// @param blocks blocks of the element's nodes; negative: a node has none
  void set_nodes(std::span<const std::int32_t> blocks) {
    order_.clear();
    for (std::size_t i = 0; i < blocks.size(); ++i)
      if (blocks[i] >= 0) order_.push_back(static_cast<Eigen::Index>(i));
    const auto block = [&](Eigen::Index i) { return blocks[static_cast<std::size_t>(i)]; };
    std::sort(order_.begin(), order_.end(),
              [&](Eigen::Index one, Eigen::Index other) { return block(one) < block(other); });
    nodes_.clear();
    rows_.clear();
    for (const Eigen::Index i : order_) {
      nodes_.push_back(block(i));
      for (PetscInt a = 0; a < 3; ++a) rows_.push_back(3 * block(i) + a);
    }
  }

  /// Adds a matrix (3n, 3n) with degree of freedom a n + i.
  void add(const Eigen::MatrixXd& element, Mat matrix) {
    const Eigen::Index n = element.rows() / 3;
    places_.clear();
    for (const Eigen::Index i : order_)
      for (Eigen::Index a = 0; a < 3; ++a) places_.push_back(a * n + i);
    insert(element, rows_, matrix);
  }
  /// Adds a matrix (n, n) between nodes.
  void add_nodal(const Eigen::MatrixXd& element, Mat matrix) {
    places_.assign(order_.begin(), order_.end());
    insert(element, nodes_, matrix);
  }

 private:
  /// Inserts the columns of an element matrix as the rows that PETSc takes: it is symmetric.
  void insert(const Eigen::MatrixXd& element, const std::vector<PetscInt>& rows, Mat matrix) {
    values_ = element(places_, places_);
    const auto count = static_cast<PetscInt>(rows.size());
    require(
        MatSetValues(matrix, count, rows.data(), count, rows.data(), values_.data(), ADD_VALUES),
        kAdding);
  }

  std::vector<Eigen::Index> order_, places_;
  std::vector<PetscInt> nodes_, rows_;
  Eigen::MatrixXd values_;
};

/// Adds an element's mass, (n, n), to that of all nodes.
void add_to_all(std::span<const std::int32_t> nodes, const Eigen::MatrixXd& element,
                NodalMass& mass) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::int32_t* const first = mass.innerIndexPtr() + mass.outerIndexPtr()[nodes[i]];
    const std::int32_t* const last = mass.innerIndexPtr() + mass.outerIndexPtr()[nodes[i] + 1];
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const std::int32_t* const place = std::lower_bound(first, last, nodes[j]);
      mass.valuePtr()[place - mass.innerIndexPtr()] +=
          element(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

NodalMass zero_nodal_mass(const mesher::Mesh& mesh) {
  const NodeGraph graph(mesh);
  const auto n = static_cast<Eigen::Index>(graph.node_count());
  const std::vector<double> zeros(graph.columns().size(), 0.0);
  return Eigen::Map<const NodalMass>(n, n, static_cast<Eigen::Index>(zeros.size()),
                                     graph.offsets().data(), graph.columns().data(), zeros.data());
}

/// Input and distribution of the assembly of this rank's elements.
struct Task {
  const mesher::Mesh& mesh;
  const DofMap& dof_map;
  const FormulationChoice& formulation;
  const Eigen::Matrix3Xd& prestress_m;
  const DofLayout& layout;
  const std::vector<std::int32_t>& rank_of_element;

  bool has(std::size_t element) const {
    return rank_of_element.empty() || rank_of_element[element] == layout.ranks().own();
  }
};

/// Calls visit(block of the mesh, nodes, coordinates) for this rank's elements; messages of errors
/// name the element.
template <typename Visit>
void each_element(const Task& task, const Visit& visit) {
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : task.mesh.blocks) {
    auto visit_element = visit(block);
    const std::size_t width = mesher::nodes_per_element(block.kind);
    Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
    for (std::size_t e = 0; e < block.size(); ++e) {
      if (!task.has(element++)) continue;
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      mesher::copy_positions(task.mesh, nodes, coordinates);
      try {
        visit_element(nodes, coordinates);
      } catch (const ComputationError& error) {
        throw ComputationError("part '" + block.part + "', element " + std::to_string(e) +
                               " of its " + std::string(mesher::name_of(block.kind)) + ": " +
                               error.what());
      }
    }
  }
}

/// Adds an element's stiffness under the constraints, and its mass if `mass` is not null.
void add_constrained(std::span<const std::int32_t> sites, const DofMap& dof_map,
                     const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                     Mat to_stiffness, Mat to_mass) {
  const ConstrainedElement constrained(sites, dof_map);
  Adder adder;
  adder.set_nodes(constrained.numbers());
  adder.add(constrained.reduced(stiffness), to_stiffness);
  adder.add(constrained.reduced(mass), to_mass);
}

std::vector<std::int32_t> blocks_of(std::span<const std::int32_t> nodes, const DofMap& dof_map) {
  std::vector<std::int32_t> blocks;
  for (const std::int32_t node : nodes) blocks.push_back(dof_map.index(node));
  return blocks;
}

void add_elements(const Task& task, bool is_constrained, SystemMatrices& system) {
  each_element(task, [&](const mesher::ElementBlock& block) {
    const mesher::Material& material = task.mesh.materials.at(block.material);
    const ElementScheme& scheme = element_scheme(block.kind, task.formulation.of(material));
    return [&, kernel = ElementKernel(scheme), geometric = GeometricKernel(scheme),
            element = ElementMatrices(), displacements_m = Eigen::MatrixXd(), adder = Adder()](
               std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates) mutable {
      kernel.compute(coordinates, material, element);
      if (task.prestress_m.cols() > 0) {
        gather(nodes, {&task.prestress_m}, displacements_m);
        geometric.add(coordinates, material, displacements_m, element.stiffness);
      }
      add_to_all(nodes, element.mass, system.nodal_mass);
      if (is_constrained) {
        add_constrained(nodes, task.dof_map, element.stiffness, in_three_directions(element.mass),
                        system.stiffness.get(), system.mass.get());
      } else {
        adder.set_nodes(blocks_of(nodes, task.dof_map));
        adder.add(element.stiffness, system.stiffness.get());
        adder.add_nodal(element.mass, system.nodal.get());
      }
    };
  });
}

/// Gives each dependent degree of freedom the mean diagonal entry as its only stiffness, and no
/// mass.
void stiffen_dependent(const DofMap& dof_map, const DofLayout& layout, Mat stiffness) {
  if (dof_map.dependent_count() == 0) return;
  VecHandle diagonal;
  PetscScalar sum = 0;
  require(MatCreateVecs(stiffness, diagonal.out(), nullptr), kAdding);
  require(MatGetDiagonal(stiffness, diagonal.get()), kAdding);
  require(VecSum(diagonal.get(), &sum), kAdding);
  const double mean = sum / static_cast<double>(dof_map.dof_count());
  const Eigen::Index begin = layout.first_own_dof();
  for (Eigen::Index row = begin; row < begin + layout.own_dof_count(); ++row) {
    if (!dof_map.is_dependent(static_cast<std::int32_t>(row / 3), row % 3)) continue;
    const auto place = static_cast<PetscInt>(row);
    require(MatSetValue(stiffness, place, place, mean, ADD_VALUES), kAdding);
  }
  finish(stiffness);
}

SystemMatrices assemble(const Task& task) {
  const std::vector<PointElement> points =
      point_elements_of(task.mesh.connections, task.mesh.nodes.size());
  const bool is_constrained = task.dof_map.is_constrained() || !points.empty();
  SystemMatrices system;
  system.nodal_mass = zero_nodal_mass(task.mesh);
  {
    const NodeGraph graph(task.mesh, task.dof_map);
    const Sparsity sparsity(graph, task.layout);
    system.stiffness = sparsity.upper();
    (is_constrained ? system.mass : system.nodal) =
        is_constrained ? sparsity.upper() : sparsity.nodal();
  }
  // Either all ranks or none of them reach the collective calls that follow.
  task.layout.ranks().together([&] {
    add_elements(task, is_constrained, system);
    std::size_t element = task.rank_of_element.size() - points.size();
    for (const PointElement& point : points) {
      if (!task.rank_of_element.empty() && !task.has(element++)) continue;
      add_constrained(point.sites, task.dof_map, point.stiffness, point.mass,
                      system.stiffness.get(), system.mass.get());
    }
  });
  finish(system.stiffness.get());
  stiffen_dependent(task.dof_map, task.layout, system.stiffness.get());
  if (is_constrained) {
    finish(system.mass.get());
  } else {
    finish(system.nodal.get());
    require(MatCreateMAIJ(system.nodal.get(), 3, system.mass.out()), kMaking);
    require(MatSetOption(system.mass.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
  }
  return system;
}

}  // namespace

SystemMatrices assemble(const Model& model) {
  const ModalOptions& options = model.options();
  return assemble(Task{model.mesh(), model.dof_map(), options.formulation, options.prestress_m,
                       model.fields().layout(), model.rank_of_element()});
}

SystemMatrices assemble(const mesher::Mesh& mesh, const DofMap& dof_map,
                        const FormulationChoice& formulation, const Eigen::Matrix3Xd& prestress_m) {
  return assemble(
      Task{mesh, dof_map, formulation, prestress_m, DofLayout(dof_map.free_count()), {}});
}

MatHandle assemble_geometric(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation,
                             const Eigen::Matrix3Xd& prestress_m, double factor) {
  const DofLayout layout(dof_map.free_count());
  MatHandle result = Sparsity(NodeGraph(mesh, dof_map), layout).upper();
  require(MatSetOption(result.get(), MAT_SPD, PETSC_FALSE), kMaking);
  require(MatSetOption(result.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
  each_element(
      {mesh, dof_map, formulation, prestress_m, layout, {}},
      [&](const mesher::ElementBlock& block) {
        const mesher::Material& material = mesh.materials.at(block.material);
        return
            [&, kernel = GeometricKernel(element_scheme(block.kind, formulation.of(material))),
             displacements_m = Eigen::MatrixXd(), adder = Adder()](
                std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates) mutable {
              gather(nodes, {&prestress_m}, displacements_m);
              Eigen::MatrixXd element =
                  Eigen::MatrixXd::Zero(3 * coordinates.cols(), 3 * coordinates.cols());
              kernel.add(coordinates, material, displacements_m, element);
              const ConstrainedElement constrained(nodes, dof_map);
              adder.set_nodes(constrained.numbers());
              adder.add(factor * constrained.reduced(element), result.get());
            };
      });
  finish(result.get());
  return result;
}

MatHandle shifted_stiffness(Mat stiffness, Mat mass, double shift) {
  MatHandle result;
  require(MatDuplicate(stiffness, MAT_COPY_VALUES, result.out()), kMaking);
  PetscBool is_nodal = PETSC_FALSE;
  PetscBool is_nodal_on_ranks = PETSC_FALSE;
  const auto object = reinterpret_cast<PetscObject>(mass);
  require(PetscObjectTypeCompare(object, MATSEQMAIJ, &is_nodal), kMaking);
  require(PetscObjectTypeCompare(object, MATMPIMAIJ, &is_nodal_on_ranks), kMaking);
  if (is_nodal == PETSC_FALSE && is_nodal_on_ranks == PETSC_FALSE) {
    require(MatAXPY(result.get(), -shift, mass, SUBSET_NONZERO_PATTERN), kAdding);
    return result;
  }
  require(MatSetOption(result.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE), kMaking);
  Mat nodal = nullptr;
  PetscInt begin = 0;
  PetscInt end = 0;
  require(MatMAIJGetAIJ(mass, &nodal), kMaking);
  require(MatGetOwnershipRange(nodal, &begin, &end), kMaking);
  std::vector<PetscInt> columns;
  std::vector<PetscScalar> values;
  for (PetscInt node = begin; node < end; ++node) {
    PetscInt count = 0;
    const PetscInt* others = nullptr;
    const PetscScalar* entries = nullptr;
    require(MatGetRow(nodal, node, &count, &others, &entries), kAdding);
    values.assign(entries, entries + count);
    for (PetscScalar& value : values) value *= -shift;
    for (PetscInt row = 3 * node; row < 3 * node + 3; ++row) {
      columns.clear();
      for (PetscInt k = 0; k < count; ++k) columns.push_back(3 * others[k] + row % 3);
      require(MatSetValues(result.get(), 1, &row, count, columns.data(), values.data(), ADD_VALUES),
              kAdding);
    }
    require(MatRestoreRow(nodal, node, &count, &others, &entries), kAdding);
  }
  finish(result.get());
  return result;
}

}  // namespace flexneck::fe_modal
