// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomains.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>

#include "fe_modal/solve/iterative/submatrix.h"
#include "fe_modal/system/rank_part.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {
namespace {

/// Nodes of a subdomain before it is extended; up to twice as many where a part is not cut. Smaller
/// ones hardly save memory, for they overlap more, and take more iterations: every cut through a
/// thin layer of rubber or a plate costs some.
constexpr std::size_t kNodesOfSubdomain = 10000;

/// Ratio of Young's moduli from which a material is much stiffer than another (synthetic: between
/// that of two rubbers, a few, and that of metal and rubber, thousands). Below it, the subdomains
/// of both materials overlap each other.
constexpr double kMuchStiffer = 10;

void sort_out_copies(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Elements of one part alone.
mesher::Mesh part_of(const mesher::Mesh& mesh, const std::string& name) {
  mesher::Mesh result;
  result.nodes = mesh.nodes;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    if (block.part == name) result.blocks.push_back(block);
  }
  return result;
}

struct PartSize {
  std::size_t elements = 0;
  std::size_t blocks = 0;
};

PartSize size_of(const mesher::Mesh& part, const DofMap& dof_map) {
  PartSize size;
  std::vector<std::int32_t> all;
  for_each_element(part, [&](std::size_t /*element*/, std::span<const std::int32_t> nodes) {
    ++size.elements;
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) { all.push_back(block); });
    }
  });
  sort_out_copies(all);
  size.blocks = all.size();
  return size;
}

/// How many subdomains each part is cut into.
std::vector<std::size_t> counts_of(const std::vector<PartSize>& sizes, std::size_t least_count) {
  std::vector<std::size_t> counts;
  counts.reserve(sizes.size());
  for (const PartSize& size : sizes) {
    counts.push_back(
        std::min(size.elements, std::max<std::size_t>(1, size.blocks / kNodesOfSubdomain)));
  }
  // One alone would be the whole. The largest pieces are cut further.
  least_count = std::max<std::size_t>(2, least_count);
  const auto weight = [&](std::size_t p) {
    return counts[p] < sizes[p].elements
               ? static_cast<double>(sizes[p].blocks) / static_cast<double>(counts[p])
               : 0.0;
  };
  for (std::size_t count = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
       count < least_count; ++count) {
    std::size_t largest = 0;
    for (std::size_t p = 1; p < counts.size(); ++p) {
      if (weight(p) > weight(largest)) largest = p;
    }
    if (weight(largest) == 0) break;
    ++counts[largest];
  }
  return counts;
}

void set_blocks(const mesher::Mesh& mesh, const DofMap& dof_map, std::size_t count,
                Subdomains& subdomains) {
  subdomains.blocks.resize(count);
  for_each_element(mesh, [&](std::size_t element, std::span<const std::int32_t> nodes) {
    auto& own = subdomains.blocks[static_cast<std::size_t>(subdomains.of_element[element])];
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) { own.push_back(block); });
    }
  });
  for (std::vector<std::int32_t>& blocks : subdomains.blocks) sort_out_copies(blocks);
}

/// @param of_element Young's moduli; 0 of springs and masses, which have none
void set_moduli(const mesher::Mesh& mesh, const DofMap& dof_map,
                const std::vector<double>& of_element, Subdomains& subdomains) {
  subdomains.moduli_Pa.resize(subdomains.blocks.size(), 0);
  subdomains.softest_Pa.resize(static_cast<std::size_t>(dof_map.free_count()), 0);
  for_each_element(mesh, [&](std::size_t element, std::span<const std::int32_t> nodes) {
    const double modulus = of_element[element];
    if (modulus == 0) return;
    double& highest =
        subdomains.moduli_Pa[static_cast<std::size_t>(subdomains.of_element[element])];
    highest = std::max(highest, modulus);
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) {
        double& lowest = subdomains.softest_Pa[static_cast<std::size_t>(block)];
        lowest = lowest == 0 ? modulus : std::min(lowest, modulus);
      });
    }
  });
}

}  // namespace

