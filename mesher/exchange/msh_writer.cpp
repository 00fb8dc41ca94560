// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/msh_writer.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {
namespace {

constexpr int kPointType = 15;  ///< gmsh's element of one node

/// Writes numbers as the format wants them: as text in a line, or as their bytes.
class MshStream {
 public:
  MshStream(const std::filesystem::path& file, MshEncoding encoding)
      : file_(file), is_binary_(encoding == MshEncoding::binary) {}

  MshStream& integer(int number) {
    return put(number, [&] { return std::to_string(number); });
  }
  MshStream& size(std::size_t number) {
    return put(number, [&] { return std::to_string(number); });
  }
  MshStream& number(double number) {
    return put(number, [&] { return exact_text(number); });
  }
  /// Ends a line of numbers; binary numbers have no line ends.
  void end_line() {
    if (!is_binary_) file_.write("\n");
    at_start_ = true;
  }
  /// Writes text on a line of its own in either encoding.
  void text(const std::string& line) { file_.write(line + "\n"); }
  void begin(const std::string& section) { text("$" + section); }
  void end(const std::string& section) {
    if (is_binary_) file_.write("\n");
    text("$End" + section);
  }
  bool is_binary() const { return is_binary_; }
  void commit() { file_.commit(); }

 private:
  template <class Number, class Text>
  MshStream& put(Number number, const Text& text) {
    if (is_binary_) {
      std::array<char, sizeof(Number)> bytes{};
      std::memcpy(bytes.data(), &number, sizeof(Number));
      file_.write({bytes.data(), bytes.size()});
    } else {
      file_.write(at_start_ ? text() : " " + text());
      at_start_ = false;
    }
    return *this;
  }

