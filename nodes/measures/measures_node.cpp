// SPDX-License-Identifier: Apache-2.0
#include "nodes/measures/measures_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/analysis/measures/live_kinematics.hpp"
#include "common/analysis/measures/series.hpp"
#include "common/core/base/suggest.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;
using lockstep::SourceIndex;

// Bits of Measures::valid.
constexpr std::uint32_t kRoad = 1, kLanePosition = 2, kSpeedLimit = 4, kLeader = 8, kTtc = 16, kTlc = 32;

// Every missing number has the same bits.
double Canonical(double value) { return std::isnan(value) ? measures::kMissing : value; }

std::size_t ColumnOf(std::string_view name) { return measures::FindSeries(name).value(); }

class MeasuresNode final : public lockstep::Node {
 public:
  // `numbers`: of the sources of vehicles, by source; a driven vehicle's id is minus its number.
  MeasuresNode(std::shared_ptr<const road::World> world, SourceIndex vehicle,
               std::vector<std::pair<SourceIndex, std::int64_t>> numbers)
      : world_(std::move(world)), kinematics_(world_->network()), vehicle_(vehicle), numbers_(std::move(numbers)) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    measures::Drive none;
    measures::GrowColumns(none, 1);
    outbox.Put(topics::kMeasures, idl::Encode(MessageOf(none, -1)));
    return {};
  }

  base::Status Step(const lockstep::StepInfo&, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    measures::SubjectSample subject;
    lockstep::Step state_step = -1;
    others_.clear();
    for (const lockstep::Sample& sample : inbox.All(topics::kVehicleState)) {
      const auto state = idl::Decode<msg::VehicleState>(*sample.payload);
      if (!state) return state.error();
      const measures::SubjectSample seen = SubjectOf(state.value());
      const auto length_m = static_cast<double>(state.value().length_m());
      const auto front_m = static_cast<double>(state.value().front_m());
      if (sample.source() == vehicle_) {
        subject = seen;
        state_step = sample.valid();
        kinematics_.SetFootprint(length_m, front_m, static_cast<double>(state.value().width_m()));
      } else {
        const auto number = std::ranges::find(numbers_, sample.source(), &std::pair<SourceIndex, std::int64_t>::first);
        others_.push_back({-number->second, seen.x_m, seen.y_m, seen.z_m, seen.speed_mps, length_m, front_m});
      }
    }
    for (const lockstep::Sample& sample : inbox.All(topics::kTrafficState)) {
      const auto traffic = idl::Decode<msg::TrafficState>(*sample.payload);
      if (!traffic) return traffic.error();
      for (const msg::TrafficAgent& agent : traffic.value().agents()) AddAgent(agent);
    }
    outbox.Put(topics::kMeasures, idl::Encode(MessageOf(kinematics_.At(subject, others_), state_step)));
    return {};
  }

  bool runs_inline() const override { return true; }
  void Save(base::StateWriter&) const override {}  // a sample depends on the newest inputs alone
  void Restore(base::StateReader&) override {}

 private:
  static measures::SubjectSample SubjectOf(const msg::VehicleState& state) {
    const auto& p = state.position_w_m();
    const auto& q = state.attitude_wb();
    const auto& v = state.velocity_w_mps();
    const auto along = measures::AlongBodyOf(q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z());
    measures::SubjectSample subject{p.x(), p.y(), p.z(), along.heading_rad, along.speed_mps};
    subject.yaw_radps = state.angular_velocity_b_radps().z();
    return subject;
  }

  void AddAgent(const msg::TrafficAgent& agent) {
    constexpr std::uint32_t kPedestrian = 4;
    if (agent.kind() == kPedestrian) return;
    const auto length_m = static_cast<double>(agent.length_m());
    others_.push_back({static_cast<std::int64_t>(agent.id()), agent.position_x_m(), agent.position_y_m(),
                       agent.position_z_m(), agent.speed_mps(), length_m, 0.5 * length_m});
  }

  msg::Measures MessageOf(const measures::Drive& drive, lockstep::Step state_step) const {
    static const std::size_t kTimeGapColumn = ColumnOf("time_gap_s"), kTtcColumn = ColumnOf("ttc_s"),
                             kTlcColumn = ColumnOf("tlc_s");
    msg::Measures out;
    out.state_step(state_step);
    out.s_m(Canonical(drive.s_m[0]));
    out.t_m(Canonical(drive.t_m[0]));
    out.lane_position_m(Canonical(drive.lane_position_m[0]));
    out.lane_width_m(Canonical(drive.lane_width_m[0]));
    out.heading_error_rad(Canonical(drive.heading_error_rad[0]));
    out.left_line_m(Canonical(drive.left_line_m[0]));
    out.right_line_m(Canonical(drive.right_line_m[0]));
    out.speed_mps(Canonical(drive.speed_mps[0]));
    out.speed_limit_mps(Canonical(drive.speed_limit_mps[0]));
    out.leader_gap_m(Canonical(drive.leader.gap_m[0]));
    out.leader_speed_mps(Canonical(drive.leader.speed_mps[0]));
    out.time_gap_s(Canonical(measures::SeriesValue(drive, kTimeGapColumn, 0)));
    out.ttc_s(Canonical(measures::SeriesValue(drive, kTtcColumn, 0)));
    out.tlc_s(Canonical(measures::SeriesValue(drive, kTlcColumn, 0)));
    const bool on_road = !std::isnan(drive.road[0]), has_leader = !std::isnan(drive.leader.id[0]);
    out.leader_id(has_leader ? static_cast<std::int64_t>(drive.leader.id[0]) : 0);
    out.road(on_road ? static_cast<std::int32_t>(drive.road[0]) : -1);
    out.lane(on_road ? static_cast<std::int32_t>(drive.lane[0]) : 0);
    out.junction(drive.junction[0] == 1.0 ? 1 : 0);
    const auto bit = [](bool is_there, std::uint32_t value) { return is_there ? value : 0; };
    out.valid(bit(on_road, kRoad) | bit(!std::isnan(out.lane_position_m()), kLanePosition) |
              bit(!std::isnan(out.speed_limit_mps()), kSpeedLimit) | bit(has_leader, kLeader) |
              bit(!std::isnan(out.ttc_s()), kTtc) | bit(!std::isnan(out.tlc_s()), kTlc));
    out.vehicle(vehicle_);
    return out;
  }

  std::shared_ptr<const road::World> world_;
  measures::LiveKinematics kinematics_;
  SourceIndex vehicle_;
  std::vector<std::pair<SourceIndex, std::int64_t>> numbers_;
  std::vector<measures::OtherVehicle> others_;
};

