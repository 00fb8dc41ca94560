// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/star_patches.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

using PatchLists = std::vector<std::vector<std::int32_t>>;

/// For each node of a kind the corners whose stars it belongs to: those of the edge, the face or
/// the element that it lies within.
std::vector<std::vector<std::size_t>> corners_of_nodes(mesher::ElementKind kind) {
  const auto nodes = mesher::reference_nodes(kind);
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    positions.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(nodes[i].data());
  }
  const mesher::ElementKind linear = mesher::linear_kind_of(mesher::shape_of(kind));
  const Eigen::MatrixXd values = mesher::tabulate(linear, positions).values;
  constexpr double kNothing = 1e-9;
  std::vector<std::vector<std::size_t>> corners(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (Eigen::Index c = 0; c < values.rows(); ++c) {
      if (values(c, static_cast<Eigen::Index>(i)) > kNothing) {
        corners[i].push_back(static_cast<std::size_t>(c));
      }
    }
  }
  return corners;
}

/// The blocks of each star, ascending.
PatchLists find_stars(const StarMesh& body) {
  const DofMap& dof_map = body.dof_map;
  // Tied corners have one star.
  const auto star_of = [&](std::int32_t corner) {
    const std::int32_t block = dof_map.index(corner);
    return block >= 0 ? block : static_cast<std::int32_t>(dof_map.free_count()) + corner;
  };
  const auto is_center = [&](std::int32_t corner) {
    return body.is_center.empty() || body.is_center[static_cast<std::size_t>(corner)];
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> members;
  for (const mesher::ElementBlock& block : body.mesh.blocks) {
    const auto corners = corners_of_nodes(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += corners.size()) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t own = dof_map.index(block.nodes[first + i]);
        if (own < 0) continue;
        for (const std::size_t c : corners[i]) {
          const std::int32_t corner = block.nodes[first + c];
          if (is_center(corner)) members.emplace_back(star_of(corner), own);
        }
      }
    }
  }
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  PatchLists stars;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (k == 0 || members[k].first != members[k - 1].first) stars.emplace_back();
    stars.back().push_back(members[k].second);
  }
  return stars;
}

/// Of the stars that lie within one parent, the largest of each parent.
std::vector<std::size_t> find_cells(const StarMesh& body, const PatchLists& stars) {
  constexpr std::int32_t kNone = -1;
  constexpr std::int32_t kSeveral = -2;
  std::vector<std::int32_t> parent_of(static_cast<std::size_t>(body.dof_map.free_count()), kNone);
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : body.mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t k = 0; k < block.nodes.size(); ++k) {
      const std::int32_t parent = body.parents[element + k / width];
      body.dof_map.for_each_number(block.nodes[k], [&](std::int32_t number) {
        std::int32_t& known = parent_of[static_cast<std::size_t>(number)];
        known = known == kNone || known == parent ? parent : kSeveral;
      });
    }
    element += block.size();
  }
  std::map<std::int32_t, std::size_t> cells;
  for (std::size_t s = 0; s < stars.size(); ++s) {
    const std::int32_t parent = parent_of[static_cast<std::size_t>(stars[s].front())];
    if (parent < 0 || !std::all_of(stars[s].begin(), stars[s].end(), [&](std::int32_t block) {
          return parent_of[static_cast<std::size_t>(block)] == parent;
        })) {
      continue;
    }
    const auto [place, is_new] = cells.try_emplace(parent, s);
    if (!is_new && stars[s].size() > stars[place->second].size()) place->second = s;
  }
  std::vector<std::size_t> numbers;
  numbers.reserve(cells.size());
  for (const auto& [parent, star] : cells) numbers.push_back(star);
  return numbers;
}

/// A block's place in a patch.
struct Place {
  std::int32_t patch;
  std::int32_t position;
};

