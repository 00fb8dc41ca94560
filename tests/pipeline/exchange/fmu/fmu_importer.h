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

#include "pipeline/exchange/fmu/fmi3_interface.h"

namespace flexneck::testing {

/// An FMU unpacked into a folder: its loaded shared object, and its variables as listed in
/// modelDescription.xml.
class LoadedFmu {
 public:
  explicit LoadedFmu(const std::filesystem::path& folder);
  ~LoadedFmu() { close(); }
  LoadedFmu(const LoadedFmu&) = delete;
  LoadedFmu& operator=(const LoadedFmu&) = delete;

  /// @return true if no part of the shared object stays loaded
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

/// An instance of the FMU. A function that fails throws an exception with the logged messages.
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
  /// Called after each of the run's own steps; returns false to ask it to return early.
  std::function<bool(double time_s)> goes_on;
  /// Time at which the last step ended.
  double reached_s = -1;
  /// Calls a function without arguments.
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
