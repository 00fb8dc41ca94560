// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/star_patches.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/row_panels.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

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

/// For each element the place whose block no other element has and all stars of the element have;
/// -1: none.
std::vector<std::int32_t> find_inner(const ElementOperator& elements, const Places& places,
                                     std::size_t block_count) {
  std::vector<std::int32_t> visits(block_count, 0);
  elements.for_each_numbers([&](std::span<const std::int32_t> numbers) {
    for (const std::int32_t number : numbers) {
      if (number >= 0) ++visits[static_cast<std::size_t>(number)];
    }
  });
  // Whether all stars of a block are stars of the other.
  const auto has_stars_of = [&](std::int32_t other, std::int32_t block) {
    const std::span<const Place> stars = places.of(other);
    const std::span<const Place> own = places.of(block);
    return std::all_of(own.begin(), own.end(), [&](const Place& place) {
      return std::any_of(stars.begin(), stars.end(),
                         [&](const Place& star) { return star.patch == place.patch; });
    });
  };
  std::vector<std::int32_t> inner;
  elements.for_each_numbers([&](std::span<const std::int32_t> numbers) {
    const auto is_inner = [&](std::int32_t number) {
      return number >= 0 && visits[static_cast<std::size_t>(number)] == 1 &&
             places.of(number).size() > 1 &&
             std::all_of(numbers.begin(), numbers.end(), [&](std::int32_t other) {
               return other < 0 || has_stars_of(number, other);
             });
    };
    const auto found = std::find_if(numbers.begin(), numbers.end(), is_inner);
    inner.push_back(found == numbers.end() ? -1
                                           : static_cast<std::int32_t>(found - numbers.begin()));
  });
  return inner;
}

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

/// Dependent degrees of freedom have no stiffness: they get 1.
void fix_dependent(Eigen::MatrixXd& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (matrix(i, i) == 0) matrix(i, i) = 1;
  }
}

}  // namespace

StarPatches::StarPatches(const StarMesh& body, const ElementOperator& stiffness) {
  PatchLists stars = find_stars(body);
  all_.patches.resize(stars.size());
  std::iota(all_.patches.begin(), all_.patches.end(), std::size_t{0});
  cells_.patches = find_cells(body, stars);
  const auto block_count = static_cast<std::size_t>(body.dof_map.free_count());
  const std::vector<std::int32_t> inner = take_inner(stiffness, block_count, stars);
  const Places places(stars, block_count);
  std::vector<LocalPlace> workspace;
  // Elements that a patch waits for: it is factorised as soon as it is whole.
  std::vector<std::int32_t> awaited(stars.size(), 0);
  stiffness.for_each_numbers([&](std::span<const std::int32_t> numbers) {
    for_each_patch(places, numbers, workspace,
                   [&](std::size_t patch, auto /*places*/) { ++awaited[patch]; });
  });
  // Factors are allocated before these matrices, which come and go: between small blocks that stay
  // they would leave gaps, a tenth of a certificate's memory.
  patches_.reserve(stars.size());
  for (auto& blocks : stars) {
    const std::size_t size = kBlock * blocks.size();
    patches_.push_back({std::move(blocks), PanelFactor(size)});
  }
  std::vector<Eigen::MatrixXd> open(patches_.size());
  auto next_inner = inner_.begin();
  std::size_t number = 0;
  stiffness.for_each_stiffness(
      [&](std::span<const std::int32_t> numbers, Eigen::MatrixXd& element) {
        const std::int32_t place = inner[number++];
        if (place >= 0) {
          (next_inner++)->take_from(numbers, static_cast<std::size_t>(place), element);
        }
        for_each_patch(
            places, numbers, workspace, [&](std::size_t patch, std::span<const LocalPlace> own) {
              Eigen::MatrixXd& matrix = open[patch];
              const auto size = 3 * static_cast<Eigen::Index>(patches_[patch].blocks.size());
              if (matrix.size() == 0) matrix = Eigen::MatrixXd::Zero(size, size);
              add(own, element, matrix);
              if (--awaited[patch] > 0) return;
              fix_dependent(matrix);
              patches_[patch].factor.factorise(matrix);
              matrix.resize(0, 0);
            });
      });
}

