// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/vehicle_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/print_error.hpp"
#include "common/driving/manoeuvres/force_trace.hpp"
#include "common/driving/manoeuvres/manoeuvre.hpp"
#include "common/vehicle/dynamics/vehicle_notes.hpp"
#include "launch/rodeira/commands/rig_command.hpp"
#include "launch/rodeira/commands/tyre_command.hpp"
#include "launch/rodeira/input_files.hpp"

namespace rodeira::cli {
namespace {

base::Result<std::vector<const manoeuvres::Manoeuvre*>> Chosen(const VehicleOptions& options) {
  std::vector<const manoeuvres::Manoeuvre*> chosen;
  for (const std::string& name : options.manoeuvres) {
    const auto found = manoeuvres::FindManoeuvre(name);
    if (!found) return found.error();
    chosen.push_back(found.value());
  }
  if (chosen.empty()) {
    for (const manoeuvres::Manoeuvre& manoeuvre : manoeuvres::Manoeuvres()) chosen.push_back(&manoeuvre);
  }
  if (chosen.size() > 1 && (!options.csv.empty() || !options.svg.empty())) {
    return base::WrongInput(
        "command.wrong_combination",
        fmt::format("{} manoeuvres are to be driven; --out FOLDER writes them all, --csv and --svg are of one",
                    chosen.size()),
        options.csv.empty() ? "--svg" : "--csv");
  }
  if (!(options.step_s > 0.0 && options.step_s <= 0.1))
    return base::WrongInput("command.wrong_value",
                            fmt::format("{} s was found; over 0 and at most 0.1 s was expected", options.step_s),
                            "--step");
  return chosen;
}

base::Status Write(const VehicleOptions& options, const manoeuvres::Manoeuvre& manoeuvre, const plot::Table& table) {
  std::string csv = options.csv, svg = options.svg;
  if (!options.out.empty()) {
    std::error_code problem;
    std::filesystem::create_directories(options.out, problem);
    csv = options.out + "/" + manoeuvre.name + ".csv";
    svg = options.out + "/" + manoeuvre.name + ".svg";
  }
  const std::string title =
      fmt::format("{}: {}", std::filesystem::path(options.file).filename().string(), manoeuvre.what);
  if (!csv.empty()) {
    if (auto status = base::WriteWhole(csv, plot::ToCsv(table)); !status) return status;
  }
  if (!svg.empty()) {
    if (auto status = base::WriteWhole(svg, plot::ToSvg(table, title)); !status) return status;
  }
  return {};
}

base::Status WriteForces(const VehicleOptions& options, const manoeuvres::Manoeuvre& manoeuvre,
                         const manoeuvres::ForceTrace& trace) {
  const std::string base = options.out + "/" + manoeuvre.name + "_forces";
  if (auto status = base::WriteWhole(base + ".csv", plot::ToCsv(trace.ForceTable())); !status) return status;
  const std::string title = fmt::format("{}: forces in joints and springs, {}",
                                        std::filesystem::path(options.file).filename().string(), manoeuvre.name);
  return base::WriteWhole(base + ".svg", plot::ToSvg(trace.Diagrams(), title, 3));
}

int TestVehicle(const VehicleOptions& options) {
  const auto chosen = Chosen(options);
  if (!chosen) return base::PrintError("rodeira", chosen.error());
  base::TraceCrashes();  // of a vehicle that others wrote
  auto car = dynamics::LoadVehicle(options.file);
  if (!car) return base::PrintError("rodeira", car.error());
  for (const std::string& note : dynamics::NotesOn(*car.value(), options.file))
    base::Log(base::LogLevel::kWarning, "", note);
  if (options.forces && !car.value()->has_joint_forces())
    return base::PrintError("rodeira", base::WrongInput("vehicle.no_joints",
                                                        "--forces was found, but the vehicle has no joints; a vehicle "
                                                        "file with 'model: multibody' was expected",
                                                        options.file));
  manoeuvres::ForceTrace trace(*car.value());
  dynamics::VehicleModel& driven = options.forces ? trace : *car.value();
  const bool shown = !options.quiet && ::isatty(STDERR_FILENO) == 1;
  int status = 0;
  for (const manoeuvres::Manoeuvre* manoeuvre : chosen.value()) {
    if (shown) fmt::print(stderr, "\r\033[K{} …", manoeuvre->name);
    const auto outcome = manoeuvres::Drive(*manoeuvre, driven, options.step_s);
    if (shown) fmt::print(stderr, "\r\033[K");
    if (!options.quiet) fmt::print("{}: {}\n", manoeuvre->name, manoeuvre->what);
    if (!outcome) {
      status = base::PrintError("rodeira", outcome.error().In(manoeuvre->name));
      continue;
    }
    for (const manoeuvres::Figure& figure : outcome.value().figures) {
      if (!options.quiet) fmt::print("  {:<36} {:>10.3f} {}\n", figure.name, figure.value, figure.unit);
    }
    for (const std::string& reason : outcome.value().missing) {
      if (!options.quiet) fmt::print("  not measured: {}\n", reason);
    }
    if (auto written = Write(options, *manoeuvre, outcome.value().table); !written)
      return base::PrintError("rodeira", written.error());
    if (!options.forces) continue;
    if (auto written = WriteForces(options, *manoeuvre, trace); !written)
      return base::PrintError("rodeira", written.error());
  }
  if (!options.quiet && !options.out.empty()) fmt::print("wrote {}\n", options.out);
  return status;
}

}  // namespace

int Vehicle(const VehicleOptions& options) {
  if (options.command == "list") {
    fmt::print("{}", ListInputFiles(InputKind::kVehicle));
    return 0;
  }
  if (options.command == "tyre") return Tyre(options);
  auto file = ResolveInputFile(InputKind::kVehicle, options.file);
  if (!file) return base::PrintError("rodeira", file.error());
  VehicleOptions resolved = options;
  resolved.file = std::move(file).value();
  return options.command == "rig" ? SuspensionBench(resolved) : TestVehicle(resolved);
}

}  // namespace rodeira::cli
