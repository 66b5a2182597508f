// SPDX-License-Identifier: Apache-2.0
#include "nodes/road/road_service.hpp"

#include <utility>
#include <vector>

#include "common/core/base/log.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::size_t kMaxPoints = 1'000'000;  // a larger batch is no node's question

class RoadService final : public launch::Service {
 public:
  explicit RoadService(std::shared_ptr<const road::World> world)
      : world_(std::move(world)), ground_(world_->MakeGround()) {}

  base::Digest world_hash() const override { return world_->content_hash(); }

  base::Bytes Announcement() const override {
    const launch::WorldSummary summary = Summary(*world_);
    msg::WorldInfo info;
    info.content_hash(summary.content_hash);
    info.name(summary.name);
    info.start_x_m(summary.start_x_m);
    info.start_y_m(summary.start_y_m);
    info.start_heading_rad(summary.start_heading_rad);
    info.roads(world_->network() == nullptr
                   ? 0u
                   : static_cast<std::uint32_t>(
                         world_->network()->roads().size()));  // what junctions cut, and ways through them, count each
    return idl::Encode(info);
  }

  base::Result<base::Bytes> Answer(std::span<const std::byte> bytes) override {
    auto request = idl::Decode<msg::GroundRequest>(bytes);
    if (!request) return request.error();
    const auto& asked = request.value().points();
    if (asked.size() > kMaxPoints)
      return base::WrongInput("world.too_many_points", "a request of more than a million points was found");
    queries_.resize(asked.size());
    points_.resize(asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) queries_[i] = {asked[i].x_m(), asked[i].y_m(), asked[i].z_hint_m()};
    ground_->Query(queries_, points_);
    msg::GroundReply reply;
    reply.requester(request.value().requester());
    reply.incarnation(request.value().incarnation());
    reply.request_number(request.value().request_number());
    reply.points().resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      auto& answer = reply.points()[i];
      answer.z_m(points_[i].z_m);
      answer.normal_x(points_[i].normal_W.x());
      answer.normal_y(points_[i].normal_W.y());
      answer.normal_z(points_[i].normal_W.z());
      answer.friction(points_[i].friction);
      answer.surface(static_cast<std::uint32_t>(points_[i].surface));
      answer.inside_world(points_[i].inside ? 1 : 0);
    }
    return idl::Encode(reply);
  }

 private:
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<ground::Ground> ground_;
  std::vector<ground::GroundQuery> queries_;
  std::vector<ground::GroundPoint> points_;
};

}  // namespace

launch::WorldSummary Summary(const road::World& world) {
  return {world.content_hash(), world.name(), world.start().x_m, world.start().y_m, world.start().heading_rad};
}

base::Result<std::unique_ptr<launch::Service>> MakeRoadService(launch::NodeContext& context) {
  if (context.launch().world().empty())
    return base::WrongInput("launch.no_world", "key 'world' is missing; a road server needs a world file",
                            context.launch().path().string());
  auto world = road::World::Load(context.launch().world());
  if (!world) return world.error();
  for (const std::string& warning : world.value()->warnings()) base::Log(base::LogLevel::kWarning, "", warning);
  return std::unique_ptr<launch::Service>(std::make_unique<RoadService>(std::move(world).value()));
}

}  // namespace rodeira::nodes
