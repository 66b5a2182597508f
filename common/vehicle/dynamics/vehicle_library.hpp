// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

// Vehicle models of a laboratory's own, as shared objects that a vehicle file names: `model: library`
// (docs/how-to/own-vehicle.md).
namespace rodeira::dynamics {

// What a shared object and the program that loads it must have in common: version, compiler, layout of what passes
// between them. Compiled into each of both.
std::string VehicleBuild();

using VehicleMaker = void (*)(const config::Map& root, std::unique_ptr<VehicleModel>& made);

// The entry points of a shared object, written by RODEIRA_VEHICLE.
inline constexpr const char* kVehicleBuildEntry = "rodeira_vehicle_build";
inline constexpr const char* kVehicleMakeEntry = "rodeira_make_vehicle";

// The model of the shared object that `library` names, which stays loaded until the process ends. A shared object that
// cannot be loaded, has no entry point, or belongs to another build, is a problem of the file; null then. A state that
// is not finite after a step is the model's problem(); it stays at the last finite state.
std::unique_ptr<VehicleModel> MakeFromLibrary(const config::Map& root);

// Wrong input if a model made by MakeFromLibrary has no sound dimensions.
base::Status CheckLibraryModel(VehicleModel& model, const config::Map& root);

}  // namespace rodeira::dynamics

// RODEIRA_VEHICLE(MakeKart), once, at the end of a source: the entry points of a shared object with a vehicle model.
// CMake's function rodeira_add_vehicle builds it. MakeKart is a function
// `std::unique_ptr<VehicleModel> MakeKart(const config::Map& root)` that reads the keys of the vehicle file; problems
// of the file go to `root` (Map::Problem). It returns a model even where
// the file has problems: the first of them is told.
#define RODEIRA_VEHICLE(make)                                                                         \
  extern "C" __attribute__((visibility("default"))) const char* rodeira_vehicle_build() {             \
    static const std::string build = ::rodeira::dynamics::VehicleBuild();                             \
    return build.c_str();                                                                             \
  }                                                                                                   \
  extern "C" __attribute__((visibility("default"))) void rodeira_make_vehicle(                        \
      const ::rodeira::config::Map& root, std::unique_ptr<::rodeira::dynamics::VehicleModel>& made) { \
    made = make(root);                                                                                \
  }                                                                                                   \
  static_assert(true)
