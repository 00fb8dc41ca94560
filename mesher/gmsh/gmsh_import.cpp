// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/gmsh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include <gmsh.h>

#include "geometry/foundation/error.h"
#include "mesher/gmsh/gmsh_groups.h"
#include "mesher/gmsh/gmsh_mesh_import.h"
#include "mesher/gmsh/gmsh_session.h"

namespace flexneck::mesher {
namespace {

/// Name that OpenCASCADE gives to an unnamed shape in a STEP file.
constexpr std::string_view kNoName = "Open CASCADE STEP translator";

/// Part names of volumes: the last component of the label if no other volume has it, else the tag.
std::map<int, std::string> volume_names(const gmsh::vectorpair& volumes) {
  std::map<int, std::string> names;
  std::multiset<std::string> all;
  for (const auto& [dim, tag] : volumes) {
    std::string label;
    gmsh::model::getEntityName(dim, tag, label);
    names[tag] = label.substr(label.rfind('/') + 1);
    if (names[tag].starts_with(kNoName)) names[tag].clear();
    all.insert(names[tag]);
  }
  for (auto& [tag, name] : names) {
    if (name.empty() || all.count(name) > 1) name = "volume_" + std::to_string(tag);
  }
  return names;
}

/// Makes volumes that touch share their faces, without which they would be unconnected. Their tags
/// stay.
void glue(const gmsh::vectorpair& volumes) {
  if (volumes.size() < 2) return;
  gmsh::vectorpair pieces;
  std::vector<gmsh::vectorpair> piece_of;
  gmsh::model::occ::fragment(volumes, {}, pieces, piece_of);
  gmsh::model::occ::synchronize();
  if (pieces.size() != volumes.size()) {
    throw InputError("its volumes overlap: " + std::to_string(volumes.size()) +
                     " of them intersect each other in " + std::to_string(pieces.size()));
  }
}

void name_groups(const std::map<int, std::string>& volumes) {
  for (const auto& [tag, name] : volumes) {
    gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {tag}, tag), name);
  }
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dim, tag] : surfaces) {
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {tag}, tag),
                                 "surface_" + std::to_string(tag));
  }
}

/// Total length, area or volume of the shapes of a dimension: m, m^2 or m^3 if the file is in
/// metres.
double measure_of_all(int dim) {
  gmsh::vectorpair shapes;
  gmsh::model::getEntities(shapes, dim);
  double sum = 0;
  for (const auto& [dimension, tag] : shapes) {
    double measure = 0;
    gmsh::model::occ::getMass(dimension, tag, measure);
    sum += std::abs(measure);
  }
  return sum;
}

/// Estimated number of nodes of a mesh of 10-node tetrahedra with edges of length `size`; correct
/// within a factor of two for bars with holes.
/// @param size  in the shape's unit; 0: a tenth of the shape's diagonal, which is gmsh's default
double estimated_nodes(double size) {
  constexpr std::array kNodesPerEdgeToThe = {0.0, 2.0, 5.0, 7.0};  // indexed by the dimension
  if (size == 0) {
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
    size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 10;
  }
  double nodes = 0;
  for (int dim = 1; dim <= 3; ++dim) {
    nodes += kNodesPerEdgeToThe.at(static_cast<std::size_t>(dim)) * measure_of_all(dim) /
             std::pow(size, dim);
  }
  return nodes;
}

void mesh_shape(const CheckedCopy& copy, const ImportOptions& options, double size) {
  const bool is_step = copy.format() == ForeignFormat::step;
  if (is_step) gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::vectorpair shapes;
  gmsh::model::occ::importShapes(copy.path().string(), shapes, true, is_step ? "step" : "brep");
  gmsh::model::occ::synchronize();
  if (options.when_read) options.when_read(estimated_nodes(size));
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  if (volumes.empty()) throw InputError(options.file.string() + ": the shape has no volume");
  const std::map<int, std::string> names = volume_names(volumes);
  glue(volumes);
  name_groups(names);
  if (size > 0) {  // gmsh's default is a tenth of the shape's diagonal
    gmsh::vectorpair points;
    gmsh::model::getEntities(points, 0);
    gmsh::model::mesh::setSize(points, size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  }
  gmsh::option::setNumber("Mesh.Algorithm3D", 1);  // the algorithm that gives the same mesh in
                                                   // every run
  gmsh::option::setNumber("Mesh.ElementOrder", 2);
  gmsh::option::setNumber("Mesh.HighOrderOptimize", 1);
  gmsh::model::mesh::generate(3);
}

/// Group names in $PhysicalNames: lines `dimension tag "name"`, text in binary files too. gmsh
/// forgets the name of a group if another one of its dimension already has it.
GroupNames names_in(const std::string& contents) {
  GroupNames names;
  const std::size_t begin = contents.find("\n$PhysicalNames");
  if (begin == std::string::npos) return names;
  std::istringstream lines(
      contents.substr(begin, contents.find("$EndPhysicalNames", begin) - begin));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    int dimension = 0;
    int tag = 0;
    std::string name;
    if (fields >> dimension >> tag >> std::quoted(name)) names[{dimension, tag}] = name;
  }
  return names;
}

