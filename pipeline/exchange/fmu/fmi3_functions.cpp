// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of an FMU's shared object with an effect (the others: fmi3_not_offered.cpp).
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pipeline/exchange/fmu/fmi3_instance.h"

namespace {

using flexneck::InputError;
using flexneck::pipeline::FmuInstance;
using flexneck::pipeline::FmuModel;
using flexneck::pipeline::guarded;
using flexneck::pipeline::values_at;
using Instance = flexneck::pipeline::Fmi3Instance;

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Reads the archived model; the token is the hash of its bytes.
FmuModel model_in(const std::string& resources, const std::string& token) {
  const std::string path =
      resources + (resources.empty() || resources.back() == '/' ? "" : "/") + "model.bin";
  const std::string bytes = text_of_file(path);
  if (flexneck::pipeline::token_of(bytes) != token)
    throw InputError(path + ": expected the file that matches the instantiation token " + token +
                     ", found another one; unpack the FMU again");
  return flexneck::pipeline::fmu_model_of(bytes);
}

FmuInstance::State& state_of(fmi3FMUState state) {
  if (state == nullptr) throw InputError("expected a saved state, found a null pointer");
  return *static_cast<FmuInstance::State*>(state);
}

}  // namespace

FLEXNECK_FMI fmi3String fmi3GetVersion() { return "3.0"; }

FLEXNECK_FMI fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String /*name*/, fmi3String token, fmi3String resources, fmi3Boolean /*visible*/,
    fmi3Boolean /*logging*/, fmi3Boolean /*event_mode*/, fmi3Boolean early_return,
    const fmi3ValueReference /*intermediate*/[], std::size_t /*intermediates*/,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback update) {
  try {
    auto instance = std::make_unique<Instance>();
    instance->environment = environment;
    instance->log = log;
    instance->update = update;
    instance->may_return_early = early_return;
    if (guarded(instance.get(), [&](Instance& at) {
          if (token == nullptr || resources == nullptr)
            throw InputError(
                "expected the instantiation token and the path of the resources, found a null "
                "pointer");
          at.token = token;
          at.model = model_in(resources, at.token);
          at.run = std::make_unique<FmuInstance>(at.model);
        }) != fmi3OK)
      return nullptr;
    return instance.release();
  } catch (...) {
    return nullptr;
  }
}

FLEXNECK_FMI void fmi3FreeInstance(fmi3Instance instance) {
  const std::unique_ptr<Instance> taken(static_cast<Instance*>(instance));
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
    at.run->begin_initialization(has_tolerance ? std::optional<double>(tolerance) : std::nullopt,
                                 start);
  });
}

FLEXNECK_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) { at.run->end_initialization(); });
}

FLEXNECK_FMI fmi3Status fmi3Terminate(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) { at.run->terminate(); });
}

FLEXNECK_FMI fmi3Status fmi3Reset(fmi3Instance instance) {
  return guarded(instance, [](Instance& at) { at.run = std::make_unique<FmuInstance>(at.model); });
}

FLEXNECK_FMI fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 length,
                                   fmi3Boolean /*no_set_state*/, fmi3Boolean* event,
                                   fmi3Boolean* terminate, fmi3Boolean* early,
                                   fmi3Float64* last_time) {
  bool is_early = false;
  const fmi3Status status = guarded(
      instance,
      [&](Instance& at) {
        at.run->advance(time, length, [&](double time_s) {
          is_early = !at.goes_on(time_s);
          return !is_early;
        });
      },
      fmi3Discard);
  for (fmi3Boolean* const flag : {event, terminate, early})
    if (flag != nullptr) *flag = false;
  if (early != nullptr) *early = is_early && status == fmi3OK;
  if (last_time != nullptr && instance != nullptr)
    *last_time = static_cast<Instance*>(instance)->run->time_s();
  if (status == fmi3OK)
    guarded(instance, [](Instance& at) {
      for (const std::string& warning : at.run->new_warnings())
        at.tell(fmi3Warning, warning.c_str());
    });
  return status;
}

FLEXNECK_FMI fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                                       std::size_t count, fmi3Float64 values[],
                                       std::size_t values_count) {
  return guarded(instance, [&](Instance& at) {
    at.run->get(values_at(references, count), values_at(values, values_count));
  });
}

FLEXNECK_FMI fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                                       std::size_t count, const fmi3Float64 values[],
                                       std::size_t values_count) {
  return guarded(instance, [&](Instance& at) {
    at.run->set(values_at(references, count), values_at(values, values_count));
  });
}

FLEXNECK_FMI fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return guarded(instance, [&](Instance& at) {
    if (state == nullptr) throw InputError("expected a place for the state, found a null pointer");
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
    const std::unique_ptr<FmuInstance::State> taken(static_cast<FmuInstance::State*>(*state));
    *state = nullptr;
  });
}

FLEXNECK_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                                   std::size_t* size) {
  return guarded(instance, [&](Instance& at) {
    values_at(size, 1)[0] = FmuInstance::bytes_of(state_of(state), at.token).size();
  });
}

FLEXNECK_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state,
                                              fmi3Byte bytes[], std::size_t size) {
  return guarded(instance, [&](Instance& at) {
    const std::string found = FmuInstance::bytes_of(state_of(state), at.token);
    if (found.size() != size) throw InputError("expected the size of the state, found another one");
    std::memcpy(values_at(bytes, size).data(), found.data(), size);
  });
}

FLEXNECK_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[],
                                                std::size_t size, fmi3FMUState* state) {
  return guarded(instance, [&](Instance& at) {
    const std::span<const fmi3Byte> given = values_at(bytes, size);
    FmuInstance::State found = FmuInstance::state_of(
        {reinterpret_cast<const char*>(given.data()), given.size()}, at.token);
    values_at(state, 1)[0] = std::make_unique<FmuInstance::State>(std::move(found)).release();
  });
}
