// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The entry of a vehicle model in a shared object.
///
/// A vehicle file names the shared object: `model: library` (docs/how-to/own-vehicle.md).

#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

/// Describes what a shared object and the program that loads it must have in common: version, compiler, layout of the
/// types that pass between them. It is compiled into both.
/// @return the description
std::string VehicleBuild();

/// Type of the entry point that makes a model: it reads the keys of the vehicle file and leaves the model in `made`.
using VehicleMaker = void (*)(const config::Map& root, std::unique_ptr<VehicleModel>& made);

/// Entry point of a shared object that gives its VehicleBuild, written by RODEIRA_VEHICLE.
inline constexpr const char* kVehicleBuildEntry = "rodeira_vehicle_build";
/// Entry point of a shared object that makes a model (VehicleMaker), written by RODEIRA_VEHICLE.
inline constexpr const char* kVehicleMakeEntry = "rodeira_make_vehicle";

/// Makes a model from the shared object that the key `library` names. The object stays loaded until the process ends.
/// If a state is not finite after a step, the model stays at its last finite state and problem() says so.
/// @param root mapping of the vehicle file; its problems are: the shared object cannot be loaded, has no entry point,
/// or
///   belongs to another build
/// @return the model; null after such a problem
std::unique_ptr<VehicleModel> MakeFromLibrary(const config::Map& root);

/// Tests the dimensions of a model made by MakeFromLibrary.
/// @param model the model
/// @param root mapping of the vehicle file, for the place in messages
/// @return wrong input if a dimension is not positive or not finite
base::Status CheckLibraryModel(VehicleModel& model, const config::Map& root);

}  // namespace rodeira::dynamics

/// Defines the entry points of a shared object with a vehicle model. Used once, at the end of a source outside of all
/// namespaces: `RODEIRA_VEHICLE(MakeKart);`. CMake's function rodeira_add_vehicle builds the object.
/// @param make a function `std::unique_ptr<VehicleModel> MakeKart(const config::Map& root)` that reads the keys of the
///   vehicle file. Problems of the file go to `root` (config::Map::Problem). It returns a model even if the file has
///   problems; the first of them is reported.
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
