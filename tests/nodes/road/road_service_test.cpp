// SPDX-License-Identifier: Apache-2.0
// The road server's answers by request and reply, through the bytes that go over DDS: patches, batches and all layers
// are to the bit what the world says in process.
#include "nodes/road/road_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/core/base/random.hpp"
#include "common/runtime/dds/remote_ground.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

class Context final : public launch::NodeContext {
 public:
  using launch::NodeContext::NodeContext;
  ground::Ground& Ground() override { std::abort(); }  // its server does not ask for it
  base::Result<launch::WorldSummary> World() override {
    return base::Failed("run.no_answer", "nobody asks the server for its own world", "");
  }
};

// A network of one server: what is written to it is answered on the spot, as bytes.
class Wire final : public dds::Participant {
 public:
  explicit Wire(launch::Service& service) : service_(service) {}
  base::Result<std::unique_ptr<dds::Writer>> MakeWriter(std::string_view topic, dds::Delivery) override {
    EXPECT_EQ(topic, idl::topics::kGroundRequest);
    return std::unique_ptr<dds::Writer>(std::make_unique<Requester>(*this));
  }
  base::Result<std::unique_ptr<dds::Reader>> MakeReader(std::string_view topic, dds::Delivery,
                                                        dds::OnPayload on_payload) override {
    EXPECT_EQ(topic, idl::topics::kGroundReply);
    on_payload_ = std::move(on_payload);
    return std::make_unique<dds::Reader>();
  }
  int asked = 0;

 private:
  struct Requester final : dds::Writer {
    explicit Requester(Wire& to) : wire(to) {}
    base::Status Write(const base::Bytes& payload) override {
      ++wire.asked;
      auto answer = wire.service_.Answer(payload);
      EXPECT_TRUE(answer.ok()) << answer.error().Text();
      wire.on_payload_(std::move(answer).value());
      return {};
    }
    Wire& wire;
  };
  launch::Service& service_;
  dds::OnPayload on_payload_;
};

msg::WorldInfo AnnouncedOf(const std::string& world) {
  auto launch = launch::Launch::Parse(
      "rodeira: launch/1\nworld: " + world + "\nnodes:\n  road: {kind: road}\n  other: {kind: empty}\n", "made.yaml",
      {});
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  Context context(launch.value(), 0);
  auto service = MakeRoadService(context);
  EXPECT_TRUE(service.ok()) << service.error().Text();
  return idl::Decode<msg::WorldInfo>(service.value()->Announcement()).value();
}

// What the server announces of a world, whichever kind of file it is: counted by hand.
TEST(RoadServerAnnounces, TheRoadsOfEveryKindOfWorld) {
  const cli::TemporaryFolder folder;
  const std::string straight =
      "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
      "length=\"60\"><line/></geometry></planView><lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center>"
      "<right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" "
      "d=\"0\"/></lane></right></laneSection></lanes></road>\n";
  const auto open_drive =
      folder.Write("two.xodr",
                   "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" "
                   "length=\"60\" junction=\"-1\">" +
                       straight + "<road id=\"2\" length=\"60\" junction=\"-1\">" + straight + "</OpenDRIVE>\n");
  EXPECT_EQ(AnnouncedOf(open_drive.string()).roads(), 2u);
  EXPECT_EQ(AnnouncedOf(SourceDir() + "/tests/data/n222_version1.yaml").roads(), 1u);
  const msg::WorldInfo ring = AnnouncedOf(SourceDir() + "/configs/worlds/ring.yaml");  // of version 2
  EXPECT_EQ(ring.roads(), 1u);
  EXPECT_EQ(ring.name(), "ring");
  EXPECT_EQ(AnnouncedOf(SourceDir() + "/configs/worlds/plane.yaml").roads(), 0u);
}

// A run's road server says what was repaired, once a kind; each other node that loads the world says nothing of it.
TEST(RoadServerAnnounces, WhatWasRepaired) {
  const cli::TemporaryFolder folder;
  const auto file = folder.Write(
      "gone.xodr",
      "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" length=\"60\" "
      "junction=\"-1\"><link><successor elementType=\"road\" elementId=\"8\" contactPoint=\"start\"/>"
      "<predecessor elementType=\"road\" elementId=\"9\" contactPoint=\"start\"/></link><planView><geometry "
      "s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"60\"><line/></geometry></planView><lanes><laneSection "
      "s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" "
      "a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road>\n</OpenDRIVE>\n");
  testing::internal::CaptureStderr();
  AnnouncedOf(file.string());
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_TRUE(said.starts_with("rodeira: warning: ")) << said;
  EXPECT_THAT(said, testing::HasSubstr("gone.xodr:4: road.linkage.id: road 1"));
  EXPECT_THAT(said, testing::HasSubstr("(2 of this kind); repaired: the road ends there\n"));
}

