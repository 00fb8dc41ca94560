// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/estimate_limits.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <span>
#include <utility>

namespace flexneck::fe_modal {
namespace {

/// Number of nodes of a set that are neither on a whole face of the set nor in an element beside
/// one.
std::size_t count_single(const mesher::Mesh& mesh, std::span<const std::int32_t> nodes) {
  enum class Place : char { outside, single, beside_face, on_face };
  std::vector<Place> places(mesh.nodes.size(), Place::outside);
  const auto at = [&](std::int32_t node) -> Place& {
    return places[static_cast<std::size_t>(node)];
  };
  for (const std::int32_t node : nodes) at(node) = Place::single;
  const auto for_each_element = [&](const auto& visit) {
    for (const mesher::ElementBlock& block : mesh.blocks) {
      const std::size_t width = mesher::nodes_per_element(block.kind);
      for (std::size_t first = 0; first < block.nodes.size(); first += width)
        visit(block.kind, std::span(block.nodes).subspan(first, width));
    }
  };
  for_each_element([&](mesher::ElementKind kind, std::span<const std::int32_t> element) {
    for (const mesher::ReferenceFacet& side : mesher::facets_of(kind)) {
      const auto is_held = [&](std::size_t k) { return at(element[k]) != Place::outside; };
      if (!std::all_of(side.nodes.begin(), side.nodes.end(), is_held)) continue;
      for (const std::size_t k : side.nodes) at(element[k]) = Place::on_face;
    }
  });
  for_each_element([&](mesher::ElementKind /*kind*/, std::span<const std::int32_t> element) {
    const auto is_on_face = [&](std::int32_t node) { return at(node) == Place::on_face; };
    if (std::none_of(element.begin(), element.end(), is_on_face)) return;
    for (const std::int32_t node : element) {
      if (at(node) == Place::single) at(node) = Place::beside_face;
    }
  });
  return static_cast<std::size_t>(std::count(places.begin(), places.end(), Place::single));
}

/// Collects a line for each set with single nodes.
class SingleNodes {
 public:
  explicit SingleNodes(const mesher::Mesh& mesh) : mesh_(mesh) {}

  /// Adds the single nodes of a node set.
  void add_set(const std::string& name, std::span<const std::int32_t> nodes) {
    add(name, count_single(mesh_, nodes), nodes.size());
  }
  /// Adds sites that all count as single, since finer meshes have no more of them.
  void add_sites(const std::string& name, const std::set<std::int32_t>& sites) {
    const auto end = sites.lower_bound(static_cast<std::int32_t>(mesh_.nodes.size()));
    const auto count = static_cast<std::size_t>(std::distance(sites.begin(), end));
    add(name, count, count);
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  void add(const std::string& name, std::size_t single, std::size_t all) {
    if (single == 0) return;
    const std::string of = single < all ? " of its " + std::to_string(all) : "";
    lines_.push_back(name + " (" + std::to_string(single) + of + (all == 1 ? " node)" : " nodes)"));
  }

  const mesher::Mesh& mesh_;
  std::vector<std::string> lines_;
};

template <typename Each>
std::set<std::int32_t> sites_of(const std::vector<Each>& all) {
  std::set<std::int32_t> sites;
  for (const Each& each : all) {
    for (const mesher::Term& term : each.terms) sites.insert(term.site);
  }
  return sites;
}

}  // namespace

std::vector<std::string> held_at_single_nodes(const mesher::Mesh& mesh,
                                              const ModalOptions& options) {
  SingleNodes single(mesh);
  if (!options.fixed_set.empty())
    single.add_set("node set '" + options.fixed_set + "'", mesh.node_set(options.fixed_set).nodes);
  const mesher::Connections connections = connections_of(mesh, options);
  for (const mesher::Support& support : connections.supports)
    single.add_set(support.name, support.nodes);
  for (const mesher::Coupling& coupling : connections.couplings)
    single.add_set(coupling.name, coupling.nodes);
  single.add_sites("equations", sites_of(connections.equations));
  single.add_sites("springs", sites_of(connections.springs));
  std::set<std::int32_t> massive;
  for (const mesher::PointMass& mass : connections.masses) massive.insert(mass.site);
  single.add_sites("point masses", massive);
  return single.take();
}

std::vector<std::string> loaded_at_single_nodes(const mesher::Mesh& mesh,
                                                const std::vector<Load>& loads) {
  SingleNodes single(mesh);
  for (const Load& load : loads) {
    const auto* const at_nodes = std::get_if<NodeLoad>(&load.kind);
    if (at_nodes == nullptr) continue;
    const std::string name = "load '" + load.name + "'";
    if (at_nodes->position_m) {
      single.add_sites(name, {0});  // any single node has the same count
    } else {
      single.add_set(name, mesh.node_set(at_nodes->set).nodes);
    }
  }
  return single.take();
}

std::string limits_of_estimate(const mesher::Mesh& mesh, const ModalOptions& options) {
  std::vector<std::string> single = held_at_single_nodes(mesh, options);
  const std::vector<std::string> loaded = loaded_at_single_nodes(mesh, options.prestress);
  single.insert(single.end(), loaded.begin(), loaded.end());
  std::string names;
  for (const std::string& line : single) names += (names.empty() ? "" : ", ") + line;
  if (names.empty()) return names;
  return "the body is supported or loaded at single nodes, for which results do not converge with "
         "mesh refinement: " +
         names;
}

}  // namespace flexneck::fe_modal
