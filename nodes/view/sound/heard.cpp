// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/sound/heard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/lighting/air.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::size_t kNearest = 4;
constexpr double kFarthest_m = 80.0, kHalf_m = 6.0;  // where another car is half as loud as beside it
constexpr double kOutsideShare = 0.5;                // of another car's loudness, through one's own body

sound::Voice VoiceOf(const scene::AgentPose& agent) {
  return {
      900.0 + 75.0 * std::fabs(agent.speed_mps), agent.lights.brake ? 0.0 : 0.35, agent.speed_mps, 0.0, 1.0, 0.0, 0.0};
}

sound::Voice VoiceOf(const scene::CarPose& car) {
  return {car.engine_rpm, car.throttle, car.speed_mps, car.sliding, 1.0, 0.0, car.horn ? 1.0 : 0.0};
}

}  // namespace

sound::Heard HeardBy(const scene::SceneSnapshot& moment, std::size_t followed, double volume) {
  sound::Heard heard;
  const auto body = scene::BodyAt(moment, followed);
  if (!body) return heard;
  heard.volume = volume;
  heard.rain = static_cast<double>(scene::MakeAir(moment.weather).rain);
  const bool is_car = followed < moment.cars.size();
  const auto on_foot = [](const scene::AgentPose& agent) {
    return agent.kind == scene::AgentKind::kPedestrian;
  };  // and so not heard
  if (is_car)
    heard.own = VoiceOf(moment.cars[followed]);
  else if (const scene::AgentPose& agent = moment.agents[followed - moment.cars.size()]; !on_foot(agent))
    heard.own = VoiceOf(agent);
  if (is_car) heard.crash = moment.cars[followed].blow;

  struct Near {
    double distance_m;
    std::uint64_t id;
    sound::Voice voice;
  };
  std::vector<Near> near;
  const auto add = [&](std::uint64_t id, const Eigen::Vector3d& p_W, sound::Voice voice) {
    const Eigen::Vector3d to_B = body->q_WB.conjugate() * (p_W - body->p_WB_W);
    const double distance_m = to_B.norm();
    if (distance_m > kFarthest_m) return;
    voice.gain = kOutsideShare * (1.0 / (1.0 + (distance_m / kHalf_m) * (distance_m / kHalf_m))) *
                 (1.0 - distance_m / kFarthest_m);
    voice.pan = distance_m > 1e-3 ? -to_B.y() / distance_m : 0.0;
    near.push_back({distance_m, id, voice});
  };
  constexpr std::uint64_t kCar = std::uint64_t{1} << 63;  // agents' ids are smaller
  for (std::size_t i = 0; i < moment.cars.size(); ++i) {
    if (i != followed) add(kCar | moment.cars[i].id, moment.cars[i].p_WB_W, VoiceOf(moment.cars[i]));
  }
  for (std::size_t i = 0; i < moment.agents.size(); ++i) {
    if (i + moment.cars.size() != followed && !on_foot(moment.agents[i]))
      add(moment.agents[i].id, moment.agents[i].p_WB_W, VoiceOf(moment.agents[i]));
  }
  std::sort(near.begin(), near.end(),
            [](const Near& a, const Near& b) { return std::pair(a.distance_m, a.id) < std::pair(b.distance_m, b.id); });
  for (std::size_t i = 0; i < std::min(kNearest, near.size()); ++i) heard.others[near[i].id] = near[i].voice;
  return heard;
}

}  // namespace rodeira::nodes
