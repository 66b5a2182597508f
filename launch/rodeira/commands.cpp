// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "common/core/base/display.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/version.hpp"
#include "launch/rodeira/checked_output.hpp"
#include "launch/rodeira/commands/edit_command.hpp"
#include "launch/rodeira/commands/export_command.hpp"
#include "launch/rodeira/commands/info_command.hpp"
#include "launch/rodeira/commands/input_command.hpp"
#include "launch/rodeira/commands/joysticks_command.hpp"
#include "launch/rodeira/commands/map_command.hpp"
#include "launch/rodeira/commands/measures_command.hpp"
#include "launch/rodeira/commands/measures_options.hpp"
#include "launch/rodeira/commands/mechanism_command.hpp"
#include "launch/rodeira/commands/polyline_command.hpp"
#include "launch/rodeira/commands/repair_command.hpp"
#include "launch/rodeira/commands/surface_command.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"
#include "launch/rodeira/commands/vehicle_command.hpp"
#include "launch/rodeira/commands/view_command.hpp"
#include "launch/rodeira/commands/world_command.hpp"
#include "launch/rodeira/commands/world_import.hpp"
#include "launch/rodeira/doctor/doctor.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/replay/replay_command.hpp"
#include "launch/rodeira/run/ctl_command.hpp"
#include "launch/rodeira/run/run_command.hpp"
#include "launch/rodeira/shell/shell_command.hpp"

