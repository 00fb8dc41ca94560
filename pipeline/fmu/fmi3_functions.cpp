// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of an FMU's shared object: nothing else of it is seen from outside.
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>

#include "geometry/foundation/error.h"
#include "pipeline/fmu/fmi3_interface.h"
#include "pipeline/fmu/fmu_instance.h"

#define FLEXNECK_FMI extern "C" __attribute__((visibility("default")))

// Of libstdc++, which is linked in: its reserve for exceptions, which it keeps to the end of a
// process.
namespace __gnu_cxx {  // NOLINT(bugprone-reserved-identifier): the library's own
void __freeres();      // NOLINT(bugprone-reserved-identifier)
}

namespace {

/// Behind all other destructors of the shared object, which may be loaded again and again.
__attribute__((destructor(101))) void free_reserve() { __gnu_cxx::__freeres(); }

using flexneck::ComputationError;
using flexneck::InputError;
using flexneck::pipeline::FmuInstance;
using flexneck::pipeline::FmuModel;

enum class Mode { instantiated, initialization, step, terminated };

struct Instance {
  FmuModel model;  ///< as it was read, for a reset
  std::unique_ptr<FmuInstance> run;
  Mode mode = Mode::instantiated;
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log = nullptr;

  fmi3Status tell(fmi3Status status, const char* message) const {
    if (log != nullptr) log(environment, status, "error", message);
    return status;
  }
  void require(Mode needed, const char* function) const {
    if (mode != needed)
      throw InputError(std::string(function) + ": the instance is in another mode");
  }
};

Instance& instance_of(fmi3Instance instance) { return *static_cast<Instance*>(instance); }

/// Does something with an instance. What is thrown never leaves the shared object.
template <class Do>
fmi3Status guarded(fmi3Instance instance, const Do& action) {
  if (instance == nullptr) return fmi3Error;
  Instance& at = instance_of(instance);
  try {
    action(at);
    return fmi3OK;
  } catch (const ComputationError& error) {
    return at.tell(fmi3Discard, error.what());
  } catch (const std::exception& error) {
    return at.tell(fmi3Error, error.what());
  } catch (...) {
    return at.tell(fmi3Error, "failed for an unknown reason");
  }
}

fmi3Status not_offered(fmi3Instance instance, const char* function) {
  return guarded(instance, [&](const Instance&) {
    throw InputError(std::string(function) + ": this FMU has nothing that it could be of");
  });
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The token that a model's archive begins with, on a line, and the model behind it.
FmuModel model_in(const std::string& resources, const std::string& token) {
  const std::string path =
      resources + (resources.empty() || resources.back() == '/' ? "" : "/") + "model.bin";
  const std::string bytes = text_of_file(path);
  const std::size_t end = bytes.find('\n');
  if (end == std::string::npos || bytes.substr(0, end) != token)
    throw InputError(path + ": the instantiation token is that of another FMU");
  return flexneck::pipeline::fmu_model_of(std::string_view(bytes).substr(end + 1));
}

FmuInstance::State& state_of(fmi3FMUState state) {
  if (state == nullptr) throw InputError("there is no saved state");
  return *static_cast<FmuInstance::State*>(state);
}

}  // namespace

FLEXNECK_FMI fmi3String fmi3GetVersion() { return "3.0"; }

FLEXNECK_FMI fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String /*name*/, fmi3String token, fmi3String resources, fmi3Boolean /*visible*/,
    fmi3Boolean /*logging*/, fmi3Boolean /*event_mode*/, fmi3Boolean /*early_return*/,
    const fmi3ValueReference /*intermediate*/[], std::size_t /*intermediates*/,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback /*update*/) {
  try {
    auto instance = std::make_unique<Instance>();
    instance->environment = environment;
    instance->log = log;
    if (guarded(instance.get(), [&](Instance& at) {
          if (token == nullptr || resources == nullptr)
            throw InputError("an instance needs the token and the path of the resources");
          at.model = model_in(resources, token);
          at.run = std::make_unique<FmuInstance>(at.model);
        }) != fmi3OK)
      return nullptr;
    return instance.release();
  } catch (...) {
    return nullptr;
  }
}

FLEXNECK_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String,
                                                       fmi3Boolean, fmi3Boolean,
                                                       fmi3InstanceEnvironment environment,
                                                       fmi3LogMessageCallback log) {
  if (log != nullptr) log(environment, fmi3Error, "error", "this FMU is for co-simulation only");
  return nullptr;
}

FLEXNECK_FMI fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
    fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  if (log != nullptr) log(environment, fmi3Error, "error", "this FMU is for co-simulation only");
  return nullptr;
}

FLEXNECK_FMI void fmi3FreeInstance(fmi3Instance instance) {
  delete static_cast<Instance*>(instance);
}

