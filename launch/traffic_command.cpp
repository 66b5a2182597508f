#include "launch/traffic_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "common/map/map_network.hpp"
#include "common/traffic/road_network.hpp"
#include "common/traffic/study.hpp"

namespace rodeira::front {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kRowEvery_s = 0.5;

int Complain(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

double SecondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

base::Result<std::shared_ptr<const network::Network>> Roads(const std::string& map) {
  if (std::filesystem::path(map).extension() == ".motors") return map::LoadNetwork(map);
  const auto world = road::World::Load(map);
  if (!world) return world.error();
  return traffic::NetworkOf(world.value());
}

// One row a car and half second.
class Trajectories {
 public:
  base::Status Open(const std::string& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    path_ = (std::filesystem::path(folder) / "trajectories.csv").string();
    out_.open(path_);
    if (problem || !out_) return base::Failed("the folder cannot be written to", folder);
    out_ << "time_s,car,trip,x_m,y_m,z_m,heading_rad,speed_mps,acceleration_mps2,road,lane\n";
    return {};
  }
  void Write(const traffic::StudyMoment& moment) {
    if (!out_.is_open() || moment.time_s < next_s_ - 1e-9) return;
    next_s_ += kRowEvery_s;
    for (const traffic::AgentPose& pose : moment.model.poses()) {
      const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
      out_ << fmt::format("{:.2f},{},{},{:.3f},{:.3f},{:.3f},{:.5f},{:.3f},{:.3f},{},{}\n", moment.time_s, pose.id, pose.trip,
                          pose.p_WB_W.x(), pose.p_WB_W.y(), pose.p_WB_W.z(), std::atan2(forward.y(), forward.x()), pose.speed_mps,
                          pose.acceleration_mps2, moment.model.graph().network().roads()[static_cast<std::size_t>(pose.road)].id(),
                          pose.lane);
    }
  }
  base::Status Close() {
    if (!out_.is_open()) return {};
    out_.close();
    if (!out_) return base::Failed("the table could not be written to its end", path_);
    return {};
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::ofstream out_;
  double next_s_ = 0.0;
};

void Describe(const TrafficOptions& options, const traffic::StudyResult& r, double wall_s) {
  fmt::print("vehicles         {} on the road, {} waiting to enter, {} trips ended\n", r.on_road, r.waiting, r.arrivals);
  fmt::print("driven           {:.3f} km at {:.2f} m/s in the mean\n", r.driven_km, r.mean_speed_mps());
  fmt::print("standing         {:.1f} % of the time, at most {:.1f} s (car {}), with room ahead {:.1f} s\n",
             r.vehicle_s > 0.0 ? 100.0 * r.standing_s / r.vehicle_s : 0.0, r.longest_stand_s, r.longest_stand_id, r.longest_with_room_s);
  fmt::print("hardest braking  {:.2f} m/s2\n", r.hardest_mps2);
  fmt::print("collisions       {}\n", r.collisions);
  fmt::print("beside its lane  {} times, looked at every 0.1 s\n", r.off_lane);
  fmt::print("wall time        {:.2f} s, {:.1f} times real time, {:.0f} vehicle steps a second\n", wall_s, options.duration_s / wall_s,
             r.vehicle_s / options.step_s / wall_s);
  for (const std::string& incident : r.incidents) fmt::print("incident         {}\n", incident);
}

}  // namespace

int TrafficRun(const TrafficOptions& options) {
  const auto roads = Roads(options.map);
  if (!roads) return Complain(roads.error());
  traffic::StudySettings settings;
  settings.traffic.vehicles = options.vehicles;
  settings.traffic.seed = options.seed;
  settings.duration_s = options.duration_s;
  settings.step_s = options.step_s;
  settings.watch_s = std::max(0.1, options.step_s);
  Trajectories trajectories;
  if (!options.csv.empty()) {
    if (auto status = trajectories.Open(options.csv); !status) return Complain(status.error());
  }
  const bool terminal = !options.quiet && ::isatty(STDERR_FILENO) == 1;
  const auto begin = Clock::now();
  bool shown = false;
  const auto result = traffic::RunStudy(settings, roads.value(), [&](const traffic::StudyMoment& moment) {
    trajectories.Write(moment);
    if (!terminal || SecondsSince(begin) < 2.0) return;
    fmt::print(stderr, "\r{:3.0f} %", 100.0 * moment.time_s / options.duration_s);
    shown = true;
  });
  if (shown) fmt::print(stderr, "\r     \r");
  if (!result) return Complain(result.error());
  if (auto status = trajectories.Close(); !status) return Complain(status.error());
  if (!options.quiet) Describe(options, result.value(), SecondsSince(begin));
  if (!options.csv.empty() && !options.quiet) fmt::print("wrote            {}\n", trajectories.path());
  return 0;
}

}  // namespace rodeira::front
