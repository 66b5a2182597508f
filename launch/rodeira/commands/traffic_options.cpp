// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/commands/traffic_command.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddTraffic(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<TrafficOptions>();
  CLI::App* traffic = app.add_subcommand("traffic", "the traffic model alone, for studies");
  traffic->require_subcommand(1);
  CLI::App* run = traffic->add_subcommand("run", "drive cars on a map's roads and print the results");
  run->add_option("MAP", options->map, "world file, OpenDRIVE file (.xodr) or traffic map (.motors), or a world's name")
      ->required();
  run->add_option("--vehicles", options->vehicles, "how many there are; where there are flows, at most at a time")
      ->check(Between(0, 100000));
  run->add_option("--for", options->duration_s, "simulated seconds")->check(PositiveSeconds());
  run->add_option("--step", options->step_s, "seconds a step, to 1; with full physics to 0.1")
      ->check(Between(0.001, 1.0));
  run->add_option("--seed", options->seed, "random seed")->check(WholeNumber());
  run->add_option("--driver", options->driver,
                  "driver model: standard, or motors, as MOTORS' own driver does (with full physics)")
      ->check(OneOf({"standard", "motors"}));
  run->add_option("--physics", options->physics,
                  "how cars move: planar, along their paths, or full, as the driver's car does")
      ->check(OneOf({"planar", "full"}));
  run->add_option("--settings", options->settings,
                  "how they drive: a file of 'rodeira: traffic/1', with the keys of a launch file's traffic");
  run->add_option("--csv", options->csv,
                  "folder for trajectories.csv, signals.csv, lanes.csv, queues.csv, flows.csv, trips.csv")
      ->check(NewFolder());
  run->add_option("--rows-every", options->rows_every_s,
                  "seconds a row of trajectories.csv, of floating car data and of the diagram; 0.5, or a longer step")
      ->check(PositiveSeconds());
  run->add_option("--every", options->every_s,
                  "seconds a row of intervals.csv, in that folder: flow, speed, queue of every lane over time")
      ->check(PositiveSeconds());
  run->add_option("--warm", options->warm_s, "seconds at the beginning that tables and heat leave out")
      ->check(From0())
      ->capture_default_str();
  run->add_option("--heat", options->heat,
                  "mean speed by the metre as a picture (.svg); flow, density, speed and fuel as a GeoTIFF (.tif)")
      ->check(NewFile());
  run->add_option("--pixel", options->pixel_m, "metres a pixel of the GeoTIFF")
      ->check(Between(0.1, 1000.0))
      ->needs("--heat")
      ->capture_default_str();
  run->add_option("--fcd", options->fcd, "floating car data for SUMO's tools (.xml)")->check(NewFile());
  run->add_option("--tripinfo", options->tripinfo, "trip information for SUMO's tools (.xml)")->check(NewFile());
  run->add_option("--diagram", options->diagram, "trajectories of a lane over time (.svg)")->check(NewFile());
  run->add_option("--lane", options->lane, "which lane, ROAD:LANE; the longest one unless said")->needs("--diagram");
  run->add_flag("--no-check", options->no_check, "do not look for overlaps, red lights passed, wheels off the road");
  run->add_flag("--quiet", options->quiet, "no progress, no table");
  chosen.When(*run, [options] { return TrafficRun(*options); });
}

}  // namespace rodeira::cli