std::vector<std::int32_t> StarPatches::take_inner(const ElementOperator& elements,
                                                  std::size_t block_count, PatchLists& stars) {
  const Places places(stars, block_count);
  std::vector<bool> is_cell(stars.size(), false);
  for (const std::size_t cell : cells_.patches) is_cell[cell] = true;
  std::vector<std::int32_t> inner = find_inner(elements, places, block_count);
  std::vector<bool> is_inner(block_count, false);
  std::size_t element = 0;
  elements.for_each_numbers([&](std::span<const std::int32_t> numbers) {
    const std::int32_t place = inner[element++];
    if (place < 0) return;
    const std::int32_t number = numbers[static_cast<std::size_t>(place)];
    is_inner[static_cast<std::size_t>(number)] = true;
    inner_.emplace_back(numbers, static_cast<std::size_t>(place));
    const std::span<const Place> own = places.of(number);
    all_.stars_of_inner.push_back(own.size());
    cells_.stars_of_inner.push_back(
        static_cast<std::size_t>(std::count_if(own.begin(), own.end(), [&](const Place& star) {
          return is_cell[static_cast<std::size_t>(star.patch)];
        })));
  });
  for (auto& blocks : stars) {
    std::erase_if(blocks, [&](std::int32_t b) { return is_inner[static_cast<std::size_t>(b)]; });
  }
  return inner;
}

void StarPatches::add_solutions(const Selection& selection, double weight,
                                const Eigen::MatrixXd& residuals, Eigen::MatrixXd& sums) const {
  if (residuals.cols() <= static_cast<Eigen::Index>(kColumnsTogether)) {
    add_by_lanes<kColumnsTogether>(selection, weight, residuals, sums);
  } else {
    add_by_lanes<kSinglesTogether>(selection, weight, residuals, sums);
  }
}

template <std::size_t lanes>
void StarPatches::add_by_lanes(const Selection& selection, double weight,
                               const Eigen::MatrixXd& residuals, Eigen::MatrixXd& sums) const {
  // Of unit size: forces of slow modes may be too small for single precision.
  const double largest = residuals.size() == 0 ? 0 : residuals.cwiseAbs().maxCoeff();
  if (largest == 0) return;
  // Row by row the columns in groups, all of which a patch's factor meets in turn.
  constexpr auto kTogether = static_cast<Eigen::Index>(lanes);
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Index width = (residuals.cols() + kTogether - 1) / kTogether;
  const auto groups = static_cast<std::size_t>(width);
  std::vector<RowOf<float, lanes>> given(static_cast<std::size_t>(residuals.rows()) * groups);
  std::vector<RowOf<float, lanes>> solutions(given.size());
  const auto columns_of = [&](std::vector<RowOf<float, lanes>>& rows) {
    return Eigen::Map<RowMajor>(rows.front().value, residuals.rows(), width * kTogether)
        .leftCols(residuals.cols());
  };
  for_each_panel(residuals.rows(), [&](Eigen::Index first, Eigen::Index rows) {
    columns_of(given).middleRows(first, rows) =
        (residuals.middleRows(first, rows) * (1 / largest)).template cast<float>();
  });
  for (std::size_t k = 0; k < inner_.size(); ++k) {
    if (selection.stars_of_inner[k] > 0) inner_[k].eliminate<lanes>(groups, given);
  }
  Workspace<lanes> workspace;
  for (const std::size_t number : selection.patches) {
    add_solution<lanes>(patches_[number], groups, given, solutions, workspace);
  }
  for (std::size_t k = 0; k < inner_.size(); ++k) {
    const std::size_t count = selection.stars_of_inner[k];
    if (count > 0) inner_[k].substitute<lanes>(groups, given, count, solutions);
  }
  for_each_panel(residuals.rows(), [&](Eigen::Index first, Eigen::Index rows) {
    sums.middleRows(first, rows) +=
        weight * largest * columns_of(solutions).middleRows(first, rows).template cast<double>();
  });
}

template <std::size_t lanes>
void StarPatches::add_solution(const Patch& patch, std::size_t groups,
                               std::span<const RowOf<float, lanes>> forces,
                               std::span<RowOf<float, lanes>> sums, Workspace<lanes>& workspace) {
  std::vector<RowOf<float, lanes>>& own = workspace.rows;
  own.resize(kBlock * patch.blocks.size());
  patch.factor.unpack(workspace.factor);
  const std::size_t count = patch.blocks.size();
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      own[i] = forces[first_row(groups, patch.blocks[i / kBlock]) + i % kBlock * groups + group];
    }
    patch.factor.solve(workspace.factor, own.data());
    run_with(
        widest_registers(), [&]<std::size_t /*bytes*/>() __attribute__((always_inline)) {
          for (std::size_t k = 0; k < count; ++k) {
            add_rows(&own[kBlock * k], kBlock, groups,
                     &sums[first_row(groups, patch.blocks[k]) + group]);
          }
        });
  }
}

}  // namespace flexneck::fe_modal
