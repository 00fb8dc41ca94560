// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/loads.h"

#include <algorithm>
#include <functional>
#include <set>
#include <span>

#include <Eigen/Geometry>

#include "fe_modal/system/rigid_average.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/face_orientation.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

/// Largest distance of a node from the position that names it, relative to the size of the body.
constexpr double kSamePlace = 1e-6;

std::string text_of(const Eigen::Vector3d& v) { return "(" + rounded_texts({v.data(), 3}) + ")"; }

/// Calls visit(nodes, shape function values, normal dA) for each integration point of some faces.
void for_each_face_point(
    const mesher::Mesh& mesh, const mesher::FaceBlock& faces,
    const std::function<void(std::span<const std::int32_t>, const Eigen::VectorXd&,
                             const Eigen::Vector3d&)>& visit) {
  const mesher::Quadrature rule = mesher::gauss_rule(faces.kind, 3);
  const mesher::ShapeTable table = mesher::tabulate(faces.kind, rule.points);
  const std::size_t width = mesher::nodes_per_element(faces.kind);
  Eigen::Matrix3Xd coordinates;
  for (std::size_t first = 0; first < faces.nodes.size(); first += width) {
    const auto nodes = std::span(faces.nodes).subspan(first, width);
    mesher::copy_positions(mesh, nodes, coordinates);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d along_xi = coordinates * table.derivatives[0].col(q);
      const Eigen::Vector3d along_eta = coordinates * table.derivatives[1].col(q);
      visit(nodes, table.values.col(q), rule.weights[q] * along_xi.cross(along_eta));
    }
  }
}

Eigen::Vector3d centroid_of(const mesher::Mesh& mesh, const mesher::FaceSet& faces) {
  double area = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const mesher::FaceBlock& block : faces.blocks) {
    for_each_face_point(mesh, block,
                        [&](auto nodes, const Eigen::VectorXd& values, const auto& normal) {
                          area += normal.norm();
                          moment += normal.norm() * (mesher::positions_of(mesh, nodes) * values);
                        });
  }
  return moment / area;
}

/// Faces of the boundary with their normals outwards.
mesher::FaceSet boundary_faces(const mesher::Mesh& mesh, const std::string& name) {
  mesher::FaceSet faces = mesh.face_set(name);
  std::set<mesher::FacetKey> boundary;
  for (const mesher::Facet& facet : mesher::boundary_facets(mesh))
    boundary.insert(mesher::key_of_face(facet.kind, facet.nodes));
  for (mesher::FaceBlock& block : faces.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      const auto nodes = std::span(std::as_const(block.nodes)).subspan(first, width);
      if (boundary.count(mesher::key_of_face(block.kind, nodes)) == 0)
        throw InputError("face set '" + name +
                         "' has faces inside the body, expected only boundary faces");
    }
    mesher::orient_outwards(mesh, name, block);
  }
  return faces;
}

std::int32_t node_at(const mesher::Mesh& mesh, const Eigen::Vector3d& position_m) {
  const auto nodes_m = mesher::positions_of(mesh);
  Eigen::Index nearest = 0;
  const double distance_m = (nodes_m.colwise() - position_m).colwise().norm().minCoeff(&nearest);
  if (distance_m > kSamePlace * mesher::bounding_box(mesh).extent_m().norm())
    throw InputError("there is no node at " + text_of(position_m) + " m; the nearest is at " +
                     text_of(nodes_m.col(nearest)) + " m");
  return static_cast<std::int32_t>(nearest);
}

/// Adds the nodal forces of a load of any kind.
class NodalForces {
 public:
  NodalForces(const mesher::Mesh& mesh, const NodalMass& nodal_mass, Eigen::Matrix3Xd& forces_N)
      : mesh_(mesh), nodal_mass_(nodal_mass), forces_N_(forces_N) {}