/// The places of each block.
class Places {
 public:
  Places(const PatchLists& patches, std::size_t block_count) : offsets_(block_count + 1, 0) {
    for (const auto& blocks : patches) {
      for (const std::int32_t block : blocks) ++offsets_[static_cast<std::size_t>(block) + 1];
    }
    for (std::size_t k = 0; k < block_count; ++k) offsets_[k + 1] += offsets_[k];
    places_.resize(offsets_.back());
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::size_t p = 0; p < patches.size(); ++p) {
      for (std::size_t i = 0; i < patches[p].size(); ++i) {
        places_[next[static_cast<std::size_t>(patches[p][i])]++] = {static_cast<std::int32_t>(p),
                                                                    static_cast<std::int32_t>(i)};
      }
    }
  }

  std::span<const Place> of(std::int32_t block) const {
    const auto k = static_cast<std::size_t>(block);
    return std::span(places_).subspan(offsets_[k], offsets_[k + 1] - offsets_[k]);
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<Place> places_;
};

/// A place of an element's local node.
struct LocalPlace {
  std::int32_t patch;
  std::int32_t position;
  std::int32_t local;
};

/// Calls visit(patch, places) for each patch that has blocks of the element.
template <typename Visitor>
void for_each_patch(const Places& places, std::span<const std::int32_t> numbers,
                    std::vector<LocalPlace>& workspace, const Visitor& visit) {
  workspace.clear();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0) continue;
    for (const Place& place : places.of(numbers[i])) {
      workspace.push_back({place.patch, place.position, static_cast<std::int32_t>(i)});
    }
  }
  std::sort(workspace.begin(), workspace.end(), [](const LocalPlace& a, const LocalPlace& b) {
    return a.patch != b.patch ? a.patch < b.patch : a.position < b.position;
  });
  for (std::size_t first = 0; first < workspace.size();) {
    std::size_t last = first;
    while (last < workspace.size() && workspace[last].patch == workspace[first].patch) ++last;
    visit(static_cast<std::size_t>(workspace[first].patch),
          std::span<const LocalPlace>(workspace).subspan(first, last - first));
    first = last;
  }
}

/// Adds to the lower half of a patch's matrix, of which degree of freedom 3 position + a is
/// direction a.
void add(std::span<const LocalPlace> places, const Eigen::MatrixXd& element,
         Eigen::MatrixXd& matrix) {
  const Eigen::Index n = element.rows() / 3;
  for (const LocalPlace& column : places) {
    for (const LocalPlace& row : places) {
      if (row.position < column.position) continue;
      for (Eigen::Index b = 0; b < 3; ++b) {
        for (Eigen::Index a = 0; a < 3; ++a) {
          matrix(3 * row.position + a, 3 * column.position + b) +=
              element(a * n + row.local, b * n + column.local);
        }
      }
    }
  }
}

/// @param matrix lower half; is overwritten
PanelFactor factorised(Eigen::MatrixXd& matrix) {
  // Dependent degrees of freedom have no stiffness.
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (matrix(i, i) == 0) matrix(i, i) = 1;
  }
  return PanelFactor(matrix);
}

}  // namespace

