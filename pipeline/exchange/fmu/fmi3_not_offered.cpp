// SPDX-License-Identifier: GPL-3.0-or-later
// Mandatory functions of the interface for which the FMU has no variables or capabilities.
#include <string>

#include "pipeline/exchange/fmu/fmi3_instance.h"

namespace {

fmi3Status not_offered(fmi3Instance instance, const char* function) {
  return flexneck::pipeline::guarded(instance, [&](const flexneck::pipeline::Fmi3Instance&) {
    throw flexneck::InputError(std::string(function) +
                               ": not supported, since this FMU has no variables of this kind");
  });
}

}  // namespace

FLEXNECK_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String,
                                                       fmi3Boolean, fmi3Boolean,
                                                       fmi3InstanceEnvironment environment,
                                                       fmi3LogMessageCallback log) {
  if (log != nullptr) log(environment, fmi3Error, "error", "this FMU supports only co-simulation");
  return nullptr;
}

FLEXNECK_FMI fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
    fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  if (log != nullptr) log(environment, fmi3Error, "error", "this FMU supports only co-simulation");
  return nullptr;
}

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
