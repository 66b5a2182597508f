// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/world_command.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/zones.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/road/logical_files.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/measured_files.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/visual_files.hpp"
#include "common/world/road/world_export.hpp"
#include "common/world/road/world_plot.hpp"
#include "common/world/road/world_profile.hpp"
#include "common/world/road/world_report.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/input_files.hpp"
#include "launch/rodeira/world_warnings.hpp"

namespace rodeira::cli {
namespace {

// Lights that are green together where their ways cross, which a run that has traffic refuses. What cannot be read is
// told elsewhere.
int CheckLights(const network::Network& network) {
  const auto controllers = network.controllers();
  if (std::none_of(controllers.begin(), controllers.end(),
                   [](const network::Controller& controller) { return controller.times.has_value(); }))
    return 0;
  const lanes::Graph graph(network);
  const auto status = lanes::CheckLights(graph, lanes::Zones(graph));
  return status ? 0 : base::PrintError("rodeira", status.error());
}

int CheckLights(const std::string& world_file) {
  const auto world = road::World::Load(world_file);
  return world && world.value()->network() != nullptr ? CheckLights(*world.value()->network()) : 0;
}

int Repair(const WorldOptions& options) {
  const auto left = road::WriteRepaired(options.world_file, options.repair);
  if (!left) return base::PrintError("rodeira", left.error());
  for (const std::string& sentence : left.value()) fmt::print(stderr, "rodeira: left as it is: {}\n", sentence);
  fmt::print("wrote {}\n", options.repair);
  return 0;
}

int CheckOpenDrive(const WorldOptions& options) {
  const road::NetworkCheck check =
      road::CheckNetwork(options.world_file, options.strict, options.verbose, !options.no_repair);
  for (const std::string& warning : check.warnings) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  for (const base::Error& error : check.errors) base::PrintError("rodeira", error);
  if (!check.errors.empty()) return check.errors.front().exit_status();
  if (const int status = check.network != nullptr ? CheckLights(*check.network) : 0; status != 0) return status;
  fmt::print("{}{}: no error found\n", check.table, options.world_file);
  return options.repair.empty() ? 0 : Repair(options);
}

// A folder that was built.
int CheckBuilt(const WorldOptions& options) {
  const std::filesystem::path folder(options.world_file);
  auto problems = road::LogicalProblems(folder);
  const std::string hash = road::LogicalContentHash(folder);
  if (!hash.empty()) {  // otherwise it is no built folder, which is said
    const auto seen = road::VisualProblems(folder, hash);
    problems.insert(problems.end(), seen.begin(), seen.end());
  }
  for (const base::Error& problem : problems) base::PrintError("rodeira", problem);
  if (!problems.empty()) return problems.front().exit_status();
  std::error_code none;
  const bool is_seen = std::filesystem::exists(folder / road::kVisualManifest, none);
  fmt::print("{}: every file of '{}'{} is as it was written\n", options.world_file, road::kLogicalManifest,
             is_seen ? fmt::format(" and '{}'", road::kVisualManifest) : "");
  return 0;
}

// What is asked of the files of a world, which a traffic map is not.
base::Error NoWorldFile(const WorldOptions& options) {
  const std::string name = std::filesystem::path(options.world_file).stem().string();
  return base::WrongInput("world.unknown_kind",
                          fmt::format("this is a traffic map; `rodeira map convert {} -o {}.yaml` makes a world file "
                                      "of it, -o {}.xodr an OpenDRIVE file",
                                      options.world_file, name, name),
                          options.world_file);
}

int CheckWorldFile(const WorldOptions& options) {
  std::error_code none;
  if (std::filesystem::is_directory(options.world_file, none)) return CheckBuilt(options);
  if (road::IsOpenDrive(options.world_file)) return CheckOpenDrive(options);
  for (const auto& [given, name] :
       {std::pair(options.strict, "--strict"), std::pair(options.verbose, "--verbose"),
        std::pair(options.no_repair, "--no-repair"), std::pair(!options.repair.empty(), "--repair")}) {
    if (given)
      return base::PrintError(
          "rodeira", base::WrongInput("command.wrong_combination", fmt::format("'{}' is for OpenDRIVE files", name),
                                      options.world_file));
  }
  for (const std::string& warning : road::WorldWarnings(options.world_file))
    fmt::print(stderr, "rodeira: warning: {}\n", warning);
  const auto problems = road::WorldProblems(options.world_file);
  for (const base::Error& problem : problems) base::PrintError("rodeira", problem);
  if (!problems.empty()) return problems.front().exit_status();
  if (const int status = CheckLights(options.world_file); status != 0) return status;
  fmt::print("{}: no problem found\n", options.world_file);
  return 0;
}

int Written(const std::filesystem::path& file, const base::Status& status) {
  if (!status) return base::PrintError("rodeira", status.error());
  fmt::print("{}\n", file.string());
  return 0;
}

// The OpenDRIVE file of a world that is one, with its measured surfaces, which are added to `files`.
int CopyOpenDrive(const std::filesystem::path& file, const std::filesystem::path& copy,
                  std::vector<std::filesystem::path>& files) {
  const auto text = opendrive::LoadText(file);
  if (!text) return base::PrintError("rodeira", text.error());
  const auto warnings = road::CopyMeasured(file, copy, &files);
  if (!warnings) return base::PrintError("rodeira", warnings.error());
  for (const std::string& warning : warnings.value()) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  return Written(copy, base::WriteWhole(copy, text.value()));
}

// The world file with what it names and its generated terrain, which are added to `files`.
int WriteWorldFile(const WorldOptions& options, const road::World& world, std::vector<std::filesystem::path>& files) {
  const std::filesystem::path file(options.world_file), out(options.out);
  if (road::IsGenerated(file)) {
    const auto written = road::BuildWorld(world, file, out);
    if (!written) return base::PrintError("rodeira", written.error());
    fmt::print("{}", written.value());
    std::error_code none;
    for (const char* ending : {".bt", ".prj"}) {
      const std::filesystem::path name = file.filename().replace_extension(ending);
      if (std::filesystem::exists(out / name, none)) files.push_back(name);
    }
  } else if (const int status = Written(out / file.filename(), road::CopyWorld(file, out)); status != 0) {
    return status;
  }
  const auto named = road::CopyNamed(file, out);
  if (!named) return base::PrintError("rodeira", named.error());
  files.push_back(file.filename());
  files.insert(files.end(), named.value().begin(), named.value().end());
  return 0;
}

// What a world looks like, tile by tile.
int BuildDatabase(const WorldOptions& options, const road::World& world) {
  const Graphics* graphics = RegisteredGraphics();
  if (graphics == nullptr) {
    fmt::print(stderr, "rodeira: warning: {}: no tiles are written: {}\n", options.world_file, WhyNoGraphics());
    return 0;
  }
  nodes::DatabaseOptions database;
  database.folder = options.out;
  database.threads = options.threads;
  if (!options.quiet && ::isatty(STDERR_FILENO) != 0) {
    database.progress = [](std::size_t done, std::size_t of) {
      constexpr std::size_t kWidth = 40;
      fmt::print(stderr, "\r[{:<{}}] {} of {} tiles{}", std::string(done * kWidth / of, '='), kWidth, done, of,
                 done == of ? "\n" : "");
    };
  }
  const auto report = graphics->write_tiles(world, database);
  if (!report) return base::PrintError("rodeira", report.error());
  fmt::print("{}: {} tiles, {} built, {} as they were\n", (database.folder / "world.osgb").string(),
             report.value().tiles, report.value().built, report.value().tiles - report.value().built);
  return 0;
}

// What is seen; the roads as OpenDRIVE; the world file with all that it names;
// and a list of all these but what is seen.
int Build(const WorldOptions& options) {
  const auto loaded = LoadWorldAndWarn(options.world_file);
  if (!loaded) return base::PrintError("rodeira", loaded.error());
  const road::World& world = *loaded.value();
  const std::filesystem::path out(options.out), copy = out / "world.xodr";
  if (auto status = road::BeginLogical(out); !status) return base::PrintError("rodeira", status.error());
  std::vector<std::filesystem::path> files;
  if (!road::IsOpenDrive(options.world_file)) {
    if (const int status = WriteWorldFile(options, world, files); status != 0) return status;
  }
  if (const int status = BuildDatabase(options, world); status != 0) return status;
  if (world.network() != nullptr && !world.network()->roads().empty()) {
    std::error_code problem;
    std::filesystem::create_directories(out, problem);
    const int status = world.open_drive() ? CopyOpenDrive(road::OpenDriveOf(options.world_file), copy, files)
                                          : Written(copy, road::WriteOpenDrive(world, copy));
    if (status != 0) return status;
    files.emplace_back("world.xodr");
    for (const auto& measured : std::filesystem::directory_iterator(out / "world_surfaces", problem)) {
      if (!world.open_drive()) files.push_back(std::filesystem::path("world_surfaces") / measured.path().filename());
    }
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return Written(out / road::kLogicalManifest, road::WriteLogical(out, world.content_hash(), files));
}

int WorldOf(const WorldOptions& options) {
  if (options.command == "check") return CheckWorldFile(options);
  if (road::IsTrafficMap(options.world_file) && (options.command == "build" || options.command == "export"))
    return base::PrintError("rodeira", NoWorldFile(options));
  if (options.command == "build") return Build(options);
  const auto world = LoadWorldAndWarn(options.world_file);
  if (options.command == "export" && world) {
    const auto status = road::WriteOpenDrive(*world.value(), options.out);
    if (!status)
      return base::PrintError(
          "rodeira", status.error().context.empty() ? status.error().WithContext(options.world_file) : status.error());
    fmt::print("wrote {}\n", options.out);
    return 0;
  }
  if (options.command == "map" && world) {
    if (auto status = base::WriteWhole(options.out, road::PlotWorld(*world.value())); !status)
      return base::PrintError("rodeira", status.error());
    fmt::print("wrote {}\n", options.out);
    if (options.profile.empty()) return 0;
    const std::string profile = road::PlotProfiles(*world.value());
    if (profile.empty())
      return base::PrintError(
          "rodeira", base::WrongInput("world.no_road", "the world has no road; a road with a profile was expected",
                                      options.world_file));
    if (auto status = base::WriteWhole(options.profile, profile); !status)
      return base::PrintError("rodeira", status.error());
    fmt::print("wrote {}\n", options.profile);
    return 0;
  }
  if (!world) return base::PrintError("rodeira", world.error());
  if (options.command == "query") {
    Eigen::Vector2d at(options.x_m, options.y_m);
    if (options.earth) {
      const auto place = road::PlaceOnMap(*world.value(), options.x_m, options.y_m);
      if (!place) return base::PrintError("rodeira", place.error());
      at = place.value();
    }
    fmt::print("{}", road::DescribePoint(*world.value(), at.x(), at.y(), options.z_hint_m));
    return 0;
  }
  fmt::print("{}", road::DescribeWorld(*world.value()));
  for (const auto& [file, drawn] :
       {std::pair(options.svg, &road::PlotWorld), std::pair(options.profile, &road::PlotProfiles)}) {
    if (file.empty()) continue;
    const std::string svg = drawn(*world.value());
    if (svg.empty())
      return base::PrintError(
          "rodeira", base::WrongInput("world.no_road", "the world has no road; a road with a profile was expected",
                                      options.world_file));
    if (auto status = base::WriteWhole(file, svg); !status) return base::PrintError("rodeira", status.error());
    fmt::print("wrote {}\n", file);
  }
  return 0;
}

}  // namespace

int World(const WorldOptions& options) {
  if (options.command == "list") {
    fmt::print("{}", ListInputFiles(InputKind::kWorld));
    return 0;
  }
  auto file = ResolveInputFile(InputKind::kWorld, options.world_file);
  if (!file) return base::PrintError("rodeira", file.error());
  WorldOptions resolved = options;
  resolved.world_file = std::move(file).value();
  return WorldOf(resolved);
}

}  // namespace rodeira::cli