StarPatches::StarPatches(const StarMesh& body, const ElementOperator& stiffness) {
  PatchLists stars = find_stars(body);
  cells_ = find_cells(body, stars);
  const Places places(stars, static_cast<std::size_t>(body.dof_map.free_count()));
  std::vector<LocalPlace> workspace;
  // Elements that a patch waits for: it is factorised as soon as it is whole.
  std::vector<std::int32_t> awaited(stars.size(), 0);
  stiffness.for_each_numbers([&](std::span<const std::int32_t> numbers) {
    for_each_patch(places, numbers, workspace,
                   [&](std::size_t patch, auto /*places*/) { ++awaited[patch]; });
  });
  std::vector<Eigen::MatrixXd> open(stars.size());
  patches_.resize(stars.size());
  stiffness.for_each_stiffness(
      [&](std::span<const std::int32_t> numbers, const Eigen::MatrixXd& element) {
        for_each_patch(places, numbers, workspace,
                       [&](std::size_t patch, std::span<const LocalPlace> own) {
                         Eigen::MatrixXd& matrix = open[patch];
                         const auto size = 3 * static_cast<Eigen::Index>(stars[patch].size());
                         if (matrix.size() == 0) matrix = Eigen::MatrixXd::Zero(size, size);
                         add(own, element, matrix);
                         if (--awaited[patch] > 0) return;
                         patches_[patch].factor = factorised(matrix);
                         matrix.resize(0, 0);
                       });
      });
  for (std::size_t p = 0; p < stars.size(); ++p) patches_[p].blocks = std::move(stars[p]);
  all_.resize(patches_.size());
  std::iota(all_.begin(), all_.end(), std::size_t{0});
}

Eigen::MatrixXd StarPatches::smooth(const Eigen::MatrixXd& residuals) const {
  return sum_of(all_, residuals);
}

Eigen::MatrixXd StarPatches::solve_cells(const Eigen::MatrixXd& residuals) const {
  return sum_of(cells_, residuals);
}

Eigen::MatrixXd StarPatches::sum_of(const std::vector<std::size_t>& patches,
                                    const Eigen::MatrixXd& residuals) const {
  if (residuals.cols() <= static_cast<Eigen::Index>(kColumnsTogether)) {
    return sum_by_lanes<kColumnsTogether>(patches, residuals);
  }
  return sum_by_lanes<kSinglesTogether>(patches, residuals);
}

template <std::size_t lanes>
Eigen::MatrixXd StarPatches::sum_by_lanes(const std::vector<std::size_t>& patches,
                                          const Eigen::MatrixXd& residuals) const {
  // Of unit size: forces of slow modes may be too small for single precision.
  const double largest = residuals.size() == 0 ? 0 : residuals.cwiseAbs().maxCoeff();
  if (largest == 0) return Eigen::MatrixXd::Zero(residuals.rows(), residuals.cols());
  // Row by row the columns in groups, all of which a patch's factor meets in turn.
  constexpr auto kTogether = static_cast<Eigen::Index>(lanes);
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Index groups = (residuals.cols() + kTogether - 1) / kTogether;
  std::vector<RowOf<float, lanes>> given(static_cast<std::size_t>(residuals.rows() * groups));
  std::vector<RowOf<float, lanes>> sums(given.size());
  const auto columns_of = [&](std::vector<RowOf<float, lanes>>& rows) {
    return Eigen::Map<RowMajor>(rows.front().value, residuals.rows(), groups * kTogether);
  };
  columns_of(given).leftCols(residuals.cols()) = (residuals / largest).cast<float>();
  for (const std::size_t number : patches) {
    add_solution<lanes>(patches_[number], static_cast<std::size_t>(groups), given, sums);
  }
  return largest * columns_of(sums).leftCols(residuals.cols()).template cast<double>();
}

template <std::size_t lanes>
void StarPatches::add_solution(const Patch& patch, std::size_t groups,
                               std::span<const RowOf<float, lanes>> forces,
                               std::span<RowOf<float, lanes>> sums) {
  constexpr std::size_t kNode = 3;
  std::vector<RowOf<float, lanes>> own(kNode * patch.blocks.size());
  const auto row_of = [&](std::size_t i) {
    return groups * (kNode * static_cast<std::size_t>(patch.blocks[i / kNode]) + i % kNode);
  };
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = forces[row_of(i) + group];
    patch.factor.solve(own.data());
    for (std::size_t i = 0; i < own.size(); ++i) {
      RowOf<float, lanes>& sum = sums[row_of(i) + group];
      for (std::size_t c = 0; c < lanes; ++c) sum.value[c] += own[i].value[c];
    }
  }
}

}  // namespace flexneck::fe_modal
