// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <memory>
#include <span>
#include <string>

#include "geometry/foundation/error.h"
#include "pipeline/exchange/fmu/fmi3_interface.h"
#include "pipeline/exchange/fmu/fmu_instance.h"

/// Marks functions of the interface, the only visible symbols of the shared object.
#define FLEXNECK_FMI extern "C" __attribute__((visibility("default")))

namespace flexneck::pipeline {

/// Object behind a handle of the interface.
struct Fmi3Instance {
  FmuModel model;  ///< model as read, for a reset
  std::unique_ptr<FmuInstance> run;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log = nullptr;
  fmi3IntermediateUpdateCallback update = nullptr;
  bool may_return_early = false;
  std::string token;  ///< instantiation token of the model

  fmi3Status tell(fmi3Status status, const char* message) const {
    if (log != nullptr) log(environment, status, "error", message);
    return status;
  }

  /// Reports a reached time to the importer. @return true if the step is to continue
  bool goes_on(double time_s) const {
    if (update == nullptr) return true;
    fmi3Boolean is_asked_to_return = false;
    fmi3Float64 return_time_s = time_s;
    update(environment, time_s, false, false, true, may_return_early, &is_asked_to_return,
           &return_time_s);
    return !may_return_early || !is_asked_to_return;
  }
};

/// An array of the importer. @throws InputError for a null pointer with a count above zero.
template <class T>
std::span<T> values_at(T* values, std::size_t count) {
  if (values == nullptr && count > 0)
    throw InputError("expected an array of " + std::to_string(count) +
                     " values, found a null pointer");
  return {values, count};
}

/// Runs an action on an instance; no exception leaves the shared object.
/// @param not_computed  status if a run cannot continue
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
    return at.tell(fmi3Error, "failed with an unknown error");
  }
}

}  // namespace flexneck::pipeline
