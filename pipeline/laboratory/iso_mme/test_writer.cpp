// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/test_writer.h"

#include <fmt/core.h>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/atomic_folder.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/laboratory/iso_mme/channel_text.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxChannels = 999;  ///< numbers of three digits

std::string test_text(const std::string& name, const MmeTest& test) {
  std::string text =
      mme_line("Data format edition number", "1.6") + mme_line("Laboratory name", "") +
      mme_line("Laboratory test ref. number", name) + mme_line("Customer name", "") +
      mme_line("Customer test ref. number", "") + mme_line("Title", test.title) +
      mme_line("Medium No./number of media", "1/1") + mme_line("Timestamp", "") +
      mme_line("Type of the test", test.type) + mme_line("Subtype of the test", "") +
      mme_line("Regulation", "") + mme_line("Date of the test", "") +
      mme_line("Number of test objects", "1") + mme_line("Name of test object 1", test.object) +
      mme_line("Class of test object 1", "") + mme_line("Ref. number of test object 1", "");
  for (const std::string& comment : test.comments) text += mme_line("Comments", comment);
  return text;
}

std::string index_text(const MmeTest& test) {
  std::string text = mme_line("Instrumentation standard", "SAE J211") +
                     mme_line("Number of channels", std::to_string(test.channels.size()));
  int number = 0;
  for (const MmeChannel& channel : test.channels)
    text += mme_line(fmt::format("Name of channel {:03}", ++number),
                     channel.code + " / " + channel.name);
  return text;
}

/// Fails if the folder holds files other than those of an earlier test of that name.
void require_own(const fs::path& folder, const std::string& name) {
  const auto foreign = [&](const fs::path& in, const fs::path& allowed) {
    for (const auto& entry : fs::directory_iterator(in)) {
      const bool is_own = entry.path().stem() == name && entry.path().has_extension();
      if (!is_own && entry.path().filename() != allowed) return entry.path();
    }
    return fs::path();
  };
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": expected a folder");
  fs::path other = foreign(folder, "Channel");
  if (other.empty() && fs::is_directory(folder / "Channel"))
    other = foreign(folder / "Channel", {});
  if (other.empty()) return;
  throw InputError(folder.string() + ": expected a new folder, or one with only the test " + name +
                   ", found " + other.filename().string() + " in it; choose another name");
}

}  // namespace

void write_mme_test(const fs::path& path, const MmeTest& test) {
  const std::string name = path.stem().string();
  const fs::path folder = path.parent_path();
  if (folder.filename() != name)
    throw InputError(path.string() + ": expected " + (folder / name / (name + ".mme")).string() +
                     "; an ISO-MME test is written to a folder of the same name");
  if (test.channels.empty() || test.channels.size() > kMaxChannels)
    throw InputError(fmt::format("{}: expected 1 to {} channels, found {}", path.string(),
                                 kMaxChannels, test.channels.size()));
  require_own(folder, name);
  AtomicFolder fresh(folder);
  const fs::path channels = fresh / "Channel";
  fs::create_directory(channels);
  write_text(fresh / (name + ".mme"), test_text(name, test));
  write_text(channels / (name + ".chn"), index_text(test));
  int number = 0;
  for (const MmeChannel& channel : test.channels)
    write_text(channels / fmt::format("{}.{:03}", name, ++number), mme_channel_text(channel));
  sync_folder(channels);
  fresh.commit();
}

}  // namespace flexneck::pipeline