base::Result<SourceIndex> FindVehicle(const launch::NodeContext& context, const std::string& name) {
  std::vector<std::string> names;
  for (const lockstep::Port& port : context.spec().inputs) {
    if (port.topic != topics::kVehicleState) continue;
    for (const SourceIndex source : port.sources) {
      names.push_back(context.roster().node(context.roster().source(source).node).name);
      if (name.empty() || names.back() == name) return source;
    }
  }
  return base::WrongInput("launch.not_wired",
                          fmt::format("no vehicle '{}' is wired to this node{}", name, base::DidYouMean(name, names)),
                          context.launch().path().string());
}

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeMeasuresNode(launch::NodeContext& context) {
  const std::string name = context.config().Text("vehicle", "");
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  const auto vehicle = FindVehicle(context, name);
  if (!vehicle) return vehicle.error();
  if (context.launch().world().empty())
    return base::WrongInput("launch.no_world", "key 'world' is missing; a node of kind 'measures' needs it",
                            context.launch().path().string());
  auto world = road::World::Load(context.launch().world());
  if (!world) return world.error();
  context.set_world_hash(world.value()->content_hash());
  std::vector<std::pair<SourceIndex, std::int64_t>> numbers;
  for (const lockstep::RosterNode& node : context.roster().nodes()) {
    for (const SourceIndex source : node.outputs) {
      if (context.roster().source(source).topic == topics::kVehicleState)
        numbers.emplace_back(source, static_cast<std::int64_t>(numbers.size()) + 1);
    }
  }
  return std::unique_ptr<lockstep::Node>(
      std::make_unique<MeasuresNode>(std::move(world).value(), vehicle.value(), std::move(numbers)));
}

}  // namespace rodeira::nodes
