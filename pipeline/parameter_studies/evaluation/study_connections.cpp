// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/evaluation/study_connections.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/mesh/positions.h"

namespace flexneck::pipeline {
namespace {

class Builder {
 public:
  Builder(const ModesConnections& given, mesher::Mesh& mesh) : given_(given), mesh_(mesh) {}

  void build() {
    for (const CouplingSection& coupling : given_.couplings) add(coupling);
    for (const EquationSection& equation : given_.equations) add(equation);
    for (const SupportSection& support : given_.supports) add(support);
    for (const SpringSection& spring : given_.springs) add(spring);
    for (const PointMassSection& mass : given_.masses) add(mass);
  }

 private:
  mesher::Connections& connections() { return mesh_.connections; }

  /// Nodes of a node set, or of a face set.
  std::vector<std::int32_t> nodes_of(const std::string& set) const {
    const auto is_among = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), set) != names.end();
    };
    const bool is_of_faces_only =
        is_among(names_of(mesh_.face_sets)) && !is_among(names_of(mesh_.node_sets));
    return is_of_faces_only ? mesher::nodes_of(mesh_.face_set(set)).nodes
                            : mesh_.node_set(set).nodes;
  }

  void add(const CouplingSection& coupling) {
    const std::string name = "coupling '" + coupling.name + "'";
    const Eigen::Vector3d& x = coupling.position_m;
    const auto point = static_cast<std::int32_t>(connections().points.size());
    try {
      connections().couplings.push_back({name, point, nodes_of(coupling.set), coupling.directions});
    } catch (const InputError& error) {
      throw InputError("modes." + name + ": " + error.what());
    }
    connections().points.push_back({name, {x[0], x[1], x[2]}});
    points_[coupling.name] = point;
  }

  std::int32_t site_of(const std::string& who, const std::string& at, bool is_rotation) const {
    const auto point = points_.find(at);
    if (point != points_.end()) {
      return is_rotation ? mesher::rotation_site(mesh_.nodes.size(), point->second)
                         : mesher::translation_site(mesh_.nodes.size(), point->second);
    }
    try {
      const std::vector<std::int32_t> nodes = nodes_of(at);
      if (is_rotation) {
        throw InputError("node set '" + at + "' has no rotation; define a coupling for it");
      }
      if (nodes.size() != 1) {
        throw InputError("node set '" + at + "' has " + std::to_string(nodes.size()) +
                         " nodes, expected one; define a coupling for it");
      }
      return nodes.front();
    } catch (const InputError& error) {
      throw InputError("modes." + who + ": " + error.what());
    }
  }

  Eigen::Vector3d position_of(std::int32_t site) const {
    const auto nodes = static_cast<std::int32_t>(mesh_.nodes.size());
    return Eigen::Vector3d(
        site < nodes ? mesh_.nodes[static_cast<std::size_t>(site)].data()
                     : mesh_.connections.points[static_cast<std::size_t>(site - nodes) / 2]
                           .position_m.data());
  }

  static mesher::Term term(std::int32_t site, const Eigen::Vector3d& direction) {
    return {site, {direction[0], direction[1], direction[2]}};
  }

  void add(const EquationSection& section) {
    const std::string name = "equation '" + section.name + "'";
    mesher::Equation equation{name, {}};
    for (const ConnectionTerm& each : section.terms) {
      equation.terms.push_back(term(site_of(name, each.at, each.is_rotation), each.direction));
    }
    connections().equations.push_back(std::move(equation));
  }

  void add(const SupportSection& support) {
    const std::string name = "support of '" + support.at + "'";
    if (points_.count(support.at) > 0) {
      add_to_point(support, name);
      return;
    }
    if (support.turns != std::array<bool, 3>{}) {
      throw InputError("modes." + name + ": turns is supported only for a coupling");
    }
    try {
      connections().supports.push_back(
          {name, nodes_of(support.at), support.directions, support.axes});
    } catch (const InputError& error) {
      throw InputError("modes." + name + ": " + error.what());
    }
  }

  void add_to_point(const SupportSection& support, const std::string& name) {
    const std::int32_t site = site_of(name, support.at, false);
    const Eigen::Matrix3d axes = support.axes.at(position_of(site));
    for (Eigen::Index a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(a);
      if (support.directions[i]) {
        connections().equations.push_back({name, {term(site, axes.col(a))}});
      }
      if (support.turns[i]) {
        connections().equations.push_back({name, {term(site + 1, Eigen::Vector3d::Unit(a))}});
      }
    }
  }

  void add(const SpringSection& section) {
    const std::string name = "spring '" + section.name + "'";
    mesher::Spring spring{name, {}, section.stiffness};
    std::vector<std::int32_t> sites;
    for (const std::string& at : section.between) {
      sites.push_back(site_of(name, at, section.is_rotation));
    }
    Eigen::Vector3d direction = section.direction.value_or(Eigen::Vector3d::Zero());
    if (!section.direction) {
      direction = position_of(sites[1]) - position_of(sites[0]);
      if (!(direction.norm() > 0)) {
        throw InputError("modes." + name + ": the two ends coincide; give a direction");
      }
      direction.normalize();
    }
    spring.terms.push_back(term(sites[0], direction));
    if (sites.size() > 1) spring.terms.push_back(term(sites[1], -direction));
    connections().springs.push_back(std::move(spring));
  }

  void add(const PointMassSection& section) {
    const std::string name = "point mass '" + section.name + "'";
    const Eigen::Vector3d& c = section.center_m;
    const Eigen::Matrix3d& i = section.inertia_kg_m2;
    connections().masses.push_back({name,
                                    site_of(name, section.at, false),
                                    section.mass_kg,
                                    {c[0], c[1], c[2]},
                                    {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)}});
  }

  const ModesConnections& given_;
  mesher::Mesh& mesh_;
  std::map<std::string, std::int32_t> points_;  ///< reference points of couplings, by name
};

}  // namespace

void add_study_connections(const Study& study, mesher::Mesh& mesh) {
  mesher::Connections& connections = mesh.connections;
  if (!study.modes.deck_supports) {
    connections.supports.clear();
    std::erase_if(connections.equations,
                  [](const mesher::Equation& equation) { return equation.terms.size() == 1; });
  }
  Builder(study.modes.connections, mesh).build();
  mesher::check(connections, mesh.nodes.size());
}

}  // namespace flexneck::pipeline
