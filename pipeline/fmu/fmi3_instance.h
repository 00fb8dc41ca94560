// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <memory>
#include <span>
#include <string>

#include "geometry/foundation/error.h"
#include "pipeline/fmu/fmi3_interface.h"
#include "pipeline/fmu/fmu_instance.h"

/// Of functions of the interface: nothing else of the shared object is seen from outside.
#define FLEXNECK_FMI extern "C" __attribute__((visibility("default")))

namespace flexneck::pipeline {

/// What a handle of the interface points to.
struct Fmi3Instance {
  FmuModel model;  ///< as it was read, for a reset
  std::unique_ptr<FmuInstance> run;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log = nullptr;
  fmi3IntermediateUpdateCallback update = nullptr;
  bool may_return_early = false;
  std::string token;  ///< of the model

  fmi3Status tell(fmi3Status status, const char* message) const {
    if (log != nullptr) log(environment, status, "error", message);
    return status;
  }

  /// Tells the importer of a time that was reached. @return whether it wants the step to go on
  bool goes_on(double time_s) const {
    if (update == nullptr) return true;
    fmi3Boolean is_asked_to_return = false;
    fmi3Float64 return_time_s = time_s;
    update(environment, time_s, false, false, true, may_return_early, &is_asked_to_return,
           &return_time_s);
    return !may_return_early || !is_asked_to_return;
  }
};

/// An array of the importer. @throws InputError for a null pointer that should have values.
template <class T>
std::span<T> values_at(T* values, std::size_t count) {
  if (values == nullptr && count > 0)
    throw InputError("expected an array of " + std::to_string(count) +
                     " values, found a null pointer");
  return {values, count};
}

/// Does something with an instance. What is thrown never leaves the shared object.
/// @param not_computed  status where a run cannot go on
template <class Do>
fmi3Status guarded(fmi3Instance instance, const Do& action, fmi3Status not_computed = fmi3Error) {
  if (instance == nullptr) return fmi3Error;
  Fmi3Instance& at = *static_cast<Fmi3Instance*>(instance);
  try {
    action(at);
    return fmi3OK;
  } catch (const ComputationError& error) {
    return at.tell(not_computed, error.what());
  } catch (const std::exception& error) {
    return at.tell(fmi3Error, error.what());
  } catch (...) {
    return at.tell(fmi3Error, "failed for an unknown reason");
  }
}

}  // namespace flexneck::pipeline