bool Same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool Same(const ground::GroundPoint& a, const ground::GroundPoint& b) {
  return a.inside == b.inside && Same(a.z_m, b.z_m) && Same(a.normal_W.x(), b.normal_W.x()) &&
         Same(a.normal_W.y(), b.normal_W.y()) && Same(a.normal_W.z(), b.normal_W.z()) && Same(a.friction, b.friction) &&
         a.surface == b.surface;
}

class RoadServer : public testing::Test {
 protected:
  void SetUp() override {
    const std::string world = SourceDir() + "/configs/worlds/example/world.yaml";
    auto launch = launch::Launch::Parse(
        "rodeira: launch/1\nworld: " + world + "\nnodes:\n  road: {kind: road}\n  other: {kind: empty}\n", "made.yaml",
        {});
    ASSERT_TRUE(launch.ok()) << launch.error().Text();
    launch_ = std::make_unique<launch::Launch>(std::move(launch).value());
    Context context(*launch_, 0);
    auto service = MakeRoadService(context);
    ASSERT_TRUE(service.ok()) << service.error().Text();
    service_ = std::move(service).value();
    wire_ = std::make_unique<Wire>(*service_);
    auto remote = dds::RemoteGround::Open(*wire_, 1, 1, [] { return false; });
    ASSERT_TRUE(remote.ok()) << remote.error().Text();
    remote_ = std::move(remote).value();
    world_ = road::World::Load(world).value();
    here_ = world_->MakeGround();
  }
  std::unique_ptr<launch::Launch> launch_;
  std::unique_ptr<launch::Service> service_;
  std::unique_ptr<Wire> wire_;
  std::unique_ptr<ground::Ground> remote_, here_;
  std::shared_ptr<const road::World> world_;
};

// Tyres' patches all along the example's main road, with what is laid on it, on its bridge and in its junction: each
// one question.
TEST_F(RoadServer, PatchesAreTheSameBits) {
  int patches = 0;
  for (const network::Road& road : world_->network()->roads()) {
    for (double s = 1.0; s < road.length_m(); s += 3.7, ++patches) {
      const Eigen::Vector3d p =
          road.Surface(s, base::RandomUniform({static_cast<std::uint64_t>(patches), 1}, -4.0, 4.0)).p_W;
      const double hint = patches % 2 == 0 ? p.z() : std::numeric_limits<double>::quiet_NaN();
      const ground::GroundPatch patch{
          p.x(), p.y(), base::RandomUniform({static_cast<std::uint64_t>(patches), 2}, -3.0, 3.0), 0.25, 0.2, 9,
          7,     hint};
      std::vector<ground::GroundPoint> there(patch.size()), here(patch.size());
      const int before = wire_->asked;
      remote_->Patch(patch, there);
      EXPECT_EQ(wire_->asked, before + 1);
      here_->Patch(patch, here);
      for (std::size_t i = 0; i < here.size(); ++i)
        ASSERT_TRUE(Same(there[i], here[i])) << road.id() << " " << s << " point " << i;
    }
  }
  EXPECT_GT(patches, 200);
}

// On and under the bridge, over and in the tunnel, and where there is nothing.
TEST_F(RoadServer, LayersAreTheSameBits) {
  std::size_t several = 0, none = 0;
  for (std::uint64_t i = 0; i < 3'000; ++i) {
    Eigen::Vector2d p(base::RandomUniform({i, 1}, -450.0, 650.0), base::RandomUniform({i, 2}, -450.0, 450.0));
    if (i % 2 == 0) {
      const network::Road& road = world_->network()->roads()[i / 2 % world_->network()->roads().size()];
      p = road.Surface(base::RandomUniform({i, 3}, 0.0, road.length_m()), base::RandomUniform({i, 4}, -3.0, 3.0))
              .p_W.head<2>();
    }
    const auto there = remote_->Layers(p.x(), p.y()), here = here_->Layers(p.x(), p.y());
    ASSERT_EQ(there.size(), here.size()) << p.transpose();
    for (std::size_t k = 0; k < here.size(); ++k)
      EXPECT_TRUE(Same(there[k], here[k])) << p.transpose() << " layer " << k;
    several += here.size() > 1;
    none += here.empty();
  }
  EXPECT_GT(several, 10u);
  EXPECT_GT(none, 10u);
}

}  // namespace
}  // namespace rodeira::nodes
