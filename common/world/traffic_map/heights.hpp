// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/lights/light_plan.hpp"

namespace rodeira::traffic_map {

// Elevation of a curve: z at its four control points, m; between them z(t) is the cubic with the plan's own parameter.
struct CurveHeights {
  std::int32_t curve = 0;
  std::array<double, 4> z_m{};
  std::size_t line = 0;  // of the file
};

enum class SignKind : std::int8_t { kStop, kGiveWay, kPriority, kSpeedLimit };
constexpr int kSignKinds = 4;
// As files call it: "stop", "give_way", "priority", "speed_limit".
std::string_view NameOf(SignKind kind);

// A sign beside a lane, for its traffic.
struct LaneSign {
  std::int32_t lane = 0;
  SignKind kind = SignKind::kGiveWay;
  double before_end_m = 0.0;  // so far before the lane's end, or at its beginning where the lane is shorter
  double limit_kmh = 0.0;     // of a speed limit, which holds from there to the lane's end
  std::size_t line = 0;       // of the file
};

// How many vehicles should come in on a start lane.
struct LaneFlow {
  std::int32_t lane = 0;
  double vehph = 0.0;
  std::size_t line = 0;
};

// What a `.motors` file has no place for: the companion FILE.motors.yaml beside it. Curves that it does not name lie at
// 0.
struct Heights {
  std::vector<CurveHeights> curves;       // by ascending number, each once
  std::vector<lights::LightPlan> lights;  // of each junction; names are numbers of lanes, with a light at their end
  std::vector<LaneSign> signs;
  std::vector<LaneFlow> flows;  // by ascending number, each once
  bool left_hand =
      false;  // the map's traffic keeps to the left: a vehicle from the left has priority, signs stand on the left

  // z of a curve's four control points, m; zeros where the file does not name it.
  std::array<double, 4> Of(std::int32_t curve) const;
};

// The number at the end of "FILE:12"; 0 where there is none.
std::size_t LineOf(const std::string& place);

// From the companion's text; `name` stands for the file in messages. Wrong input: the file's first problem.
base::Result<Heights> ParseHeights(std::string_view text, const std::filesystem::path& name);
// The companion of a map; empty where there is no such file. Wrong input as ParseHeights, or where it cannot be read.
base::Result<Heights> LoadHeightsOf(const std::filesystem::path& map_file);

}  // namespace rodeira::traffic_map
