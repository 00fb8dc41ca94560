// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/temporary_folder.h"
#include "tests/support/model_text.h"

namespace flexneck::testing {

// A fictitious test in the format of a laboratory's program.
inline const std::string kMmeTest =
    "Data format edition number  :1.6\nLaboratory name             :NOVALUE\n"
    "Title                       :a made-up test, to read\n"
    "Regulation                  :\nMovie reference\t\t:NOVALUE\n\n"
    "Comments                    :Time zero: first contact\n"
    "Comments                    :another line of the same key\n";
inline const std::string kMmeIndex =
    "Instrumentation standard    :SAEJ211\nNumber of channels          :2\n"
    "Name of channel 001         :11NECKUP00H3MOYP / Neck Upper Moment Y\n"
    "Name of channel 002         :11HEADCG00H3ACXA / Head CG\n";
inline const std::string kMmeMoment =
    "Channel code                :11NECKUP00H3MOYP\n"
    "Reference channel           :implicit\nReference channel name      :NOVALUE\n"
    "Name of the channel         :Neck Upper Moment Y\n"
    "Channel frequency class     :600\nSampling interval           :0.0001\n"
    "Unit                        :Nm\nTime of first sample        :-0.0002\n"
    "Number of samples           :6\nDimension                   :MO\n"
    "-6.774550E-4\n-6.774550E-4\n0.000000E+0\n8.210000E-3\n1.642828E-2\n+1.5E-2\n";
inline const std::string kMmeAcceleration =
    "Channel code                :11HEADCG00H3ACXA\nReference channel           :implicit\n"
    "Sampling interval           :5E-05\nUnit                        :g\n"
    "Time of first sample        :0\nNumber of samples           :3\n1\n-2\n0.5\n";

/// A folder with test.mme and the files that belong to it.
class MmeFolder {
 public:
  MmeFolder() {
    std::filesystem::create_directory(folder_ / "Channel");
    write("test.mme", kMmeTest);
    write("Channel/test.chn", kMmeIndex);
    write("Channel/test.001", kMmeMoment);
    write("Channel/test.002", kMmeAcceleration);
  }
  void write(const std::string& name, const std::string& text) const {
    write_test_file(folder_ / name, text);
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace flexneck::testing
