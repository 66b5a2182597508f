// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/heat_map/heat_map.hpp"
#include "common/view/scene/vehicles/equal_ids.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kLevel_m = 5.0;
constexpr double kLongestPiece_m = 0.25 * HeatMap::kSquare_m;
constexpr double kUnknownLimit_mps = 100.0 / 3.6;
constexpr std::array<HeatScale, kHeatKinds> kScales{
    HeatScale{"speed", "% of the limit", 0.0, 100.0}, HeatScale{"flow", "vehicles/h", 0.0, 1800.0},
    HeatScale{"density", "vehicles/km", 80.0, 0.0}, HeatScale{"fuel", "l/100 km", 20.0, 0.0}};

std::uint8_t ColourByte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

const HeatScale& ScaleOf(HeatKind kind) { return kScales[static_cast<std::size_t>(kind)]; }

Colour HeatColour(double share) {
  Colour colour = Colour::Of(0);
  colour.red = ColourByte(2.0 - 2.0 * share);
  colour.green = ColourByte(2.0 * share);
  return colour;
}

HeatCell& HeatMap::CellAt(const Vector3d& p_W) {
  const auto number = [](double x, double side) { return static_cast<std::int64_t>(std::floor(x / side)); };
  const Key key{number(p_W.x(), kSquare_m), number(p_W.y(), kSquare_m), number(p_W.z(), kLevel_m)};
  const auto known = cells_.find(key);
  if (known != cells_.end()) return known->second;
  HeatCell& cell = cells_[key];
  const network::Network* network = world_.network();
  const auto place = network != nullptr ? network->Locate(p_W.x(), p_W.y(), p_W.z()) : std::nullopt;
  const network::Lane* lane = place && place->distance_m <= 0.0 ? network->Find(place->lane) : nullptr;
  if (lane != nullptr) {
    const auto limit = network->roads()[place->lane.road].SpeedLimitAt(*lane, place->s_m);
    if (limit && std::isfinite(*limit) && *limit > 0.0) cell.limit_mps = *limit;
  }
  return cell;
}

void HeatMap::AddWay(const Vector3d& from_W, const Vector3d& to_W, double time_s, std::optional<double> fuel_l) {
  constexpr double kFastest_mps = 150.0;
  const double way_m = (to_W - from_W).head<2>().norm();
  if (way_m > 1.0 + kFastest_mps * time_s) return;  // placed elsewhere
  const int pieces = std::max(1, static_cast<int>(std::ceil(way_m / kLongestPiece_m)));
  const double share = 1.0 / pieces;
  for (int piece = 0; piece < pieces; ++piece) {
    const Vector3d at_W = from_W + (piece + 0.5) * share * (to_W - from_W);
    HeatCell& cell = CellAt(at_W);
    cell.time_s += share * time_s;
    cell.height_ms += at_W.z() * share * time_s;
    cell.distance_m += share * way_m;
    if (!fuel_l) continue;
    cell.fuel_l += share * *fuel_l;
    cell.fuel_distance_m += share * way_m;
  }
}

void HeatMap::Add(const SceneSnapshot& moment) {
  const double passed_s = before_ ? std::fabs(static_cast<double>(moment.time_ns - before_->time_ns)) * 1e-9 : 0.0;
  if (passed_s > kLongest_s) Clear();
  if (before_ && passed_s > 0.0) {
    watched_s_ += passed_s;
    ForEqualIds(before_->agents, moment.agents, [&](const AgentPose& a, const AgentPose& b) {
      if (b.kind == AgentKind::kPedestrian) return;  // a map of vehicles
      // What is said of its fuel comes more seldom than moments: its flow, which holds until then, is as even as the
      // way.
      const auto fuel_l = a.detail && b.detail
                              ? std::optional(0.5 * (a.detail->fuel_lph + b.detail->fuel_lph) * passed_s / 3600.0)
                              : std::nullopt;
      AddWay(a.p_WB_W, b.p_WB_W, passed_s, fuel_l);
    });
    ForEqualIds(before_->cars, moment.cars, [&](const CarPose& a, const CarPose& b) {
      AddWay(a.p_WB_W, b.p_WB_W, passed_s, std::fabs(a.fuel_used_l - b.fuel_used_l));
    });
  }
  before_ = moment;
}

void HeatMap::Clear() {
  cells_.clear();
  before_.reset();
  watched_s_ = 0.0;
}

std::optional<double> HeatMap::Value(HeatKind kind, const HeatCell& cell) const {
  if (cell.time_s <= 0.0 || watched_s_ <= 0.0) return std::nullopt;
  switch (kind) {
    case HeatKind::kSpeed:
      return 100.0 * cell.distance_m / cell.time_s / (cell.limit_mps > 0.0 ? cell.limit_mps : kUnknownLimit_mps);
    case HeatKind::kFlow:
      return 3600.0 * cell.distance_m / (kSquare_m * watched_s_);
    case HeatKind::kDensity:
      return 1000.0 * cell.time_s / (kSquare_m * watched_s_);
    case HeatKind::kFuel:
      break;
  }
  return cell.fuel_distance_m > 0.0 ? std::optional(1e5 * cell.fuel_l / cell.fuel_distance_m) : std::nullopt;
}

}  // namespace rodeira::scene