  void operator()(const GravityLoad& load) const {
    const Eigen::MatrixX3d field =
        load.acceleration_m_s2.transpose().replicate(forces_N_.cols(), 1);
    forces_N_ += Eigen::MatrixX3d(nodal_mass_ * field).transpose();
    for (const mesher::PointMass& mass : mesh_.connections.masses) {
      if (mass.site < forces_N_.cols())
        forces_N_.col(mass.site) += mass.mass_kg * load.acceleration_m_s2;
    }
  }

  void operator()(const FaceLoad& load) const {
    const mesher::FaceSet& faces = mesh_.face_set(load.set);
    const Eigen::Vector3d point_m = load.position_m.value_or(centroid_of(mesh_, faces));
    const auto weights = RigidAverage(mesh_, faces, point_m).weights(forces_N_.cols());
    for (std::size_t i = 0; i < 3; ++i) {
      forces_N_ += load.force_N[static_cast<Eigen::Index>(i)] * weights[i] +
                   load.moment_Nm[static_cast<Eigen::Index>(i)] * weights[3 + i];
    }
  }

  void operator()(const PressureLoad& load) const {
    for (const mesher::FaceBlock& block : boundary_faces(mesh_, load.set).blocks) {
      for_each_face_point(mesh_, block,
                          [&](auto nodes, const Eigen::VectorXd& values, const auto& normal) {
                            for (std::size_t i = 0; i < nodes.size(); ++i) {
                              forces_N_.col(nodes[i]) -=
                                  load.pressure_Pa * values[static_cast<Eigen::Index>(i)] * normal;
                            }
                          });
    }
  }

  void operator()(const NodeLoad& load) const {
    if (load.position_m) {
      forces_N_.col(node_at(mesh_, *load.position_m)) += load.force_N;
      return;
    }
    for (const std::int32_t node : mesh_.node_set(load.set).nodes)
      forces_N_.col(node) += load.force_N;
  }

  void operator()(const SupportLoad& /*load*/) const {}

 private:
  const mesher::Mesh& mesh_;
  const NodalMass& nodal_mass_;
  Eigen::Matrix3Xd& forces_N_;
};

struct Words {
  std::string operator()(const GravityLoad& load) const {
    return "gravity " + text_of(load.acceleration_m_s2) + " m/s^2";
  }
  std::string operator()(const FaceLoad& load) const {
    std::string text = "face '" + load.set + "'";
    if (load.force_N.norm() > 0 || load.moment_Nm.norm() == 0)
      text += ", force " + text_of(load.force_N) + " N";
    if (load.moment_Nm.norm() > 0) text += ", moment " + text_of(load.moment_Nm) + " N m";
    return text +
           (load.position_m ? " at " + text_of(*load.position_m) + " m" : " at its centroid");
  }
  std::string operator()(const PressureLoad& load) const {
    return "face '" + load.set + "', pressure " + rounded_text(load.pressure_Pa) + " Pa";
  }
  std::string operator()(const NodeLoad& load) const {
    const std::string where = load.position_m ? "the node at " + text_of(*load.position_m) + " m"
                                              : "each node of '" + load.set + "'";
    return "force " + text_of(load.force_N) + " N on " + where;
  }
  std::string operator()(const SupportLoad& load) const {
    std::string text = "support '" + load.set + "' moves by " + text_of(load.translation_m) + " m";
    if (load.rotation_rad.norm() > 0)
      text += ", rotates by " + text_of(load.rotation_rad) + " rad about " +
              text_of(load.position_m) + " m";
    return text;
  }
};

}  // namespace

std::string describe(const Load& load) { return load.name + ": " + std::visit(Words(), load.kind); }

Eigen::Matrix3Xd nodal_forces(const mesher::Mesh& mesh, const NodalMass& nodal_mass,
                              const std::vector<Load>& loads) {
  Eigen::Matrix3Xd forces_N =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  const NodalForces add(mesh, nodal_mass, forces_N);
  for (const Load& load : loads) {
    try {
      std::visit(add, load.kind);
    } catch (const InputError& error) {
      throw InputError("load '" + load.name + "': " + error.what());
    }
  }
  return forces_N;
}

}  // namespace flexneck::fe_modal
