// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/exchange/exudyn_file.h"
#include "fe_modal/exchange/mbdyn_fem.h"
#include "fe_modal/exchange/sid_fem.h"
#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/process/result_files.h"
#include "pipeline/run/results_folder.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Data that a certain format cannot hold, besides those that no foreign format can.
struct Losses {
  bool node_shapes = true;  ///< shapes at nodes other than interfaces
  bool names = false;       ///< names of the modes and of their kinds
};

void add(std::string& list, bool is_there, const std::string& what) {
  if (is_there) list += (list.empty() ? "" : ", ") + what;
}

/// List of the data of the body that a foreign file loses.
std::string lost(const fe_modal::ModalBody& body, const Losses& losses) {
  std::string list;
  add(list, losses.node_shapes, fmt::format("shapes at {} nodes", body.nodes_m.cols()));
  add(list, losses.names, "names and kinds of modes");
  add(list, body.geometric_stiffness.has_value(), "geometric stiffness");
  add(list,
      std::any_of(body.interfaces.begin(), body.interfaces.end(),
                  [](const auto& interface) { return interface.response.has_value(); }),
      "static responses of interfaces");
  add(list, !body.attached.empty(), "frequencies with attached bodies");
  add(list, true, "completeness check and provenance");
  return list;
}

/// Reads the body without its rigid modes, since a floating body's frame has these motions itself.
fe_modal::ModalBody body_to_write(const FileInput& input, const Losses& losses) {
  const fs::path& file = input.files.front();
  fe_modal::ModalBody body = read_modal_body(file).body;
  if (!body.slits.empty())
    throw InputError(file.string() +
                     ": the body has slits that open and close, which no other format supports");
  if (body.interfaces.empty())
    throw InputError(file.string() +
                     ": the body has no interface at which other bodies could be attached");
  const auto rigid = std::count_if(body.modes.begin(), body.modes.end(), [](const auto& mode) {
    return mode.kind == fe_modal::kRigidMode;
  });
  if (rigid == static_cast<std::ptrdiff_t>(body.modes.size()))
    throw InputError(file.string() + ": the body has only rigid-body modes");
  std::string list = lost(body, losses);
  if (rigid > 0) {
    body = fe_modal::select_modes(body, {"all"});
    add(list, true, fmt::format("{} rigid-body modes", rigid));
  }
  input.console.warning(input.target.string() + ": not carried over: " + list);
  return body;
}

struct Reader {
  std::string_view ending;
  fe_modal::ImportedModes (*read)(const fs::path&);
};
constexpr std::array<Reader, 2> kReaders = {
    {{".fem", fe_modal::read_mbdyn_fem}, {".SID_FEM", fe_modal::read_sid_fem}}};

}  // namespace

void export_mbdyn_body(const FileInput& input) {
  fe_modal::write_mbdyn_fem(input.target, body_to_write(input, {}));
}

void export_sid_body(const FileInput& input) {
  fe_modal::write_sid_fem(input.target, body_to_write(input, {}));
}

void export_exudyn_body(const FileInput& input) {
  fe_modal::write_exudyn(input.target, body_to_write(input, {.node_shapes = false, .names = true}));
}

void import_body(const FileInput& input) {
  const fs::path& file = input.files.front();
  const auto reader = std::find_if(kReaders.begin(), kReaders.end(), [&](const Reader& each) {
    return file.extension() == each.ending;
  });
  if (reader == kReaders.end())
    throw InputError(file.string() +
                     ": expected a body in a .fem (MBDyn) or .SID_FEM file for an export to " +
                     input.target.string());
  fe_modal::ImportedModes imported = reader->read(file);
  fe_modal::write_modal_body(
      input.target, {std::move(imported.body),
                     provenance_of({{file.filename().string(), hash_of_file(file.string())}}, {})});
  for (const std::string& note : imported.notes) input.console.warning(file.string() + ": " + note);
}

}  // namespace flexneck::pipeline