Subdomains find_subdomains(const mesher::Mesh& mesh, const DofMap& dof_map, int least_count) {
  const std::vector<std::string> names = mesher::parts_of(mesh);
  std::vector<mesher::Mesh> parts;
  std::vector<PartSize> sizes;
  for (const std::string& name : names) {
    parts.push_back(part_of(mesh, name));
    sizes.push_back(size_of(parts.back(), dof_map));
  }
  const std::vector<std::size_t> counts =
      counts_of(sizes, static_cast<std::size_t>(std::max(1, least_count)));
  std::vector<std::vector<std::int32_t>> of_element_of_part;
  std::int32_t first = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    of_element_of_part.push_back(
        mesher::partition_elements(parts[p], static_cast<int>(counts[p])).processes);
    for (std::int32_t& number : of_element_of_part.back()) number += first;
    first += static_cast<std::int32_t>(counts[p]);
  }

  Subdomains result;
  std::vector<double> moduli_Pa;  // of each element
  std::vector<std::size_t> next(parts.size(), 0);
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const auto p =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), block.part) - names.begin());
    for (std::size_t e = 0; e < block.size(); ++e) {
      result.of_element.push_back(of_element_of_part[p][next[p]++]);
    }
    moduli_Pa.resize(result.of_element.size(), mesh.materials[block.material].youngs_modulus_Pa);
  }
  result.of_element.resize(element_count(mesh), 0);  // springs and masses
  moduli_Pa.resize(element_count(mesh), 0);
  set_blocks(mesh, dof_map, static_cast<std::size_t>(first), result);
  set_moduli(mesh, dof_map, moduli_Pa, result);
  return result;
}

std::vector<std::int32_t> ranks_of_subdomains(const mesher::Mesh& mesh,
                                              const Subdomains& subdomains, int rank_count) {
  const auto count = static_cast<std::size_t>(subdomains.count());
  Eigen::Index longest = 0;
  mesher::bounding_box(mesh).extent_m().maxCoeff(&longest);
  std::vector<double> places(count, 0.0);
  std::vector<double> elements(count, 0.0);
  for_each_element(mesh, [&](std::size_t element, std::span<const std::int32_t> nodes) {
    const auto subdomain = static_cast<std::size_t>(subdomains.of_element[element]);
    const auto node = static_cast<std::size_t>(nodes.front());
    if (node >= mesh.nodes.size()) return;  // a reference point
    places[subdomain] += mesh.nodes[node][static_cast<std::size_t>(longest)];
    elements[subdomain] += 1;
  });
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t s) { return places[s] / std::max(1.0, elements[s]); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t one, std::size_t other) { return place(one) < place(other); });

  double left = 0;
  for (const std::vector<std::int32_t>& blocks : subdomains.blocks) {
    left += static_cast<double>(blocks.size());
  }
  std::vector<std::int32_t> ranks(count, 0);
  std::int32_t rank = 0;
  double taken = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto size = static_cast<double>(subdomains.blocks[order[k]].size());
    const auto ranks_left = static_cast<double>(rank_count - rank);
    const bool is_full = taken > 0 && taken + size / 2 > left / ranks_left;
    const bool must_spare =
        taken > 0 && count - k <= static_cast<std::size_t>(rank_count - rank - 1);
    if (rank + 1 < rank_count && (is_full || must_spare)) {
      left -= taken;
      taken = 0;
      ++rank;
    }
    ranks[order[k]] = rank;
    taken += size;
  }
  return ranks;
}

std::vector<std::int32_t> ranks_of_elements(const mesher::Mesh& mesh, const Subdomains& subdomains,
                                            int rank_count) {
  const std::vector<std::int32_t> ranks = ranks_of_subdomains(mesh, subdomains, rank_count);
  std::vector<std::int32_t> result;
  result.reserve(subdomains.of_element.size());
  for (const std::int32_t subdomain : subdomains.of_element) {
    result.push_back(ranks[static_cast<std::size_t>(subdomain)]);
  }
  return result;
}

std::vector<std::int32_t> extended(const Subdomains& subdomains, std::size_t number,
                                   const NodeGraph& graph,
                                   const std::vector<std::int32_t>& blocks) {
  const std::vector<std::int32_t> own = places_in(blocks, subdomains.blocks[number]);
  std::vector<bool> is_near(blocks.size(), false);
  const auto is_in = [&](std::int32_t row) { return is_near[static_cast<std::size_t>(row)]; };
  for (const std::int32_t row : own) {
    for (const std::int32_t other : graph.neighbours(row)) {
      is_near[static_cast<std::size_t>(other)] = true;
    }
  }
  const double own_Pa = subdomains.moduli_Pa[number];
  const auto joins = [&](std::int32_t row) {
    const std::int32_t block = blocks[static_cast<std::size_t>(row)];
    const double softest_Pa = subdomains.softest_Pa[static_cast<std::size_t>(block)];
    if (kMuchStiffer * softest_Pa < own_Pa) return true;
    const auto neighbours = graph.neighbours(row);
    return softest_Pa <= kMuchStiffer * own_Pa &&
           std::all_of(neighbours.begin(), neighbours.end(), is_in);
  };
  std::vector<std::int32_t> result;
  for (std::int32_t row = 0; row < graph.node_count(); ++row) {
    if (is_in(row) && (joins(row) || std::binary_search(own.begin(), own.end(), row))) {
      result.push_back(row);
    }
  }
  return result;
}

}  // namespace flexneck::fe_modal
