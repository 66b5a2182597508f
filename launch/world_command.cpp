#include "launch/world_command.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "common/base/files.hpp"
#include "common/road/measured_files.hpp"
#include "common/road/network_world.hpp"
#include "common/road/world_export.hpp"
#include "common/road/world_plot.hpp"
#include "common/road/world_profile.hpp"
#include "common/road/world_report.hpp"
#include "nodes/view/database.hpp"

namespace rodeira::front {
namespace {

int Complain(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

int CheckOpenDrive(const WorldOptions& options) {
  const road::NetworkCheck check = road::CheckNetwork(options.world_file, options.strict);
  for (const std::string& warning : check.warnings) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  for (const base::Error& error : check.errors) fmt::print(stderr, "rodeira: {}\n", error.Text());
  if (!check.errors.empty()) return check.errors.front().exit_status();
  fmt::print("{}{}: no error found\n", check.table, options.world_file);
  return 0;
}

int Check(const WorldOptions& options) {
  if (road::IsOpenDrive(options.world_file)) return CheckOpenDrive(options);
  if (options.strict) return Complain(base::WrongInput("'--strict' is for OpenDRIVE files", options.world_file));
  for (const std::string& warning : road::WorldWarnings(options.world_file)) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  const auto problems = road::WorldProblems(options.world_file);
  for (const base::Error& problem : problems) fmt::print(stderr, "rodeira: {}\n", problem.Text());
  if (!problems.empty()) return problems.front().exit_status();
  fmt::print("{}: no problem found\n", options.world_file);
  return 0;
}

int Written(const std::filesystem::path& file, const base::Status& status) {
  if (!status) return Complain(status.error());
  fmt::print("{}\n", file.string());
  return 0;
}

// The OpenDRIVE file of a world that is one, with its measured surfaces.
int CopyOpenDrive(const std::filesystem::path& file, const std::filesystem::path& copy) {
  const auto text = base::ReadText(file);
  if (!text) return Complain(text.error());
  const auto warnings = road::CopyMeasured(file, copy);
  if (!warnings) return Complain(warnings.error());
  for (const std::string& warning : warnings.value()) fmt::print(stderr, "rodeira: warning: {}\n", warning);
  return Written(copy, base::WriteWhole(copy, text.value()));
}

// What a world looks like, tile by tile.
int BuildDatabase(const WorldOptions& options, const road::World& world) {
  view::DatabaseOptions database;
  database.folder = options.out;
  database.threads = options.threads;
  if (!options.quiet && ::isatty(STDERR_FILENO) != 0) {
    database.progress = [](std::size_t done, std::size_t of) {
      constexpr std::size_t kWidth = 40;
      fmt::print(stderr, "\r[{:<{}}] {} of {} tiles{}", std::string(done * kWidth / of, '='), kWidth, done, of, done == of ? "\n" : "");
    };
  }
  const auto report = view::WriteDatabase(world, database);
  if (!report) return Complain(report.error());
  fmt::print("{}: {} tiles, {} built, {} as they were\n", (database.folder / "world.osgb").string(), report.value().tiles, report.value().built,
             report.value().tiles - report.value().built);
  return 0;
}

// What is seen of an OpenDRIVE file, and the file itself beside it; of a world file its generated terrain, its roads as
// OpenDRIVE, and, where they are of version 2, what is seen.
int Build(const WorldOptions& options) {
  const auto world = road::World::Load(options.world_file);
  if (!world) return Complain(world.error());
  const std::filesystem::path copy = std::filesystem::path(options.out) / "world.xodr";
  if (world.value()->open_drive()) {
    const int status = BuildDatabase(options, *world.value());
    return status != 0 ? status : CopyOpenDrive(road::OpenDriveOf(options.world_file), copy);
  }
  if (road::IsGenerated(options.world_file) || world.value()->network() == nullptr) {
    const auto written = road::BuildWorld(*world.value(), options.world_file, options.out);
    if (!written) return Complain(written.error());
    fmt::print("{}", written.value());
  }
  if (world.value()->network() == nullptr) return 0;
  if (world.value()->roads().empty()) {
    if (const int status = BuildDatabase(options, *world.value()); status != 0) return status;
  }
  std::error_code problem;
  std::filesystem::create_directories(options.out, problem);
  return Written(copy, road::WriteOpenDrive(*world.value(), copy));
}

}  // namespace

int World(const WorldOptions& options) {
  if (options.command == "check") return Check(options);
  if (options.command == "build") return Build(options);
  const auto world = road::World::Load(options.world_file);
  if (options.command == "export" && world) {
    const auto status = road::WriteOpenDrive(*world.value(), options.out);
    if (!status) return Complain(status.error().context.empty() ? base::WrongInput(status.error().message, options.world_file) : status.error());
    fmt::print("wrote {}\n", options.out);
    return 0;
  }
  if (options.command == "map" && world) {
    if (auto status = base::WriteWhole(options.out, road::PlotWorld(*world.value())); !status) return Complain(status.error());
    fmt::print("wrote {}\n", options.out);
    if (options.profile.empty()) return 0;
    const std::string profile = road::PlotProfiles(*world.value());
    if (profile.empty()) return Complain(base::WrongInput("the world has no road whose profile could be drawn", options.world_file));
    if (auto status = base::WriteWhole(options.profile, profile); !status) return Complain(status.error());
    fmt::print("wrote {}\n", options.profile);
    return 0;
  }
  if (!world) return Complain(world.error());
  if (options.command == "query") {
    Eigen::Vector2d at(options.x_m, options.y_m);
    if (options.earth) {
      const auto place = road::PlaceOnMap(*world.value(), options.x_m, options.y_m);
      if (!place) return Complain(place.error());
      at = place.value();
    }
    fmt::print("{}", road::DescribePoint(*world.value(), at.x(), at.y(), options.z_hint_m));
    return 0;
  }
  fmt::print("{}", road::DescribeWorld(*world.value()));
  for (const auto& [file, drawn] : {std::pair(options.svg, &road::PlotWorld), std::pair(options.profile, &road::PlotProfiles)}) {
    if (file.empty()) continue;
    const std::string svg = drawn(*world.value());
    if (svg.empty()) return Complain(base::WrongInput("the world has no road whose profile could be drawn", options.world_file));
    if (auto status = base::WriteWhole(file, svg); !status) return Complain(status.error());
    fmt::print("wrote {}\n", file);
  }
  return 0;
}

}  // namespace rodeira::front