FLEXNECK_FMI fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean, std::size_t,
                                            const fmi3String[]) {
  return guarded(instance, [](const Instance&) {});
}

FLEXNECK_FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance instance,
                                                    fmi3Boolean has_tolerance,
                                                    fmi3Float64 tolerance, fmi3Float64 start,
                                                    fmi3Boolean /*has_stop*/,
                                                    fmi3Float64 /*stop*/) {
  return guarded(instance, [&](Instance& at) {
    at.require(Mode::instantiated, "fmi3EnterInitializationMode");
    if (has_tolerance) at.run->set_tolerance(tolerance);
    at.run->start_at(start);
    at.mode = Mode::initialization;
  });
}

FLEXNECK_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) {
    at.require(Mode::initialization, "fmi3ExitInitializationMode");
    at.run->begin();
    at.mode = Mode::step;
  });
}

FLEXNECK_FMI fmi3Status fmi3Terminate(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) {
    at.require(Mode::step, "fmi3Terminate");
    at.mode = Mode::terminated;
  });
}

FLEXNECK_FMI fmi3Status fmi3Reset(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) {
    at.run = std::make_unique<FmuInstance>(at.model);
    at.mode = Mode::instantiated;
  });
}

FLEXNECK_FMI fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length,
                                   fmi3Boolean /*no_set_state*/, fmi3Boolean* event,
                                   fmi3Boolean* terminate, fmi3Boolean* early,
                                   fmi3Float64* last_time) {
  const fmi3Status status = guarded(instance, [&](Instance& at) {
    at.require(Mode::step, "fmi3DoStep");
    at.run->advance(time, length);
  });
  for (fmi3Boolean* const flag : {event, terminate, early})
    if (flag != nullptr) *flag = false;
  if (last_time != nullptr && instance != nullptr && instance_of(instance).run)
    *last_time = instance_of(instance).run->time_s();
  return status;
}

FLEXNECK_FMI fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                                       std::size_t count, fmi3Float64 values[],
                                       std::size_t values_count) {
  return guarded(instance, [&](Instance& at) {
    at.run->get({references, count}, {values, values_count});
  });
}

FLEXNECK_FMI fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                                       std::size_t count, const fmi3Float64 values[],
                                       std::size_t values_count) {
  return guarded(instance, [&](Instance& at) {
    at.run->set({references, count}, {values, values_count});
  });
}

FLEXNECK_FMI fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return guarded(instance, [&](Instance& at) {
    if (state == nullptr) throw InputError("there is no place for the state");
    FmuInstance::State found = at.run->save();
    if (*state != nullptr)
      state_of(*state) = std::move(found);
    else
      *state = std::make_unique<FmuInstance::State>(std::move(found)).release();
  });
}

FLEXNECK_FMI fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return guarded(instance, [&](Instance& at) { at.run->restore(state_of(state)); });
}

FLEXNECK_FMI fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return guarded(instance, [&](Instance&) {
    if (state == nullptr) return;
    delete static_cast<FmuInstance::State*>(*state);
    *state = nullptr;
  });
}

FLEXNECK_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                                   std::size_t* size) {
  return guarded(instance,
                 [&](Instance&) { *size = FmuInstance::bytes_of(state_of(state)).size(); });
}

FLEXNECK_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state,
                                              fmi3Byte bytes[], std::size_t size) {
  return guarded(instance, [&](Instance&) {
    const std::string found = FmuInstance::bytes_of(state_of(state));
    if (found.size() != size) throw InputError("the state has another size");
    std::memcpy(bytes, found.data(), size);
  });
}

FLEXNECK_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[],
                                                std::size_t size, fmi3FMUState* state) {
  return guarded(instance, [&](Instance&) {
    FmuInstance::State found = FmuInstance::state_of({reinterpret_cast<const char*>(bytes), size});
    *state = std::make_unique<FmuInstance::State>(std::move(found)).release();
  });
}

// What this FMU has no variables or capabilities for.
#define FLEXNECK_NO_VARIABLES(Type)                                                           \
  FLEXNECK_FMI fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference[],    \
                                        std::size_t count, fmi3##Type[], std::size_t) {       \
    return count == 0 ? fmi3OK : not_offered(instance, "fmi3Get" #Type);                      \
  }                                                                                           \
  FLEXNECK_FMI fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference[],    \
                                        std::size_t count, const fmi3##Type[], std::size_t) { \
    return count == 0 ? fmi3OK : not_offered(instance, "fmi3Set" #Type);                      \
  }
