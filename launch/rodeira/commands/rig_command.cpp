// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/rig_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/base/constants.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/plot/curves.hpp"
#include "common/core/plot/table.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/suspension_rig.hpp"

namespace rodeira::cli {
namespace {

using dynamics::kWheels;
using dynamics::SuspensionFigures;
using dynamics::SuspensionRig;
using dynamics::WheelCompliance;
using dynamics::WheelPosition;
using Positions = std::array<WheelPosition, kWheels>;

constexpr std::array<const char*, kWheels> kColumns = {"front_left", "front_right", "rear_left", "rear_right"};
constexpr std::array<const char*, kWheels> kTitles = {"front left", "front right", "rear left", "rear right"};
constexpr double kRigDegree = base::kPi / 180.0;
constexpr double kRigTravelStep_m = 0.0025;
constexpr int kSteeringSteps = 24;  // a side

// Positions of all wheels over one quantity (travel in m, steering wheel in rad), rising.
struct Sweep {
  std::vector<double> over;
  std::vector<Positions> wheels;
  std::optional<base::Error> below, above;  // why it ends before what was asked for
};

Positions AllWheels(const SuspensionRig& rig) {
  Positions positions;
  for (std::size_t i = 0; i < kWheels; ++i) positions[i] = rig.wheel(i);
  return positions;
}

// From the middle down, then up, as far as `move` succeeds.
Sweep SweepOver(SuspensionRig& rig, double limit, int steps, const std::function<base::Status(double)>& move) {
  Sweep sweep;
  for (int i = 0; i >= -steps && !sweep.below; --i) {
    if (auto status = move(limit * i / steps); !status) {
      sweep.below = status.error();
      continue;
    }
    sweep.over.push_back(limit * i / steps);
    sweep.wheels.push_back(AllWheels(rig));
  }
  std::ranges::reverse(sweep.over);
  std::ranges::reverse(sweep.wheels);
  (void)move(0.0);
  for (int i = 1; i <= steps && !sweep.above; ++i) {
    if (auto status = move(limit * i / steps); !status) {
      sweep.above = status.error();
      continue;
    }
    sweep.over.push_back(limit * i / steps);
    sweep.wheels.push_back(AllWheels(rig));
  }
  (void)move(0.0);
  return sweep;
}

// A quantity of a wheel's position, beside where it is drawn.
struct RigQuantity {
  const char* name;   // of the column
  const char* title;  // of the diagram
  const char* axis;
  std::function<double(const WheelPosition& now, const WheelPosition& drawn)> value;
};

std::vector<RigQuantity> Quantities() {
  return {
      {"toe_in_deg", "Toe-in", "deg", [](const auto& now, const auto&) { return now.toe_in_rad / kRigDegree; }},
      {"camber_deg", "Camber", "deg", [](const auto& now, const auto&) { return now.camber_rad / kRigDegree; }},
      {"outward_m", "Way of the contact outward", "m",
       [](const auto& now, const auto& drawn) {
         return std::copysign(1.0, drawn.contact_m.y()) * (now.contact_m.y() - drawn.contact_m.y());
       }},
      {"forward_m", "Way of the contact forward", "m",
       [](const auto& now, const auto& drawn) { return now.contact_m.x() - drawn.contact_m.x(); }},
      {"spring_m", "Length of the spring", "m", [](const auto& now, const auto&) { return now.spring_m; }},
      {"spring_N", "Force of the spring, tension positive", "N",
       [](const auto& now, const auto&) { return now.spring_N; }},
  };
}

plot::Table TravelTable(const Sweep& sweep, const Positions& drawn) {
  plot::Table table{{"travel_m"}, {}};
  const auto quantities = Quantities();
  for (const char* wheel : kColumns) {
    for (const RigQuantity& quantity : quantities) table.names.push_back(fmt::format("{}_{}", wheel, quantity.name));
  }
  for (std::size_t row = 0; row < sweep.over.size(); ++row) {
    table.values.push_back(sweep.over[row]);
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      for (const RigQuantity& quantity : quantities)
        table.values.push_back(quantity.value(sweep.wheels[row][wheel], drawn[wheel]));
    }
  }
  return table;
}

std::vector<plot::Diagram> TravelDiagrams(const Sweep& sweep, const Positions& drawn) {
  std::vector<plot::Diagram> diagrams;
  for (const RigQuantity& quantity : Quantities()) {
    plot::Diagram diagram{quantity.title, "travel in m", fmt::format("in {}", quantity.axis), {}};
    for (const std::size_t wheel : {dynamics::kFrontLeft, dynamics::kRearLeft}) {
      plot::Curve curve{kTitles[wheel], {}};
      for (std::size_t row = 0; row < sweep.over.size(); ++row)
        curve.points.emplace_back(sweep.over[row], quantity.value(sweep.wheels[row][wheel], drawn[wheel]));
      diagram.curves.push_back(std::move(curve));
    }
    diagrams.push_back(std::move(diagram));
  }
  return diagrams;
}

// The angle of the outer front wheel at which both front wheels roll about one point on the rear axle's line, and the
// inner one's as it is.
double OuterWithoutSlip(double inner_rad, double track_m, double wheelbase_m) {
  if (inner_rad == 0.0) return 0.0;
  const double cot = 1.0 / std::tan(std::fabs(inner_rad)) + track_m / wheelbase_m;
  return std::copysign(std::atan(1.0 / cot), inner_rad);
}

plot::Table SteeringTable(const Sweep& sweep, const dynamics::VehicleDimensions& car) {
  plot::Table table{{"steering_wheel_deg", "front_left_deg", "front_right_deg", "outer_without_slip_deg"}, {}};
  for (std::size_t row = 0; row < sweep.over.size(); ++row) {
    const double left = sweep.wheels[row][dynamics::kFrontLeft].steer_rad,
                 right = sweep.wheels[row][dynamics::kFrontRight].steer_rad;
    const double inner = left + right > 0.0 ? left : right;
    for (const double angle :
         {sweep.over[row], left, right, OuterWithoutSlip(inner, car.track_front_m, car.wheelbase_m)})
      table.values.push_back(angle / kRigDegree);
  }
  return table;
}

std::vector<plot::Diagram> SteeringDiagrams(const plot::Table& table) {
  plot::Diagram angles{"Angles of the front wheels", "steering wheel in deg", "in deg, left positive", {}};
  const std::array<const char*, 4> names = {"", "left", "right", "outer, without slip"};
  for (std::size_t column = 1; column < 4; ++column) {
    plot::Curve curve{names[column], {}};
    for (std::size_t row = 0; row < table.rows(); ++row)
      curve.points.emplace_back(table.At(row, 0), table.At(row, column));
    angles.curves.push_back(std::move(curve));
  }
  return {angles};
}

void PrintRow(const char* name, const char* unit, const std::function<std::string(std::size_t)>& value) {
  fmt::print("  {:<30}", name);
  for (std::size_t i = 0; i < kWheels; ++i) fmt::print(" {:>11}", value(i));
  fmt::print("  {}\n", unit);
}

std::string RoundedNumber(double value, int digits) {
  return fmt::format("{:.{}f}", std::fabs(value) < 0.5 * std::pow(10.0, -digits) ? 0.0 : value, digits);
}

void PrintFigures(const Positions& drawn, const std::array<SuspensionFigures, kWheels>& figures) {
  const auto of_axis = [&](double SuspensionFigures::SteeringAxis::*member, double unit, int digits) {
    return [&, member, unit, digits](std::size_t i) {
      const auto& axis = figures[i].steering_axis;
      return axis ? RoundedNumber((*axis).*member / unit, digits) : std::string("-");
    };
  };
  PrintRow("as drawn", "", [](std::size_t i) { return std::string(kTitles[i]); });
  PrintRow("toe-in", "deg", [&](std::size_t i) { return RoundedNumber(drawn[i].toe_in_rad / kRigDegree, 3); });
  PrintRow("camber", "deg", [&](std::size_t i) { return RoundedNumber(drawn[i].camber_rad / kRigDegree, 3); });
  PrintRow("toe-in over travel", "deg/m",
           [&](std::size_t i) { return RoundedNumber(figures[i].bump_steer_radpm / kRigDegree, 2); });
  PrintRow("camber over travel", "deg/m",
           [&](std::size_t i) { return RoundedNumber(figures[i].camber_gain_radpm / kRigDegree, 2); });
  PrintRow("contact outward over travel", "1",
           [&](std::size_t i) { return RoundedNumber(figures[i].lateral_share, 4); });
  PrintRow("contact forward over travel", "1",
           [&](std::size_t i) { return RoundedNumber(figures[i].forward_share, 4); });
  PrintRow("height of the roll centre", "mm",
           [&](std::size_t i) { return RoundedNumber(1000.0 * figures[i].roll_centre_m, 1); });
  PrintRow("spring over travel", "1", [&](std::size_t i) { return RoundedNumber(figures[i].spring_share, 4); });
  PrintRow("stiffness at the wheel", "N/m", [&](std::size_t i) { return RoundedNumber(figures[i].wheel_rate_Npm, 0); });
  using Axis = SuspensionFigures::SteeringAxis;
  PrintRow("caster", "deg", of_axis(&Axis::caster_rad, kRigDegree, 2));
  PrintRow("steering axis inclination", "deg", of_axis(&Axis::inclination_rad, kRigDegree, 2));
  PrintRow("scrub radius", "mm", of_axis(&Axis::scrub_radius_m, 0.001, 1));
  PrintRow("caster trail", "mm", of_axis(&Axis::trail_m, 0.001, 1));
}

void PrintCompliance(const std::array<WheelCompliance, kWheels>& compliance, double column_Nmprad) {
  using Change = WheelCompliance::Change;
  fmt::print(
      "a force on one wheel, steering wheel and heights held: the column gives way ({:g} N m/rad), joints are rigid\n",
      column_Nmprad);
  const auto of = [&](Change WheelCompliance::*force, double Change::*angle, double unit) {
    return [&compliance, force, angle, unit](std::size_t i) {
      return RoundedNumber(compliance[i].*force.*angle * unit / kRigDegree, 4);
    };
  };
  PrintRow("toe-in by force outward", "deg/kN", of(&WheelCompliance::lateral, &Change::toe_in_rad, 1000.0));
  PrintRow("camber by force outward", "deg/kN", of(&WheelCompliance::lateral, &Change::camber_rad, 1000.0));
  PrintRow("toe-in by force forward", "deg/kN", of(&WheelCompliance::longitudinal, &Change::toe_in_rad, 1000.0));
  PrintRow("camber by force forward", "deg/kN", of(&WheelCompliance::longitudinal, &Change::camber_rad, 1000.0));
  PrintRow("toe-in by torque to toe-in", "deg/100 Nm", of(&WheelCompliance::aligning, &Change::toe_in_rad, 100.0));
  PrintRow("camber by torque to toe-in", "deg/100 Nm", of(&WheelCompliance::aligning, &Change::camber_rad, 100.0));
}

base::Status WriteFiles(const std::string& folder, const std::string& name, const Sweep& travel, const Sweep& steering,
                        const Positions& drawn, const dynamics::VehicleDimensions& dimensions) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  const plot::Table angles = SteeringTable(steering, dimensions);
  const std::pair<const char*, std::string> files[] = {
      {"travel.csv", plot::ToCsv(TravelTable(travel, drawn))},
      {"travel.svg", plot::ToSvg(TravelDiagrams(travel, drawn), name + ": suspensions over travel")},
      {"steering.csv", plot::ToCsv(angles)},
      {"steering.svg", plot::ToSvg(SteeringDiagrams(angles), name + ": steering", 1)}};
  for (const auto& [file, text] : files) {
    if (auto status = base::WriteWhole(std::filesystem::path(folder) / file, text); !status) return status;
  }
  return {};
}

}  // namespace

