// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/provenance.h"

#include <algorithm>
#include <vector>

#include "geometry/foundation/hdf5_file.h"

namespace flexneck {

namespace {

template <typename Records, typename Field>
std::vector<std::string> column(const Records& records, Field field) {
  std::vector<std::string> values;
  values.reserve(records.size());
  for (const auto& record : records) values.emplace_back(field(record));
  return values;
}

Origin origin_from(const Hdf5Reader& file, const std::string& name) {
  const auto* const found = std::find(kOriginNames.begin(), kOriginNames.end(), name);
  if (found == kOriginNames.end()) {
    file.refuse("/provenance/parameters/origin", "unknown origin '" + name + "'");
  }
  return static_cast<Origin>(found - kOriginNames.begin());
}

}  // namespace

std::vector<InputFile> input_files(const std::vector<FileRead>& reads) {
  std::vector<InputFile> files;
  for (const FileRead& read : reads)
    if (has_content(read))
      files.push_back({std::filesystem::path(read.path).filename().string(), read.hash});
  return files;
}

void write_provenance(Hdf5Writer& file, const Provenance& provenance) {
  const std::string group = "/provenance";
  file.write_attribute(group, "program", provenance.program);
  file.write_attribute(group, "git_hash", provenance.git_hash);
  for (const auto& [name, version] : provenance.libraries) {
    file.write_attribute(group + "/libraries", name, version);
  }
  const auto& inputs = provenance.inputs;
  file.write(group + "/inputs/name", column(inputs, [](const InputFile& i) { return i.name; }));
  file.write(group + "/inputs/hash", column(inputs, [](const InputFile& i) { return i.hash; }));
  const auto& parameters = provenance.parameters;
  const std::string table = group + "/parameters/";
  file.write(table + "key", column(parameters, [](const Parameter& p) { return p.key; }));
  file.write(table + "value", column(parameters, [](const Parameter& p) { return p.value; }));
  file.write(table + "origin",
             column(parameters, [](const Parameter& p) { return name_of(p.origin); }));
  file.write(table + "note", column(parameters, [](const Parameter& p) { return p.note; }));
}

Provenance read_provenance(const Hdf5Reader& file) {
  const std::string group = "/provenance";
  Provenance provenance;
  if (!file.has(group)) return provenance;
  provenance.program = file.string_attribute(group, "program");
  provenance.git_hash = file.string_attribute(group, "git_hash");
  for (const std::string& name : file.attributes(group + "/libraries")) {
    provenance.libraries[name] = file.string_attribute(group + "/libraries", name);
  }
  const auto names = file.read_strings(group + "/inputs/name");
  const auto hashes = file.read_strings(group + "/inputs/hash");
  const auto keys = file.read_strings(group + "/parameters/key");
  const auto values = file.read_strings(group + "/parameters/value");
  const auto origins = file.read_strings(group + "/parameters/origin");
  const auto notes = file.read_strings(group + "/parameters/note");
  if (hashes.size() != names.size() || values.size() != keys.size() ||
      origins.size() != keys.size() || notes.size() != keys.size()) {
    file.refuse(group, "expected columns of equal length");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    provenance.inputs.push_back({names[i], hashes[i]});
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    provenance.parameters.push_back({keys[i], values[i], origin_from(file, origins[i]), notes[i]});
  }
  return provenance;
}

}  // namespace flexneck