FLEXNECK_NO_VARIABLES(Float32)
FLEXNECK_NO_VARIABLES(Int8)
FLEXNECK_NO_VARIABLES(UInt8)
FLEXNECK_NO_VARIABLES(Int16)
FLEXNECK_NO_VARIABLES(UInt16)
FLEXNECK_NO_VARIABLES(Int32)
FLEXNECK_NO_VARIABLES(UInt32)
FLEXNECK_NO_VARIABLES(Int64)
FLEXNECK_NO_VARIABLES(UInt64)
FLEXNECK_NO_VARIABLES(Boolean)
FLEXNECK_NO_VARIABLES(String)

FLEXNECK_FMI fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[],
                                      std::size_t, std::size_t[], fmi3Binary[], std::size_t) {
  return not_offered(instance, "fmi3GetBinary");
}
FLEXNECK_FMI fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[],
                                      std::size_t, const std::size_t[], const fmi3Binary[],
                                      std::size_t) {
  return not_offered(instance, "fmi3SetBinary");
}
FLEXNECK_FMI fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                     fmi3Clock[]) {
  return not_offered(instance, "fmi3GetClock");
}
FLEXNECK_FMI fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                     const fmi3Clock[]) {
  return not_offered(instance, "fmi3SetClock");
}
FLEXNECK_FMI fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                                            fmi3ValueReference, std::size_t*) {
  return not_offered(instance, "fmi3GetNumberOfVariableDependencies");
}
FLEXNECK_FMI fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference,
                                                    std::size_t[], fmi3ValueReference[],
                                                    std::size_t[], fmi3DependencyKind[],
                                                    std::size_t) {
  return not_offered(instance, "fmi3GetVariableDependencies");
}
FLEXNECK_FMI fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance,
                                                     const fmi3ValueReference[], std::size_t,
                                                     const fmi3ValueReference[], std::size_t,
                                                     const fmi3Float64[], std::size_t,
                                                     fmi3Float64[], std::size_t) {
  return not_offered(instance, "fmi3GetDirectionalDerivative");
}
FLEXNECK_FMI fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference[],
                                                 std::size_t, const fmi3ValueReference[],
                                                 std::size_t, const fmi3Float64[], std::size_t,
                                                 fmi3Float64[], std::size_t) {
  return not_offered(instance, "fmi3GetAdjointDerivative");
}
FLEXNECK_FMI fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference[],
                                               std::size_t, fmi3Float64[],
                                               fmi3IntervalQualifier[]) {
  return not_offered(instance, "fmi3GetIntervalDecimal");
}
FLEXNECK_FMI fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference[],
                                                std::size_t, fmi3UInt64[], fmi3UInt64[],
                                                fmi3IntervalQualifier[]) {
  return not_offered(instance, "fmi3GetIntervalFraction");
}
FLEXNECK_FMI fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference[],
                                            std::size_t, fmi3Float64[]) {
  return not_offered(instance, "fmi3GetShiftDecimal");
}
FLEXNECK_FMI fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference[],
                                             std::size_t, fmi3UInt64[], fmi3UInt64[]) {
  return not_offered(instance, "fmi3GetShiftFraction");
}
FLEXNECK_FMI fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference[],
                                               std::size_t, const fmi3Float64[]) {
  return not_offered(instance, "fmi3SetIntervalDecimal");
}
FLEXNECK_FMI fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference[],
                                                std::size_t, const fmi3UInt64[],
                                                const fmi3UInt64[]) {
  return not_offered(instance, "fmi3SetIntervalFraction");
}
FLEXNECK_FMI fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference[],
                                            std::size_t, const fmi3Float64[]) {
  return not_offered(instance, "fmi3SetShiftDecimal");
}
FLEXNECK_FMI fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference[],
                                             std::size_t, const fmi3UInt64[], const fmi3UInt64[]) {
  return not_offered(instance, "fmi3SetShiftFraction");
}
FLEXNECK_FMI fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean*, fmi3Boolean*,
                                                 fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                                 fmi3Float64*) {
  return not_offered(instance, "fmi3UpdateDiscreteStates");
}
FLEXNECK_FMI fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference[],
                                                 std::size_t, const fmi3Int32[], fmi3Float64[],
                                                 std::size_t) {
  return not_offered(instance, "fmi3GetOutputDerivatives");
}

#define FLEXNECK_NO_MODE(Function)                          \
  FLEXNECK_FMI fmi3Status Function(fmi3Instance instance) { \
    return not_offered(instance, #Function);                \
  }
FLEXNECK_NO_MODE(fmi3EnterEventMode)
FLEXNECK_NO_MODE(fmi3EnterStepMode)
FLEXNECK_NO_MODE(fmi3EnterConfigurationMode)
FLEXNECK_NO_MODE(fmi3ExitConfigurationMode)
FLEXNECK_NO_MODE(fmi3EvaluateDiscreteStates)
