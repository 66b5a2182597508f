// SPDX-License-Identifier: Apache-2.0
// What the tables of `rodeira traffic run` show: an oracle that reads nothing but trajectories.csv, signals.csv and
// lanes.csv, with a geometry of its own. It must find nothing in a run, and each fault that is put into the tables.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "launch/rodeira/commands/traffic_command.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> Read(const std::filesystem::path& file) {
  std::ifstream text(file);
  EXPECT_TRUE(text) << file;
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream parts(line + ",");
    for (std::string cell; std::getline(parts, cell, ',');) all.push_back(cell);
    return all;
  };
  std::string line;
  std::getline(text, line);
  const auto names = cells(line);
  std::vector<Row> rows;
  while (std::getline(text, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << file << ": " << line;
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) row[names[i]] = values[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

double Number(const Row& row, const std::string& key) { return std::stod(row.at(key)); }

struct Car {
  double time_s = 0.0, x = 0.0, y = 0.0, z = 0.0, heading = 0.0, speed = 0.0, length = 0.0, width = 0.0;
  std::string id, trip, lane, kind, lamps;

  double ahead(double px, double py) const { return (px - x) * std::cos(heading) + (py - y) * std::sin(heading); }
  double front_x() const { return x + 0.5 * length * std::cos(heading); }
  double front_y() const { return y + 0.5 * length * std::sin(heading); }
  std::array<std::array<double, 2>, 4> corners() const {
    std::array<std::array<double, 2>, 4> all{};
    const double c = std::cos(heading), s = std::sin(heading);
    const double along[] = {0.5, 0.5, -0.5, -0.5}, aside[] = {0.5, -0.5, -0.5, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
      const double a = along[i] * length, b = aside[i] * width;
      all[i] = {x + a * c - b * s, y + a * s + b * c};
    }
    return all;
  }
};

struct Head {
  double x = 0.0, y = 0.0, heading = 0.0, width = 0.0;
  std::string lane;
  std::map<double, std::string> colours;  // from a time on

  bool IsRed(double time_s) const {
    const auto later = colours.upper_bound(time_s + 1e-6);
    if (later == colours.begin()) return false;
    const std::string& colour = std::prev(later)->second;
    return colour == "red" || colour == "red-amber";
  }
};

struct Cell {
  double x = 0.0, y = 0.0, free = 0.0, heading = 0.0;
  bool has_heading = false;
};

struct Tables {
  std::vector<Car> cars;                           // in the order of the file
  std::map<std::string, Head> heads;               // by signal and lane
  std::map<std::string, std::vector<Cell>> lanes;  // by ROAD:LANE, in the order of traffic
};

Tables ReadTables(const std::filesystem::path& folder) {
  Tables tables;
  for (const Row& row : Read(folder / "trajectories.csv")) {
    tables.cars.push_back({Number(row, "time_s"), Number(row, "x_m"), Number(row, "y_m"), Number(row, "z_m"),
                           Number(row, "heading_rad"), Number(row, "speed_mps"), Number(row, "length_m"),
                           Number(row, "width_m"), row.at("car"), row.at("trip"), row.at("road") + ":" + row.at("lane"),
                           row.at("kind"), row.at("lamps")});
  }
  for (const Row& row : Read(folder / "signals.csv")) {
    const std::string lane = row.at("road") + ":" + row.at("lane");
    Head& head = tables.heads[row.at("head") + " " + lane];
    head.x = Number(row, "x_m"), head.y = Number(row, "y_m"), head.heading = Number(row, "heading_rad");
    head.width = Number(row, "width_m"), head.lane = lane;
    head.colours[Number(row, "time_s")] = row.at("colour");
  }
  for (const Row& row : Read(folder / "lanes.csv")) {
    std::vector<Cell>& cells = tables.lanes[row.at("road") + ":" + row.at("lane")];
    const Cell cell{Number(row, "x_m"), Number(row, "y_m"), Number(row, "free_mps"), 0.0, false};
    if (!cells.empty() && std::hypot(cell.x - cells.back().x, cell.y - cells.back().y) < 3.0) {
      cells.back().heading = std::atan2(cell.y - cells.back().y, cell.x - cells.back().x);
      cells.back().has_heading = true;
    }
    cells.push_back(cell);
  }
  return tables;
}

bool Overlap(const Car& a, const Car& b) {
  if (std::fabs(a.z - b.z) > 2.0 || std::hypot(a.x - b.x, a.y - b.y) > a.length + b.length) return false;
  const auto ca = a.corners(), cb = b.corners();
  for (const double angle :
       {a.heading, a.heading + 0.5 * std::numbers::pi, b.heading, b.heading + 0.5 * std::numbers::pi}) {
    const auto reach = [&](const auto& corners) {
      std::array<double, 2> range{1e18, -1e18};
      for (const auto& corner : corners) {
        const double at = corner[0] * std::cos(angle) + corner[1] * std::sin(angle);
        range = {std::min(range[0], at), std::max(range[1], at)};
      }
      return range;
    };
    const auto ra = reach(ca), rb = reach(cb);
    if (ra[1] <= rb[0] + 0.01 || rb[1] <= ra[0] + 0.01) return false;  // the table has millimetres and centimetres
  }
  return true;
}

bool PassesRed(const Car& before, const Car& now, const Head& head) {
  const double c = std::cos(head.heading), s = std::sin(head.heading);
  const auto along = [&](const Car& car) { return (car.front_x() - head.x) * c + (car.front_y() - head.y) * s; };
  const auto aside = [&](const Car& car) { return (car.front_y() - head.y) * c - (car.front_x() - head.x) * s; };
  return before.lane == head.lane && along(before) <= 0.0 && along(now) > 0.0 &&
         std::fabs(aside(now)) < 0.5 * head.width && std::cos(now.heading - head.heading) > 0.5 &&
         head.IsRed(before.time_s) && head.IsRed(now.time_s);
}

constexpr double kHardest_mps2 = 8.0;  // acceleration or braking

// Faults by kind.
std::map<std::string, int> Faults(const Tables& tables) {
  std::map<std::string, int> faults;
  std::map<std::string, Car> last;  // by car and trip
  for (std::size_t i = 0; i < tables.cars.size(); ++i) {
    const Car& car = tables.cars[i];
    for (std::size_t k = i + 1; k < tables.cars.size() && tables.cars[k].time_s == car.time_s; ++k)
      faults["overlap"] += Overlap(car, tables.cars[k]) ? 1 : 0;
    const auto cells = tables.lanes.find(car.lane);
    if (cells == tables.lanes.end()) {
      ++faults["no such lane"];
    } else {
      const Cell& nearest =
          *std::min_element(cells->second.begin(), cells->second.end(), [&](const Cell& a, const Cell& b) {
            return std::hypot(a.x - car.x, a.y - car.y) < std::hypot(b.x - car.x, b.y - car.y);
          });
      if (nearest.has_heading && std::cos(car.heading - nearest.heading) < 0.0) ++faults["wrong way"];
      if (car.speed > 1.05 * nearest.free + 0.5) ++faults["too fast"];
    }
    const std::string key = car.id + "." + car.trip;
    const auto before = last.find(key);
    if (before != last.end()) {
      const double dt = car.time_s - before->second.time_s,
                   way = std::hypot(car.x - before->second.x, car.y - before->second.y);
      // Between two rows that are far apart the speed may pass what both say, and a bend be cut short.
      const double between = dt < 0.15 ? 0.1 : 0.1 + 0.25 * kHardest_mps2 * dt * dt,
                   cut = dt < 0.15 ? 1.0 : std::max(0.0, std::cos(0.5 * (car.heading - before->second.heading)));
      const double most = std::max(car.speed, before->second.speed) * dt + between,
                   least = std::min(car.speed, before->second.speed) * dt * cut - between;
      if (way > most || way < least) ++faults["teleport"];
      for (const auto& [name, head] : tables.heads) faults["red"] += PassesRed(before->second, car, head) ? 1 : 0;
    }
    last[key] = car;
  }
  std::erase_if(faults, [](const auto& fault) { return fault.second == 0; });
  return faults;
}

class TrafficOracle : public ::testing::Test {
 protected:
  static TrafficOptions OptionsFor(const std::string& map, std::uint32_t vehicles) {
    TrafficOptions options;
    options.map = SourceDir() + "/configs/maps/" + map + ".motors";
    options.vehicles = vehicles, options.duration_s = 120.0, options.step_s = 0.05, options.rows_every_s = 0.1;
    return options;
  }
  Tables RunWith(TrafficOptions options, const std::string& name) {
    options.csv = (folder_.path() / name).string();
    const Said said = SaidBy(TrafficRun, options);
    EXPECT_EQ(said.status, 0) << said.errors;
    EXPECT_NE(said.out.find("collisions       0\nred lights       passed 0 times\n"), std::string::npos) << said.out;
    return ReadTables(options.csv);
  }
  Tables Run(const std::string& map, std::uint32_t vehicles) { return RunWith(OptionsFor(map, vehicles), map); }
  const TemporaryFolder folder_;
};

using Found = std::map<std::string, int>;

TEST_F(TrafficOracle, FindsNothingInARun) {
  for (const char* map : {"lights", "town", "roundabout"}) {
    const Tables tables = Run(map, 30);
    EXPECT_GT(tables.cars.size(), 10000u);
    EXPECT_EQ(Faults(tables), Found{}) << map;
  }
}

// Lights, a grid of streets, a ring and a ramp, each with as much traffic as flows through: with steps of half a second
// and of a second nothing is hit, no red is crossed, and as many vehicles come through as with 0.1 s, within 3 %.
TEST_F(TrafficOracle, LongStepsHitNothingAndLetAsManyThrough) {
  const std::map<std::string, int> flows{{"lights", 1000}, {"town", 1500}, {"roundabout", 1200}, {"ramp", 1500}};
  for (const auto& [map, flow] : flows) {
    TrafficOptions options = OptionsFor(map, 400);
    options.settings = folder_.path() / (map + ".yaml");
    std::ofstream(options.settings) << "rodeira: traffic/1\nflows:\n  - {vehicles_per_h: " << flow << "}\n";
    options.duration_s = 900.0;
    double through = 0.0;
    for (const double step_s : {0.1, 0.5, 1.0}) {
      options.step_s = step_s, options.rows_every_s.reset();
      const std::string name = fmt::format("{} {}", map, step_s);
      const Tables tables = RunWith(options, name);
      EXPECT_EQ(Faults(tables), Found{}) << name;
      const auto ended = static_cast<double>(Read(folder_.path() / name / "trips.csv").size());
      EXPECT_GT(ended, 100.0) << name;
      if (step_s == 0.1) through = ended;
      EXPECT_NEAR(ended, through, 0.03 * through) << name;
    }
  }
}

TEST_F(TrafficOracle, TablesSayKindsLampsAndColours) {
  const Tables tables = Run("lights", 30);
  std::map<std::string, int> kinds, lamps;
  for (const Car& car : tables.cars) {
    ++kinds[car.kind], ++lamps[car.lamps];
    EXPECT_GT(car.length, 3.0);
    EXPECT_GT(car.width, 1.4);
  }
  EXPECT_GT(kinds["car"], 0);
  EXPECT_GT(kinds["van"], 0);
  EXPECT_EQ(kinds.size(), 2u);
  EXPECT_GT(lamps["brake"], 0);
  EXPECT_GT(lamps["left"] + lamps["brake+left"], 0);
  EXPECT_GT(lamps["right"] + lamps["brake+right"], 0);
  ASSERT_EQ(tables.heads.size(), 4u);
  for (const auto& [name, head] : tables.heads) {
    EXPECT_EQ(head.colours.begin()->first, 0.0);
    // By Vienna's rule as the project has it: green, amber, red, red and amber, and so on.
    const std::map<std::string, std::string> next{
        {"green", "amber"}, {"amber", "red"}, {"red", "red-amber"}, {"red-amber", "green"}};
    for (auto at = head.colours.begin(); std::next(at) != head.colours.end(); ++at)
      EXPECT_EQ(std::next(at)->second, next.at(at->second)) << name << " after " << at->first << " s";
    EXPECT_GT(head.colours.size(), 4u);
  }
}

TEST_F(TrafficOracle, FindsFaultsThatArePutIn) {
  const Tables whole = Run("lights", 30);
  const auto with = [&](const auto& change) {
    Tables changed = whole;
    change(changed);
    return Faults(changed);
  };
  const std::size_t middle = whole.cars.size() / 2;
  const auto found = [](const Found& faults, const char* kind) { return faults.contains(kind) ? faults.at(kind) : 0; };
  EXPECT_GT(
      found(with([&](Tables& t) { t.cars[middle].x = t.cars[middle + 1].x, t.cars[middle].y = t.cars[middle + 1].y; }),
            "overlap"),
      0);
  EXPECT_EQ(found(with([&](Tables& t) { t.cars[middle].heading += std::numbers::pi; }), "wrong way"), 1);
  EXPECT_EQ(found(with([&](Tables& t) { t.cars[middle].speed = 40.0; }), "too fast"), 1);
  EXPECT_GT(found(with([&](Tables& t) { t.cars[middle].x += 3.0; }), "teleport"), 0);
  EXPECT_GT(found(with([&](Tables& t) {
                    for (auto& [name, head] : t.heads) {
                      for (auto& [time, colour] : head.colours) colour = colour == "green" ? "red" : colour;
                    }
                  }),
                  "red"),
            10);
}

}  // namespace
}  // namespace rodeira::cli
