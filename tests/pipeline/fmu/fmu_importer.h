// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <dlfcn.h>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/fmu/fmi3_interface.h"

namespace flexneck::testing {

/// An FMU that was unpacked into a folder: its shared object loaded, its variables as
/// modelDescription.xml lists them.
class LoadedFmu {
 public:
  explicit LoadedFmu(const std::filesystem::path& folder);
  ~LoadedFmu() { close(); }
  LoadedFmu(const LoadedFmu&) = delete;
  LoadedFmu& operator=(const LoadedFmu&) = delete;

  /// @return whether nothing of the shared object stays loaded
  bool close();
  template <class Function>
  Function* function(const char* name) const {
    void* const address = dlsym(object_, name);
    if (address == nullptr) throw std::runtime_error(std::string("no function ") + name);
    return reinterpret_cast<Function*>(address);
  }
  fmi3ValueReference reference(const std::string& name) const { return references_.at(name); }
  const std::map<std::string, fmi3ValueReference>& references() const { return references_; }
  const std::string& token() const { return token_; }
  std::string resources() const { return (folder_ / "resources").string() + "/"; }

 private:
  std::filesystem::path folder_, file_;
  void* object_ = nullptr;
  std::string token_;
  std::map<std::string, fmi3ValueReference> references_;
};

/// An instance of it. What a function does not do is an exception, with what was logged.
class FmuRun {
 public:
  explicit FmuRun(const LoadedFmu& fmu);
  ~FmuRun() { fmu_.function<fmi3FreeInstanceTYPE>("fmi3FreeInstance")(instance_); }
  FmuRun(const FmuRun&) = delete;
  FmuRun& operator=(const FmuRun&) = delete;

  void initialize(double tolerance = 0);
  void set(const std::string& name, double value);
  double get(const std::string& name) const;
  std::vector<double> get(const std::vector<std::string>& names) const;
  fmi3Status step(double time_s, double length_s);
  /// Asked after each of the run's own steps; false asks it to return early.
  std::function<bool(double time_s)> goes_on;
  /// Where the last step has ended.
  double reached_s = -1;
  /// Of a function without arguments.
  fmi3Status call(const char* function);

  fmi3FMUState save();
  void restore(fmi3FMUState state);
  void free(fmi3FMUState& state);
  std::vector<fmi3Byte> bytes_of(fmi3FMUState state);
  fmi3FMUState state_of(const std::vector<fmi3Byte>& bytes);

  fmi3Instance instance() const { return instance_; }
  std::string logged;

 private:
  void require(fmi3Status status, const std::string& what) const;

  const LoadedFmu& fmu_;
  fmi3Instance instance_;
};

}  // namespace flexneck::testing
