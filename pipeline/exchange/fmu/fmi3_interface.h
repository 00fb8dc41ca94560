// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

// The C interface of FMI 3.0 (Modelica Association, "Functional Mock-up Interface", version 3.0,
// sections 2.2 to 4.2): types, and the functions that every FMU has and those of co-simulation.
extern "C" {

using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3FMUState = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3Float32 = float;
using fmi3Float64 = double;
using fmi3Int8 = std::int8_t;
using fmi3UInt8 = std::uint8_t;
using fmi3Int16 = std::int16_t;
using fmi3UInt16 = std::uint16_t;
using fmi3Int32 = std::int32_t;
using fmi3UInt32 = std::uint32_t;
using fmi3Int64 = std::int64_t;
using fmi3UInt64 = std::uint64_t;
using fmi3Boolean = bool;
using fmi3Char = char;
using fmi3String = const fmi3Char*;
using fmi3Byte = std::uint8_t;
using fmi3Binary = const fmi3Byte*;
using fmi3Clock = bool;

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind {
  fmi3Independent,
  fmi3Constant,
  fmi3Fixed,
  fmi3Tunable,
  fmi3Discrete,
  fmi3Dependent
};
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                        fmi3String message);
using fmi3IntermediateUpdateCallback = void (*)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean,
                                                fmi3Boolean, fmi3Boolean, fmi3Boolean, fmi3Boolean*,
                                                fmi3Float64*);
using fmi3ClockUpdateCallback = void (*)(fmi3InstanceEnvironment);
using fmi3LockPreemptionCallback = void (*)();
using fmi3UnlockPreemptionCallback = void (*)();

using fmi3GetVersionTYPE = fmi3String();
using fmi3InstantiateCoSimulationTYPE =
    fmi3Instance(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                 fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                 const fmi3ValueReference intermediate[], std::size_t intermediates,
                 fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                 fmi3IntermediateUpdateCallback update);
using fmi3FreeInstanceTYPE = void(fmi3Instance);
using fmi3EnterInitializationModeTYPE = fmi3Status(fmi3Instance, fmi3Boolean has_tolerance,
                                                   fmi3Float64 tolerance, fmi3Float64 start,
                                                   fmi3Boolean has_stop, fmi3Float64 stop);
/// Type of functions that change the mode of an instance and have no other arguments.
using fmi3ModeTYPE = fmi3Status(fmi3Instance);
using fmi3GetFloat64TYPE = fmi3Status(fmi3Instance, const fmi3ValueReference references[],
                                      std::size_t count, fmi3Float64 values[],
                                      std::size_t values_count);
using fmi3SetFloat64TYPE = fmi3Status(fmi3Instance, const fmi3ValueReference references[],
                                      std::size_t count, const fmi3Float64 values[],
                                      std::size_t values_count);
using fmi3GetFMUStateTYPE = fmi3Status(fmi3Instance, fmi3FMUState*);
using fmi3SetFMUStateTYPE = fmi3Status(fmi3Instance, fmi3FMUState);
using fmi3FreeFMUStateTYPE = fmi3Status(fmi3Instance, fmi3FMUState*);
using fmi3SerializedFMUStateSizeTYPE = fmi3Status(fmi3Instance, fmi3FMUState, std::size_t*);
using fmi3SerializeFMUStateTYPE = fmi3Status(fmi3Instance, fmi3FMUState, fmi3Byte[], std::size_t);
using fmi3DeserializeFMUStateTYPE = fmi3Status(fmi3Instance, const fmi3Byte[], std::size_t,
                                               fmi3FMUState*);
using fmi3DoStepTYPE = fmi3Status(fmi3Instance, fmi3Float64 time, fmi3Float64 length,
                                  fmi3Boolean no_set_state, fmi3Boolean* event,
                                  fmi3Boolean* terminate, fmi3Boolean* early,
                                  fmi3Float64* last_time);

}  // extern "C"