int SuspensionBench(const VehicleOptions& options) {
  if (!(options.travel_m >= 0.001 && options.travel_m <= 0.5))
    return base::PrintError(
        "rodeira",
        base::WrongInput("command.wrong_value",
                         fmt::format("{} m was found; 0.001 to 0.5 m was expected", options.travel_m), "--travel"));
  auto model = dynamics::LoadVehicle(options.file, "multibody");
  if (!model) return base::PrintError("rodeira", model.error());
  const auto* car = dynamic_cast<const dynamics::MultibodyModel*>(model.value().get());
  auto made = SuspensionRig::Make(car->settings());
  if (!made) return base::PrintError("rodeira", made.error());
  SuspensionRig rig = std::move(made).value();
  const Positions drawn = AllWheels(rig);
  std::array<SuspensionFigures, kWheels> figures;
  std::array<WheelCompliance, kWheels> compliance;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const auto found = rig.Figures(i, 0.0);
    if (!found) return base::PrintError("rodeira", found.error().In(options.file));
    const auto gives_way = rig.Compliance(i, 0.0);
    if (!gives_way) return base::PrintError("rodeira", gives_way.error().In(options.file));
    figures[i] = found.value();
    compliance[i] = gives_way.value();
  }
  const std::string name = std::filesystem::path(options.file).filename().string();
  if (!options.quiet) {
    fmt::print("{}: suspensions on a rig, chassis held, without tyres and weight\n", name);
    PrintFigures(drawn, figures);
    PrintCompliance(compliance, car->settings().steering.column_Nmprad);
  }
  if (options.out.empty()) return 0;
  const auto all = [](double travel) {
    std::array<double, kWheels> travels{};
    travels.fill(travel);
    return travels;
  };
  const int steps = std::max(1, static_cast<int>(std::lround(options.travel_m / kRigTravelStep_m)));
  const Sweep travel = SweepOver(rig, options.travel_m, steps, [&](double to) { return rig.MoveTo(all(to), 0.0); });
  const Sweep steering = SweepOver(rig, car->settings().steering.limit_rad, kSteeringSteps,
                                   [&](double to) { return rig.MoveTo(all(0.0), to); });
  if (auto status = WriteFiles(options.out, name, travel, steering, drawn, car->dimensions()); !status)
    return base::PrintError("rodeira", status.error());
  if (options.quiet) return 0;
  for (const auto& end : {travel.below, travel.above, steering.below, steering.above}) {
    if (end) fmt::print("  ends before: {}\n", end->message);
  }
  fmt::print("wrote {}\n", options.out);
  return 0;
}

}  // namespace rodeira::cli
