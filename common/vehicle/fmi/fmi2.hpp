// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

// The binary interface of FMI 2.0 (Functional Mock-up Interface for Model Exchange and Co-Simulation, version 2.0.4,
// chapters 2.1 and 4.2.2), as far as a master of co-simulation needs it. Names are the standard's.
namespace rodeira::fmi {

using fmi2Component = void*;
using fmi2ComponentEnvironment = void*;
using fmi2FMUstate = void*;
using fmi2ValueReference = unsigned int;
using fmi2Real = double;
using fmi2Integer = int;
using fmi2Boolean = int;  // 0 or 1
using fmi2String = const char*;
using fmi2Byte = char;

enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending };
enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation };

// What an FMU may call; the standard says which of these may be null.
struct fmi2CallbackFunctions {
  void (*logger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message,
                 ...);
  void* (*allocateMemory)(std::size_t count, std::size_t size);
  void (*freeMemory)(void*);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
};

using InstantiateFunction = fmi2Component(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources,
                                          const fmi2CallbackFunctions*, fmi2Boolean visible, fmi2Boolean logging);
using FreeInstanceFunction = void(fmi2Component);
using SetupExperimentFunction = fmi2Status(fmi2Component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                           fmi2Boolean has_stop, fmi2Real stop);
using ComponentFunction = fmi2Status(fmi2Component);
using GetRealFunction = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, fmi2Real*);
using SetRealFunction = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, const fmi2Real*);
using GetIntegerFunction = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, fmi2Integer*);
using SetIntegerFunction = fmi2Status(fmi2Component, const fmi2ValueReference*, std::size_t, const fmi2Integer*);
using DoStepFunction = fmi2Status(fmi2Component, fmi2Real time, fmi2Real step, fmi2Boolean no_return);
using GetStateFunction = fmi2Status(fmi2Component, fmi2FMUstate*);
using SetStateFunction = fmi2Status(fmi2Component, fmi2FMUstate);
using StateSizeFunction = fmi2Status(fmi2Component, fmi2FMUstate, std::size_t*);
using SerializeFunction = fmi2Status(fmi2Component, fmi2FMUstate, fmi2Byte*, std::size_t);
using DeserializeFunction = fmi2Status(fmi2Component, const fmi2Byte*, std::size_t, fmi2FMUstate*);

}  // namespace rodeira::fmi