/// Dimension of an element type; zero for a type that gmsh does not know, for which it refuses the
/// file.
int dimension_of(int element_type, GmshSession& session) {
  int dimension = 0;
  session.errors_of([&] { dimension = gmsh_element_type(element_type).dimension; });
  return dimension;
}

/// Number of a group's elements, and the sum of hashes of their nodes.
using Elements = std::pair<std::size_t, std::size_t>;

/// Refuses files that assign elements of one shape to different groups. gmsh groups elements by the
/// shapes on which they lie, so each group would have them all. In text of version 2, $Elements has
/// lines `number type tags group shape … nodes`, repeated for each group.
void require_whole_shapes(const std::string& contents, GmshSession& session) {
  std::istringstream lines(contents);
  std::string line;
  int major = 0;
  char point = 0;
  int minor = 0;
  int is_binary = 1;
  std::getline(lines, line);
  if (!(lines >> major >> point >> minor >> is_binary) || major != 2 || is_binary != 0) return;
  while (std::getline(lines, line) && !line.starts_with("$Elements")) {
  }
  std::map<std::pair<int, int>, std::map<int, Elements>> shapes;  // by dimension and tag, by group
  std::map<int, int> dimensions;
  while (std::getline(lines, line) && !line.starts_with("$EndElements")) {
    std::istringstream fields(line);
    int number = 0;
    int type = 0;
    int tags = 0;
    int group = 0;
    int shape = 0;
    if (!(fields >> number >> type >> tags >> group >> shape) || tags < 2) continue;
    const auto [known, is_new] = dimensions.try_emplace(type);
    if (is_new) known->second = dimension_of(type, session);
    Elements& own = shapes[{known->second, shape}][group];
    ++own.first;
    std::string nodes;
    std::getline(fields, nodes);
    own.second += std::hash<std::string>()(nodes);
  }
  for (const auto& [shape, groups] : shapes) {
    for (const auto& [group, own] : groups) {
      if (own == groups.begin()->second) continue;
      throw InputError("physical groups " + std::to_string(groups.begin()->first) + " and " +
                       std::to_string(group) +
                       " have different elements of the elementary entity " +
                       std::to_string(shape.second) +
                       ", which gmsh would assign to both; use separate entities for each group");
    }
  }
}

}  // namespace

Mesh import_with_gmsh(const CheckedCopy& copy, const ImportOptions& options, LeftOut& left_out) {
  GmshSession session;
  const bool is_step = copy.format() == ForeignFormat::step;
  const bool is_shape = is_step || copy.format() == ForeignFormat::brep;
  const double scale = is_step ? 1 : options.length_unit_m;
  const std::string contents = is_shape ? "" : checked_contents(options.file);
  require_whole_shapes(contents, session);
  const std::string errors = session.errors_of([&] {
    if (is_shape) {
      mesh_shape(copy, options, options.element_size_m / scale);
    } else {
      gmsh::merge(copy.path().string());
    }
  });
  if (!errors.empty()) {
    throw InputError("gmsh cannot " + std::string(is_shape ? "mesh" : "read") + " it: " + errors);
  }
  Mesh mesh =
      is_shape ? import_gmsh_mesh(options.materials, options.material_of_part, GmshSource::script)
               : import_gmsh_mesh(options.materials, options.material_of_part,
                                  GmshSource::foreign_file, names_in(contents));
  for (auto& node : mesh.nodes) {
    for (double& x : node) x *= scale;
  }
  if (is_shape) return mesh;
  for (const auto& [kind, count] : gmsh_elements_off_volumes()) left_out.add(kind, count);
  return mesh;
}

}  // namespace flexneck::mesher