namespace rodeira::cli {
namespace {

const CLI::Validator Positive = Above0("a positive number of seconds");

// KEY=VALUE, or an empty key where it is none.
std::pair<std::string, std::string> KeyValue(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return {};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// False, after a sentence, where one of them is none.
bool TakePairs(const char* option, const std::vector<std::string>& texts,
               std::vector<std::pair<std::string, std::string>>& out) {
  for (const std::string& text : texts) {
    const auto pair = KeyValue(text);
    if (pair.first.empty()) {
      std::cerr << "rodeira: " << option << " " << text << ": KEY=VALUE was expected\n";
      return false;
    }
    out.push_back(pair);
  }
  return true;
}

void AddRun(CLI::App& app, RunOptions& options, std::vector<std::string>& sets) {
  CLI::App* run = app.add_subcommand("run", "drive: start every process of a launch file");
  CLI::Option* file = run->add_option("LAUNCH.yaml", options.launch_file, "launch file, or its name (demo)");
  run->add_flag("--list", options.list, "print the launch files that can be named")->excludes(file);
  run->add_option("--for", options.duration_s, "simulated seconds")->check(Positive);
  run->add_option("--pace", options.pace, "max, real or a factor of real time; otherwise the launch file's, or max");
  CLI::Option* record = run->add_option("--record", options.record,
                                        "recording (MCAP); otherwise a dated file in the folder of recordings");
  run->add_flag("--no-record", options.no_record, "no recording")->excludes(record);
  run->add_option("--seed", options.seed, "seed of everything that is drawn")->check(WholeNumber());
  run->add_option("--set", sets, "KEY=VALUE: replaces a value of the launch file; KEY=~ takes it out");
  run->add_option("--meta", options.meta, "KEY=VALUE: written into the recording (participant=P07)");
  run->add_flag("--in-process", options.in_process, "the same nodes in one process");
  run->add_flag("--headless", options.headless, "no window, even where there is a display");
  run->add_flag("--quiet", options.quiet, "no progress, no table");
  run->add_option("--lab", options.lab, "laboratory file: the PCs and their network");
  run->add_option("--host", options.host, "start only what belongs to this host of the laboratory");
  run->add_option("--run", options.run, "name of the run: only processes of the same name meet");
  run->add_option("--domain", options.domain, "DDS domain, 0 to 232 (default: the first free one)")
      ->check(Between(0, 232));
}

CLI::App* AddCtl(CLI::App& app, CtlOptions& options) {
  CLI::App* ctl = app.add_subcommand(
      "ctl",
      "control a run that is going on: pause | resume | step [N] | pace X | mark TEXT | stop | restart NODE | state");
  ctl->add_option("COMMAND", options.words, "what to do")->required();
  ctl->add_option("--run", options.run, "name of the run; the only one otherwise");
  return ctl;
}

void AddWorldImport(CLI::App& world, WorldImportOptions& options) {
  CLI::App* command = world.add_subcommand(
      "import", "make a world of a map of OpenStreetMap or a network of SUMO, by SUMO's netconvert (package sumo)");
  command->add_option("FILE", options.file, "map (.osm, .osm.gz) or network (.net.xml, .net.xml.gz)")->required();
  command
      ->add_option("-o,--out", options.out,
                   "file to write: OUT.yaml (with OUT.xodr beside it) or OUT.xodr; not there yet")
      ->required()
      ->check(NewFile());
  command->add_option("--elevation", options.elevation,
                      "heights of the ground (GeoTIFF, .bt …), which the roads follow");
  command->add_flag("--quiet", options.quiet, "no progress");
  command->callback([&options] { options.chosen = true; });
}

void AddWorld(CLI::App& app, WorldOptions& options, WorldImportOptions& import) {
  CLI::App* world = app.add_subcommand("world", "check, describe and ask a world");
  world->require_subcommand(1);
  for (const auto& [name, text] :
       {std::pair("check", "name every problem of a world file, or of a folder that was built"),
        std::pair("info", "what the world is"), std::pair("map", "draw the plan as SVG"),
        std::pair("export", "write the roads as OpenDRIVE"), std::pair("query", "SUELO: the ground at X Y"),
        std::pair("build",
                  "write a world's files: its roads (.xodr), generated terrain (.bt), what it looks like (.osgb)")}) {
    CLI::App* command = world->add_subcommand(name, text);
    command
        ->add_option("WORLD", options.world_file, "world file (.yaml), or OpenDRIVE (.xodr), or a world's name (n222)")
        ->required();
    if (std::string(name) == "query") {
      command->add_option("X", options.x_m, "metres east")->required()->check(Finite());
      command->add_option("Y", options.y_m, "metres north")->required()->check(Finite());
      command->add_option("Z", options.z_hint_m, "near which height, where surfaces lie over one another")
          ->check(Finite());
      command->add_flag("--earth", options.earth,
                        "X and Y are longitude and latitude (WGS 84, degrees) by the world's projection");
    }
    if (std::string(name) == "build") {
      command->add_option("-o,--out", options.out, "folder")->required();
      command->add_option("--threads", options.threads, "how many at once; as many as the machine has otherwise");
      command->add_flag("--quiet", options.quiet, "no progress");
    }
    if (std::string(name) == "map") {
      command->add_option("-o,--out", options.out, "file to draw the plan into")->required()->check(NewFile());
      command
          ->add_option("--profile", options.profile,
                       "draw heights, grades, curvatures and slopes across into this file")
          ->check(NewFile());
    }
    if (std::string(name) == "export")
      command->add_option("-o,--out,--opendrive", options.out, "file to write")->required()->check(NewFile());
    if (std::string(name) == "check") {
      command->add_flag("--strict", options.strict, "OpenDRIVE: ASAM's own tolerances, and nothing is repaired");
      command->add_flag("--no-repair", options.no_repair, "OpenDRIVE: errors stay errors, by the usual tolerances");
      command->add_flag("--verbose", options.verbose, "OpenDRIVE: every finding, not one of each kind");
      command->add_option("--repair", options.repair, "OpenDRIVE: write the repaired file here")->check(NewFile());
    }
    if (std::string(name) == "info") {
      command->add_option("--svg", options.svg, "draw the plan into this file")->check(NewFile());
      command
          ->add_option("--profile", options.profile,
                       "draw heights, grades, curvatures and slopes across into this file")
          ->check(NewFile());
    }
    command->callback([&options, name] { options.command = name; });
  }
  world->add_subcommand("list", "print the worlds that can be named, and where they are")->callback([&options] {
    options.command = "list";
  });
  AddWorldImport(*world, import);
}

void AddMap(CLI::App& app, MapOptions& options) {
  CLI::App* map = app.add_subcommand("map", "traffic maps (.motors): check and convert them");
  map->require_subcommand(1);
  for (const auto& [name, text] :
       {std::pair("check", "name everything that is wrong, and what the map holds"),
        std::pair("convert",
                  "draw it (.svg), or write it as OpenDRIVE (.xodr) or as a world of this project (.yaml)")}) {
    CLI::App* command = map->add_subcommand(name, text);
    command->add_option("FILE.motors", options.file, "map")->required();
    if (std::string(name) == "convert")
      command
          ->add_option("-o,--out", options.out,
                       "file to write: OUT.svg, OUT.xodr or OUT.yaml (with OUT.xodr beside it)")
          ->required()
          ->check(NewFile());
    command->callback([&options, name] { options.command = name; });
  }
}

void AddTraffic(CLI::App& app, TrafficOptions& options) {
  CLI::App* traffic = app.add_subcommand("traffic", "the traffic model alone, for studies");
  traffic->require_subcommand(1);
  CLI::App* run = traffic->add_subcommand("run", "drive cars on a map's roads and say what came out");
  run->add_option("MAP", options.map, "world file, OpenDRIVE file (.xodr) or traffic map (.motors), or a world's name")
      ->required();
  run->add_option("--vehicles", options.vehicles, "how many there are; where there are flows, at most at a time")
      ->check(Between(0, 100000));
  run->add_option("--for", options.duration_s, "simulated seconds")->check(Positive);
  run->add_option("--step", options.step_s, "seconds a step, to 0.1")->check(Between(0.001, 0.1));
  run->add_option("--seed", options.seed, "seed of everything that is drawn")->check(WholeNumber());
  run->add_option("--driver", options.driver,
                  "who drives: standard, or motors, as MOTORS' own driver does (with full physics)")
      ->check(OneOf({"standard", "motors"}));
  run->add_option("--physics", options.physics,
                  "how cars move: planar, along their paths, or full, as the driver's car does")
      ->check(OneOf({"planar", "full"}));
  run->add_option("--settings", options.settings,
                  "how they drive: a file of 'rodeira: traffic/1', with the keys of a launch file's traffic");
  run->add_option("--csv", options.csv,
                  "folder for trajectories.csv, signals.csv, lanes.csv, queues.csv, flows.csv, trips.csv");
  run->add_option("--rows-every", options.rows_every_s,
                  "seconds a row of trajectories.csv, of floating car data and of the diagram")
      ->check(Positive)
      ->capture_default_str();
  run->add_option("--every", options.every_s,
                  "seconds a row of intervals.csv, in that folder: flow, speed, queue of every lane over time")
      ->check(Positive);
  run->add_option("--warm", options.warm_s, "seconds at the beginning that tables and heat leave out")
      ->check(From0())
      ->capture_default_str();
  run->add_option("--heat", options.heat,
                  "mean speed by the metre as a picture (.svg); flow, density, speed and fuel as a GeoTIFF (.tif)")
      ->check(NewFile());
  run->add_option("--pixel", options.pixel_m, "metres a pixel of the GeoTIFF")
      ->check(Between(0.1, 1000.0))
      ->needs("--heat")
      ->capture_default_str();
  run->add_option("--fcd", options.fcd, "floating car data for SUMO's tools (.xml)")->check(NewFile());
  run->add_option("--diagram", options.diagram, "trajectories of a lane over time (.svg)")->check(NewFile());
  run->add_option("--lane", options.lane, "which lane, ROAD:LANE; the longest one unless said")->needs("--diagram");
  run->add_flag("--no-check", options.no_check, "do not look for overlaps, red lights passed, wheels off the road");
  run->add_flag("--quiet", options.quiet, "no progress, no table");
  run->callback([&options] { options.asked = true; });
}

void AddPolyline(CLI::App& app, PolylineOptions& options) {
  CLI::App* polyline = app.add_subcommand(
      "polyline",
      "chains of points in CSV files (x_m,y_m,z_m) and axes of roads (WORLD.yaml#ROAD), put together and moved");
  polyline->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, const char* file) {
    CLI::App* command = polyline->add_subcommand(name, text);
    CLI::Option* files =
        command->add_option(file, options.files, "CSV file, or a road's axis: WORLD.yaml#ROAD, FILE.xodr#ROAD")
            ->required();
    if (std::string(name) == "join")
      files->expected(2, CLI::detail::expected_max_vector_size);
    else
      files->expected(1);
    command->add_option("-o,--out", options.out, "CSV file to write")->required()->check(NewFile());
    command->add_option("--step", options.step_m, "metres between the points of a road's axis")
        ->check(Above0("a number above 0"))
        ->capture_default_str();
    command->callback([&options, name] { options.command = name; });
    return command;
  };
  CLI::App* join = add("join", "one line after the other", "IN.csv");
  join->add_option("--within", options.within_m, "metres that an end may lie from the next beginning")
      ->check(From0())
      ->capture_default_str();
  join->add_flag("--bridge", options.bridge, "bridge larger gaps by a straight piece");
  join->add_flag("--turn", options.turn, "turn a line round whose end is nearer than its beginning");
  CLI::App* translate = add("translate", "shift", "IN.csv");
  translate->add_option("--by", options.by_m, "metres east, north and, if wanted, up")
      ->required()
      ->check(Finite())
      ->expected(2, 3);
  CLI::App* rotate = add("rotate", "turn about a vertical axis", "IN.csv");
  rotate->add_option("--deg", options.angle_deg, "degrees, from east to north")->required()->check(Finite());
  rotate->add_option("--about", options.about_m, "X Y of the axis; the first point otherwise")
      ->check(Finite())
      ->expected(2);
  CLI::App* scale = add("scale", "stretch or shrink", "IN.csv");
  scale->add_option("--by", options.factor, "factor, greater than 0")->required()->check(Above0("a number above 0"));
  scale->add_option("--z-by", options.z_factor, "another factor for the heights")->check(Above0("a number above 0"));
  scale->add_option("--about", options.about_m, "X Y [Z] that stays; the first point otherwise")
      ->check(Finite())
      ->expected(2, 3);
  CLI::App* offset = add("offset", "the line beside it", "IN.csv");
  offset->add_option("--left", options.left_m, "metres to the left; negative: to the right")
      ->required()
      ->check(Finite());
  offset->add_flag("--keep-length", options.keep_length,
                   "nodes move by the distance itself along their mitres: bends become narrower");
  offset->add_flag("--despite-faults", options.despite_faults, "write it even where it folds or crosses itself");
}

void AddSurface(CLI::App& app, SurfaceOptions& options) {
  CLI::App* surface = app.add_subcommand("surface", "measured road surfaces, alone");
  surface->require_subcommand(1);
  CLI::App* check = surface->add_subcommand("check", "what an OpenCRG file holds, or what is wrong with it");
  check->add_option("FILE.crg", options.file, "OpenCRG file")->required();
  check->add_option("--svg", options.svg, "draw plan, heights and tracks into this file")->check(NewFile());
  check->callback([&options] { options.command = "check"; });
}

void AddDoctor(CLI::App& app, DoctorOptions& options) {
  CLI::App* doctor = app.add_subcommand("doctor", "is this PC ready: packages, GL, DDS, ports, shared memory");
  doctor->add_option("--transport", options.transport, "of the DDS loop-back")
      ->check(OneOf({"shared_memory", "udp"}))
      ->capture_default_str();
  doctor->add_option("--domain", options.domain, "DDS domain, 0 to 232")->check(Between(0, 232))->capture_default_str();
  doctor->add_flag("--quiet", options.quiet, "only what is not well");
  doctor->add_flag("--clean", options.clean, "first remove what dead processes of yours left in /dev/shm");
  doctor->add_option("--answer", options.answer)->group("");  // the second process of the loop-back
  doctor->add_option("--segment-kib", options.segment_kib)->group("");
  doctor->add_flag("--devices", options.devices)->group("");  // by rodeira-graphics, for the doctor of `rodeira`
  doctor->callback([&options] { options.asked = true; });
}

void AddMechanism(CLI::App& app, MechanismOptions& options) {
  CLI::App* mechanism = app.add_subcommand("mechanism", "multibody mechanisms, alone");
  mechanism->require_subcommand(1);
  CLI::App* run = mechanism->add_subcommand("run", "simulate a mechanism file");
  run->add_option("MECHANISM.yaml", options.file, "mechanism file")->required();
  run->add_option("--until", options.until_s, "simulated seconds")->required()->check(Positive);
  run->add_option("--step", options.step_s, "step in seconds")->required()->check(Positive);
  run->add_option("--csv", options.csv, "write the outputs of every step into this file")->check(NewFile());
  run->add_option("--svg", options.svg, "draw the outputs over time into this file")->check(NewFile());
  run->add_flag("--quiet", options.quiet, "no progress, no table");
  run->callback([&options] { options.asked = true; });
}

void AddVehicle(CLI::App& app, VehicleOptions& options) {
  CLI::App* vehicle = app.add_subcommand("vehicle", "vehicle files, alone");
  vehicle->require_subcommand(1);
  CLI::App* test = vehicle->add_subcommand("test", "drive the usual manoeuvres and print their figures");
  test->add_option("VEHICLE.yaml", options.file, "vehicle file, or its name (default)")->required();
  test->add_option("--manoeuvre", options.manoeuvres,
                   "acceleration, braking, split_friction, constant_radius, step_steer, sine, lane_change, park, bump; "
                   "otherwise all");
  test->add_option("--step", options.step_s, "step in seconds")->capture_default_str();
  test->add_option("--csv", options.csv, "write the motion over time into this file")->check(NewFile());
  test->add_option("--svg", options.svg, "draw it into this file")->check(NewFile());
  test->add_option("--out", options.out, "folder: NAME.csv and NAME.svg of each manoeuvre");
  test->add_flag("--quiet", options.quiet, "no progress, no table");
  test->callback([&options] { options.command = "test"; });
  CLI::App* tyre = vehicle->add_subcommand("tyre", "read a tyre file, check it, print its figures and draw it");
  tyre->add_option("FILE.tir", options.file, "tyre property file, or a Fiala or TMeasy tyre of Chrono (.json)")
      ->required();
  tyre->add_option("--svg", options.svg, "draw forces over slip, camber and load into this file")->check(NewFile());
  tyre->add_option("--csv", options.csv, "write the forces at 1000 random points into this file, for comparison")
      ->check(NewFile());
  tyre->add_flag("--quiet", options.quiet, "no table");
  tyre->callback([&options] { options.command = "tyre"; });
  vehicle->add_subcommand("list", "print the vehicles that can be named, and where they are")->callback([&options] {
    options.command = "list";
  });
}

void AddInput(CLI::App& app, InputOptions& options) {
  CLI::App* input = app.add_subcommand("input", "steering wheels and pedals");
  input->require_subcommand(1);
  CLI::App* setup =
      input->add_subcommand("setup", "find out what turns and what is pressed, by moving it, and write a wheel file");
  setup->add_option("-o,--out", options.out,
                    "wheel file; otherwise one in the user's configuration, by the device's GUID");
  setup
      ->add_option("--lock-deg", options.lock_deg,
                   "angle of the car's steering wheel at the device's end, from straight ahead")
      ->check(Between(10.0, 1800.0));
  setup->callback([&options] { options.asked = true; });
}

void AddJoysticks(CLI::App& app, JoysticksOptions& options) {
  CLI::App* joysticks = app.add_subcommand("joysticks", "wheels and joysticks that are plugged in, with their GUIDs");
  CLI::Option* watch = joysticks->add_flag("--watch", options.watch, "say which axis and button moves");
  joysticks->add_option("--for", options.duration_s, "seconds of watching")->check(Positive)->needs(watch);
  joysticks->callback([&options] { options.asked = true; });
}

CLI::App* AddView(CLI::App& app, ViewOptions& options) {
  CLI::App* view = app.add_subcommand(
      "view",
      "the start window: choose what to drive, or what to watch; with a launch file: its run, by one of its views");
  view->add_option("LAUNCH.yaml", options.launch_file, "launch file, or its name");
  view->add_option("--screen", options.screen,
                   "of the laboratory: only the view that looks through it, as its PC's part of the run where the "
                   "launch file names one");
  view->add_flag("--headset", options.headset, "in a headset too");
  view->add_option("--for", options.duration_s, "simulated seconds")->check(Positive);
  return view;
}

void AddEdit(CLI::App& app, EditOptions& options) {
  CLI::App* edit = app.add_subcommand("edit", "draw a traffic map in a window");
  edit->add_option("FILE.motors", options.file, "traffic map; a new one otherwise");
  edit->callback([&options] { options.asked = true; });
}

CLI::App* AddReplay(CLI::App& app, ReplayOptions& options, std::vector<std::string>& changes,
                    std::vector<std::string>& libraries) {
  CLI::App* replay = app.add_subcommand("replay", "watch a recording, or run it again");
  replay->add_option("FILE.mcap", options.file, "recording")->required();
  CLI::Option* view = replay->add_flag("--view", options.view, "watch it, or the branch, in a window");
  replay->add_option("--speed", options.watch.speed, "times real time, 0.1 to 10")->needs(view)->capture_default_str();
  replay->add_flag("--paused", options.watch.paused, "begin standing still")->needs(view);
  CLI::Option* frames =
      replay->add_option("--frames", options.watch.frames, "folder: write pictures (PNG) as the run's view would have");
  CLI::Option* at = replay->add_option("--at", options.watch.at_s, "simulated seconds of the pictures")->needs(frames);
  replay
      ->add_option("--fps", options.watch.fps, "instead: a film of so many pictures a simulated second, from --from on")
      ->needs(frames)
      ->excludes(at);
  replay->add_option("--camera", options.watch.camera,
                     "chase, driver, bonnet, orbit, top or trackside; otherwise as the run's view");
  replay->add_option("--follow", options.watch.follow, "name of a vehicle node; otherwise as the run's view");
  replay->add_option("--quality", options.watch.quality, "low, medium or high; otherwise as the run's view");
  replay->add_option("--size", options.watch.size, "WIDTHxHEIGHT in pixels; otherwise as the run's view");
  replay->add_flag("--verify", options.verify, "compute everything again and compare every sample and state");
  replay->add_option("--from", options.from_s, "simulated seconds at which to begin");
  replay->add_option("--branch", changes, "KEY=VALUE: go on from --from with another value of the launch file");
  replay->add_option("--library", libraries,
                     "NODE=FILE.so: run this external node again, in a verification or a branch");
  replay->add_option("--for", options.for_s, "simulated seconds of the branch or film")->check(Positive);
  replay->add_option("--record", options.record, "recording of the branch (MCAP)");
  replay->add_option("--pace", options.pace,
                     "of the branch: max, real or a factor; otherwise real where a person drives or watches, or max");
  replay->add_flag("--quiet", options.quiet, "no progress");
  return replay;
}

// What is asked of a recording.
struct RecordingOptions {
  std::string info_file;
  std::string repair_file;
  std::string repair_out;
  ExportOptions exported;
};

void AddRecording(CLI::App& app, RecordingOptions& options) {
  CLI::App* info = app.add_subcommand("info", "what a recording holds, and whether every sample is there");
  info->add_option("FILE.mcap", options.info_file, "recording")->required();
  AddExport(app, options.exported);
  CLI::App* repair = app.add_subcommand("repair", "write what is left of a damaged recording as a whole one");
  repair->add_option("FILE.mcap", options.repair_file, "recording")->required();
  repair->add_option("--out", options.repair_out, "the new file")->required();
}

void AddShell(CLI::App& app, ShellOptions& options) {
  CLI::App* completion = app.add_subcommand("completion", "print the completion script of a shell");
  completion->add_option("SHELL", options.shell, "bash or zsh")->required()->check(OneOf({"bash", "zsh"}));
  completion->callback([&options] { options.command = "completion"; });
  app.add_subcommand("manual", "print the manual page (roff)")->callback([&options] { options.command = "manual"; });
}

// Without a command.
int ChooseCommand() {
  const Graphics* graphics = RegisteredGraphics();
  if (graphics == nullptr && base::NamesDisplay()) return ContinueInGraphics("rodeira without a command");
  if (graphics != nullptr && graphics->has_display()) return graphics->start_window();
  std::cerr << "rodeira: without a command a window opens to choose one, but there is no display; set DISPLAY, or "
               "name a command (`rodeira --help` lists them)\n";
  return 2;
}

}  // namespace

namespace {

int RunCommandLine(int argc, char** argv) {
  base::PinMathLibrary(argv);
  base::NameExhaustion("rodeira");
  KeepArguments(argc, argv);
  CLI::App app{"Rodeira, a distributed driving simulator."};
  app.name("rodeira");
  app.set_version_flag("--version", fmt::format("rodeira {}", base::Version()));
  app.require_subcommand(1);
  RunOptions run;
  std::vector<std::string> sets;
  AddRun(app, run, sets);
  WorldOptions world;
  WorldImportOptions world_import;
  AddWorld(app, world, world_import);
  MapOptions map;
  AddMap(app, map);
  TrafficOptions traffic;
  AddTraffic(app, traffic);
  PolylineOptions polyline;
  AddPolyline(app, polyline);
  SurfaceOptions surface;
  AddSurface(app, surface);
  MechanismOptions mechanism;
  AddMechanism(app, mechanism);
  VehicleOptions vehicle;
  AddVehicle(app, vehicle);
  DoctorOptions doctor;
  AddDoctor(app, doctor);
  JoysticksOptions joysticks;
  AddJoysticks(app, joysticks);
  InputOptions input;
  AddInput(app, input);
  EditOptions edit;
  AddEdit(app, edit);
  CtlOptions ctl_options;
  const CLI::App* ctl = AddCtl(app, ctl_options);
  RecordingOptions recording;
  AddRecording(app, recording);
  MeasuresOptions measures_options;
  const CLI::App* measures = AddMeasures(app, measures_options);
  ReplayOptions replay_options;
  std::vector<std::string> changes;
  std::vector<std::string> libraries;
  CLI::App* replay = AddReplay(app, replay_options, changes, libraries);
  ViewOptions view_options;
  const CLI::App* view = AddView(app, view_options);
  ShellOptions shell;
  AddShell(app, shell);
  if (argc == 1) return ChooseCommand();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
      return app.exit(problem);  // --help, --version
    std::cerr << OptionSentence(app, problem) << "\n";
    return 2;
  }
  if (!shell.command.empty()) return Shell(shell, app);
  if (view->parsed()) return View(view_options);
  if (world.command == "build" && CanContinueInGraphics()) return ContinueInGraphics("world build");
  if (!world.command.empty()) return World(world);
  if (world_import.chosen) return WorldImport(world_import);
  if (!map.command.empty()) return MapCommand(map);
  if (traffic.asked) return TrafficRun(traffic);
  if (!polyline.command.empty()) return Polylines(polyline);
  if (!surface.command.empty()) return Surface(surface);
  if (!vehicle.command.empty()) return Vehicle(vehicle);
  if (mechanism.asked) return RunMechanismFile(mechanism);
  if (doctor.asked) return Doctor(doctor);
  if (joysticks.asked) return ListJoysticks(joysticks);
  if (input.asked) return SetUpInput(input);
  if (edit.asked) return Edit(edit);
  if (ctl->parsed()) return Ctl(ctl_options);
  if (measures->parsed()) return Measures(measures_options);
  if (app.got_subcommand("info")) return Info(recording.info_file);
  if (app.got_subcommand("export")) return Export(recording.exported);
  if (app.got_subcommand("repair")) return RepairRecording(recording.repair_file, recording.repair_out);
  if (!TakePairs("--set", sets, run.overrides) || !TakePairs("--branch", changes, replay_options.changes) ||
      !TakePairs("--library", libraries, replay_options.libraries))
    return 2;
  if (replay->parsed()) return Replay(replay_options);
  return Run(run);
}

}  // namespace

int Main(int argc, char** argv) {
  return WithCheckedOutput([argc, argv] { return RunCommandLine(argc, argv); });
}

}  // namespace rodeira::cli