  OutputFile file_;
  bool is_binary_;
  bool at_start_ = true;
};

/// Elements of one entity and type.
struct Rows {
  int type = 0;
  std::size_t nodes_per_row = 0;
  std::span<const std::int32_t> nodes;
};

/// An entity of gmsh's model and its physical group, both with the same tag.
struct Entity {
  int dimension = 0;
  int tag = 0;
  std::string name;
  std::vector<Rows> rows;
};

Entity& entity_named(std::vector<Entity>& entities, int dimension, const std::string& name) {
  const auto found = std::find_if(entities.begin(), entities.end(), [&](const Entity& entity) {
    return entity.dimension == dimension && entity.name == name;
  });
  if (found != entities.end()) return *found;
  const auto before = std::count_if(entities.begin(), entities.end(), [&](const Entity& entity) {
    return entity.dimension == dimension;
  });
  return entities.emplace_back(Entity{dimension, static_cast<int>(before) + 1, name, {}});
}

Rows rows_of(ElementKind kind, const std::vector<std::int32_t>& nodes) {
  return {traits_of(kind).gmsh_type, nodes_per_element(kind), nodes};
}

/// The entities in the order of the format: points first, volumes last.
std::vector<Entity> entities_of(const Mesh& mesh) {
  std::vector<Entity> entities;
  for (const NodeSet& set : mesh.node_sets) {
    const bool is_of_faces =
        std::any_of(mesh.face_sets.begin(), mesh.face_sets.end(), [&](const FaceSet& faces) {
          return faces.name == set.name && nodes_of(faces).nodes == set.nodes;
        });
    if (!is_of_faces)
      entity_named(entities, 0, set.name).rows.push_back({kPointType, 1, set.nodes});
  }
  for (const FaceSet& set : mesh.face_sets) {
    for (const FaceBlock& block : set.blocks) {
      entity_named(entities, 2, set.name).rows.push_back(rows_of(block.kind, block.nodes));
    }
  }
  for (const ElementBlock& block : mesh.blocks) {
    entity_named(entities, 3, block.part).rows.push_back(rows_of(block.kind, block.nodes));
  }
  return entities;
}

void check_expressible(const Mesh& mesh, const std::vector<Entity>& entities) {
  for (const Entity& entity : entities) {
    if (entity.name.find_first_of("\"\r\n") != std::string::npos) {
      throw InputError("the name '" + entity.name + "' is not allowed in a .msh file");
    }
  }
  for (const Slit& slit : mesh.slits) {
    if (slit.tied) {
      throw InputError("slit '" + slit.name +
                       "' is tied, which a .msh file cannot express; mesh without slits instead, "
                       "which gives the same modes");
    }
  }
}

void write_header(MshStream& out) {
  out.begin("MeshFormat");
  out.text(out.is_binary() ? "4.1 1 8" : "4.1 0 8");
  if (out.is_binary()) {
    out.integer(1);
    out.end("MeshFormat");
  } else {
    out.text("$EndMeshFormat");
  }
}

/// Writes the physical names, which are text in either encoding.
void write_names(MshStream& out, const std::vector<Entity>& entities) {
  out.begin("PhysicalNames");
  out.text(std::to_string(entities.size()));
  for (const Entity& entity : entities) {
    out.text(std::to_string(entity.dimension) + " " + std::to_string(entity.tag) + " \"" +
             entity.name + "\"");
  }
  out.text("$EndPhysicalNames");
}

void write_entities(MshStream& out, const std::vector<Entity>& entities, const BoundingBox& box) {
  out.begin("Entities");
  for (int dimension = 0; dimension <= 3; ++dimension) {
    out.size(static_cast<std::size_t>(
        std::count_if(entities.begin(), entities.end(),
                      [&](const Entity& entity) { return entity.dimension == dimension; })));
  }
  out.end_line();
  for (const Entity& entity : entities) {
    out.integer(entity.tag);
    for (const double x : box.low_m) out.number(x);
    if (entity.dimension > 0) {
      for (const double x : box.high_m) out.number(x);
    }
    out.size(1).integer(entity.tag);
    if (entity.dimension > 0) out.size(0);  // number of bounding entities
    out.end_line();
  }
  out.end("Entities");
}

/// Writes all nodes as the first volume's: readers of elements do not need the entity of a node.
void write_nodes(MshStream& out, const Mesh& mesh) {
  const std::size_t count = mesh.nodes.size();
  out.begin("Nodes");
  out.size(1).size(count).size(1).size(count).end_line();
  out.integer(3).integer(1).integer(0).size(count).end_line();
  for (std::size_t n = 0; n < count; ++n) out.size(n + 1).end_line();
  for (const auto& x : mesh.nodes) out.number(x[0]).number(x[1]).number(x[2]).end_line();
  out.end("Nodes");
}

void write_elements(MshStream& out, const std::vector<Entity>& entities) {
  std::size_t blocks = 0;
  std::size_t count = 0;
  for (const Entity& entity : entities) {
    blocks += entity.rows.size();
    for (const Rows& rows : entity.rows) count += rows.nodes.size() / rows.nodes_per_row;
  }
  out.begin("Elements");
  out.size(blocks).size(count).size(1).size(count).end_line();
  std::size_t tag = 0;
  for (const Entity& entity : entities) {
    for (const Rows& rows : entity.rows) {
      const std::size_t n = rows.nodes_per_row;
      out.integer(entity.dimension).integer(entity.tag).integer(rows.type);
      out.size(rows.nodes.size() / n).end_line();
      for (std::size_t first = 0; first < rows.nodes.size(); first += n) {
        out.size(++tag);
        for (const std::int32_t node : rows.nodes.subspan(first, n)) {
          out.size(static_cast<std::size_t>(node) + 1);
        }
        out.end_line();
      }
    }
  }
  out.end("Elements");
}

}  // namespace

void write_msh(const std::filesystem::path& file, const Mesh& mesh, MshEncoding encoding) {
  const std::vector<Entity> entities = entities_of(mesh);
  check_expressible(mesh, entities);
  MshStream out(file, encoding);
  write_header(out);
  write_names(out, entities);
  write_entities(out, entities, bounding_box(mesh));
  write_nodes(out, mesh);
  write_elements(out, entities);
  out.commit();
}

}  // namespace flexneck::mesher
