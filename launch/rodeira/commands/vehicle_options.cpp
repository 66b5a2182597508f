// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/vehicle_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddVehicle(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<VehicleOptions>();
  CLI::App* vehicle = app.add_subcommand("vehicle", "vehicle files, alone");
  vehicle->require_subcommand(1);
  const auto run = [&options](const char* name) {
    return [options, name] {
      options->command = name;
      return Vehicle(*options);
    };
  };
  CLI::App* test = vehicle->add_subcommand("test", "drive the usual manoeuvres and print their figures");
  test->add_option("VEHICLE.yaml", options->file, "vehicle file, or its name (default)")->required();
  test->add_option(
      "--manoeuvre", options->manoeuvres,
      "acceleration, braking, split_friction, split_steered, constant_radius, step_steer, sine, sine_with_dwell, "
      "lane_change, park, bump; otherwise all");
  test->add_option("--step", options->step_s, "step in seconds")->capture_default_str();
  test->add_option("--csv", options->csv, "write the motion over time into this file")->check(NewFile());
  test->add_option("--svg", options->svg, "draw it into this file")->check(NewFile());
  CLI::Option* out =
      test->add_option("--out", options->out, "folder: NAME.csv and NAME.svg of each manoeuvre")->check(NewFolder());
  test->add_flag("--forces", options->forces,
                 "also NAME_forces.csv and NAME_forces.svg: forces in the joints and springs of a multibody car")
      ->needs(out);
  test->add_flag("--quiet", options->quiet, "no progress, no table");
  chosen.When(*test, run("test"));
  CLI::App* rig =
      vehicle->add_subcommand("rig", "move the wheels of a multibody car and print its suspensions' figures");
  rig->add_option("VEHICLE.yaml", options->file, "vehicle file, or its name (prototype)")->required();
  rig->add_option("--travel", options->travel_m, "largest travel up and down, in m")->capture_default_str();
  rig->add_option(
         "--out", options->out,
         "folder: travel.csv and travel.svg over travel, steering.csv and steering.svg over the steering wheel")
      ->check(NewFolder());
  rig->add_flag("--quiet", options->quiet, "no table");
  chosen.When(*rig, run("rig"));
  CLI::App* tyre = vehicle->add_subcommand("tyre", "read a tyre file, check it, print its figures and draw it");
  tyre->add_option("FILE.tir", options->file, "tyre property file, or a Fiala or TMeasy tyre of Chrono (.json)")
      ->required();
  tyre->add_option("--svg", options->svg, "draw forces over slip, camber and load into this file")->check(NewFile());
  tyre->add_option("--csv", options->csv, "write the forces at 1000 random points into this file, for comparison")
      ->check(NewFile());
  tyre->add_flag("--quiet", options->quiet, "no table");
  chosen.When(*tyre, run("tyre"));
  chosen.When(*vehicle->add_subcommand("list", "print the vehicles that can be named, and where they are"),
              run("list"));
}

}  // namespace rodeira::cli
