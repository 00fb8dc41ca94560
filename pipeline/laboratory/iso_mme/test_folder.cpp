// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/test_folder.h"

#include <algorithm>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/printable.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"
#include "pipeline/laboratory/iso_mme/descriptor_file.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return text;
}

std::string ending_of(const fs::path& path) { return lower(path.extension().string()); }

/// True for three digits or more: the extension of a channel's file.
bool is_number_ending(const std::string& ending) {
  return ending.size() > 3 && ending.find_first_not_of("0123456789", 1) == std::string::npos;
}

/// Paths in a folder that a predicate accepts, in alphabetical order.
template <class Takes>
std::vector<fs::path> entries(const fs::path& folder, const Takes& takes) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (takes(at->path())) found.push_back(at->path());
  if (error)
    throw InputError(folder.string() + ": the folder cannot be read (" + error.message() + ")");
  std::sort(found.begin(), found.end());
  return found;
}

/// The .mme file of a folder with a test.
fs::path test_in(const fs::path& folder) {
  const auto tests =
      entries(folder, [](const fs::path& path) { return ending_of(path) == ".mme"; });
  if (tests.size() == 1) return tests.front();
  throw InputError(
      folder.string() + ": expected a folder with one ISO-MME test, that is, one .mme file, " +
      (tests.empty() ? "found none"
                     : "found " + std::to_string(tests.size()) + "; name one of them"));
}

fs::path index_of(const fs::path& test) {
  const DescriptorFile descriptors(test);
  if (descriptors.descriptors().empty() || !descriptors.samples().empty())
    throw InputError(test.string() + ": expected an ISO-MME test with lines \"Key :value\"");
  const fs::path folder = test.has_parent_path() ? test.parent_path() : fs::path(".");
  std::vector<fs::path> places = entries(folder, [](const fs::path& path) {
    std::error_code ignored;
    return lower(path.filename().string()) == "channel" && fs::is_directory(path, ignored);
  });
  places.push_back(folder);
  const std::string name = lower(test.stem().string()) + ".chn";
  for (const fs::path& place : places) {
    const auto found = entries(
        place, [&](const fs::path& path) { return lower(path.filename().string()) == name; });
    if (!found.empty()) return found.front();
  }
  throw InputError(test.string() + ": expected the channel index Channel/" + test.stem().string() +
                   ".chn, found none");
}

struct IndexRow {
  std::string number, code;
};

/// Rows of an index, such as "Name of channel 001 :11NECKUP00H3MOYB / Neck Upper Moment Y".
std::vector<IndexRow> rows_of(const fs::path& path) {
  constexpr std::string_view kKey = "name of channel ";
  const DescriptorFile index(path);
  std::vector<IndexRow> rows;
  for (const DescriptorFile::Line& line : index.descriptors()) {
    if (!lower(line.key).starts_with(kKey)) continue;
    const std::string number = line.key.substr(kKey.size());
    const std::string code = line.text.substr(0, line.text.find_first_of("/ \t"));
    if (!is_number_ending("." + number) || !is_mme_code(code))
      index.refuse(line,
                   "expected \"Name of channel 001 :CODE / name\" with a code of 16 letters "
                   "and digits, found \"" +
                       printable(line.key + " :" + line.text) + "\"");
    rows.push_back({number, code});
  }
  const auto* const count = index.find("Number of channels");
  if (count != nullptr && index.number(*count) != static_cast<double>(rows.size()))
    index.refuse(*count, "expected as many channels as the index says, found " +
                             std::to_string(rows.size()) + "; the file may be truncated");
  if (rows.empty()) index.refuse("expected lines \"Name of channel 001 :CODE / name\", found none");
  return rows;
}

const IndexRow& row_of(const std::vector<IndexRow>& rows, const fs::path& test,
                       const std::string& code) {
  std::vector<std::string> codes;
  std::string listed;
  for (const IndexRow& row : rows) {
    codes.push_back(row.code);
    listed += (listed.empty() ? "'" : ", '") + row.code + "'";
  }
  if (code.empty() && rows.size() == 1) return rows.front();
  if (code.empty())
    throw InputError(test.string() + ": there are several channels; choose one of " + listed);
  if (std::count(codes.begin(), codes.end(), code) > 1)
    throw InputError(test.string() + ": there are several channels '" + code +
                     "'; name the file of one of them, such as Channel/" + test.stem().string() +
                     ".001");
  try {
    return rows[find_name(codes, code, "channel")];
  } catch (const InputError& error) {
    throw InputError(test.string() + ": " + error.what());
  }
}

FoundMmeChannel read_as(const fs::path& file, const std::string& code) {
  FoundMmeChannel found{file, read_mme_channel_file(file)};
  if (!code.empty() && found.channel.code != code)
    throw InputError(file.string() + ": expected the channel '" + code + "', found '" +
                     found.channel.code + "'");
  return found;
}

}  // namespace

bool names_mme_test(const fs::path& path) {
  const std::string ending = ending_of(path);
  std::error_code ignored;
  return ending == ".mme" || ending == ".chn" || is_number_ending(ending) ||
         fs::is_directory(path, ignored);
}

FoundMmeChannel read_mme_channel(const fs::path& path, const std::string& code) {
  if (is_number_ending(ending_of(path))) return read_as(path, code);
  const bool is_index = ending_of(path) == ".chn";
  const fs::path test = is_index || ending_of(path) == ".mme" ? path : test_in(path);
  const fs::path index = is_index ? path : index_of(test);
  const std::vector<IndexRow> rows = rows_of(index);
  const IndexRow& row = row_of(rows, test, code);
  return read_as(fs::path(index).replace_extension("." + row.number), row.code);
}

}  // namespace flexneck::pipeline
