// SPDX-License-Identifier: Apache-2.0
// People on foot: no pedestrian is touched, one that waits is let go, and the arithmetic of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "common/traffic/network/road_network.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/duration.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/with_crossings.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

using NetworkPointer = std::shared_ptr<const network::Network>;

// Looks at all pedestrians at one moment.
class PeopleWatcher {
 public:
  void Observe(const TrafficModel& model, double time_s) {
    const Pedestrians& people = *model.people();
    for (const driver::Footprint& person : people.Footprints()) {
      for (const AgentPose& pose : model.poses()) {
        const driver::Footprint car = FootprintOf(pose, model.traits(pose.id));
        if (std::hypot(car.x_m - person.x_m, car.y_m - person.y_m) > 10.0 || !driver::Overlap(car, person)) continue;
        const Pedestrians::Person& pedestrian = people.people()[person.id - Pedestrians::kFirstId];
        if (touched++ == 0)
          first = fmt::format(
              "{:.1f} s: car {} ({:.2f} m/s) and {} (crossing {} '{}', u {:.2f} m, walks {}) at ({:.2f}, {:.2f})",
              time_s, pose.id, pose.speed_mps, person.id, pedestrian.crossing,
              people.crossings()[pedestrian.crossing].id, pedestrian.u_m, pedestrian.walks, person.x_m, person.y_m);
      }
    }
    std::size_t present = 0;
    std::uint64_t arrived = 0, left = 0;
    for (const Pedestrians::Person& person : people.people()) {
      present += person.present ? 1 : 0;
      longest_wait_s = std::max(longest_wait_s, person.waited_s);
    }
    for (const Pedestrians::Count& count : people.counts()) arrived += count.arrived, left += count.left;
    EXPECT_EQ(arrived, left + present) << time_s;
    crossed = left;
  }

  int touched = 0;
  std::string first;
  std::uint64_t crossed = 0;
  double longest_wait_s = 0.0;
};

void ExpectNoPedestrianTouched(const std::string& name, const NetworkPointer& network, std::uint32_t vehicles,
                               double per_h, Physics physics = Physics::kPlanar) {
  StudySettings settings;
  settings.traffic.vehicles = vehicles;
  settings.traffic.seed = 5;
  settings.traffic.physics = physics;
  settings.traffic.pedestrians = PedestrianSettings{};
  settings.traffic.pedestrians->per_h = per_h;
  settings.duration_s = Duration();
  PeopleWatcher watcher;
  const auto result =
      RunStudy(settings, network, [&](const StudyMoment& moment) { watcher.Observe(moment.model, moment.time_s); });
  ASSERT_TRUE(result.ok()) << name << ": " << result.error().Text();
  const StudyResult& r = result.value();
  std::string told;
  for (const std::string& incident : r.incidents) told += "\n  " + incident;
  EXPECT_EQ(watcher.touched, 0) << name << ": " << watcher.first;
  EXPECT_EQ(r.collisions, 0) << name << told;
  EXPECT_EQ(r.off_lane, 0) << name << told;
  EXPECT_LE(r.max_deceleration_mps2, 3.0) << name << told;
  EXPECT_LT(r.longest_with_room_s, 300.0) << name << " car " << r.longest_with_room_id;
  EXPECT_EQ(r.on_road + r.waiting, vehicles) << name;
  EXPECT_GT(watcher.crossed, 0u) << name;
  testing::Test::RecordProperty(
      name,
      fmt::format("crossed {}, longest wait {:.1f} s, hardest {:.2f} m/s2, driven {:.1f} km, stood {:.0f} of {:.0f} s",
                  watcher.crossed, watcher.longest_wait_s, r.max_deceleration_mps2, r.driven_km, r.standing_s,
                  r.vehicle_s));
}

TEST(Pedestrians, NoPedestrianIsTouchedOnTheMaps) {
  for (const std::string& name : lanes::MapNames())
    ExpectNoPedestrianTouched(name, WithCrossings(*lanes::MapNetwork(name)), name == "town" ? 60 : 25, 300.0);
}

TEST(Pedestrians, NoPedestrianIsTouchedInTheRealFiles) {
  if (lanes::RealFiles().empty()) GTEST_SKIP() << "the real files are not beside the project";
  for (const char* file : {"carla_Town04.xodr", "esmini_fabriksgatan.xodr", "esmini_multi_intersections.xodr"}) {
    ExpectNoPedestrianTouched(file, WithCrossings(*opendrive::LoadNetwork(lanes::RealFolder() / file).value()),
                              std::string(file) == "carla_Town04.xodr" ? 100 : 25, 120.0);
  }
}

TrafficSettings WithPeople(std::uint32_t vehicles, double per_h) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.pedestrians = PedestrianSettings{};
  settings.pedestrians->per_h = per_h;
  return settings;
}

TEST(Pedestrians, ThreadsAndSnapshotsChangeNoBit) {
  const NetworkPointer network = WithCrossings(*lanes::MapNetwork("town"));
  std::vector<TrafficModel> models;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    TrafficSettings settings = WithPeople(45, 400.0);
    settings.threads = threads;
    models.push_back(TrafficModel::Make(settings, network, {}).value());
  }
  for (int i = 0; i < 1200; ++i) {
    for (TrafficModel& model : models) model.Step(0.05, {});
    if (i % 100 != 0) continue;
    ASSERT_EQ(DigestOf(models[0]), DigestOf(models[1])) << i;
    ASSERT_EQ(DigestOf(models[0]), DigestOf(models[2])) << i;
  }
  base::StateWriter writer;
  models[0].Save(writer);
  base::StateReader reader(writer.bytes());
  models[1].Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  TrafficModel fresh = TrafficModel::Make(WithPeople(45, 400.0), network, {}).value();
  base::StateReader again(writer.bytes());
  fresh.Restore(again);
  for (int i = 0; i < 600; ++i) {
    models[0].Step(0.05, {});
    fresh.Step(0.05, {});
    ASSERT_EQ(DigestOf(models[0]), DigestOf(fresh)) << i;
  }
}

// Without `pedestrians` crossings are nothing: the same bits as on the same roads without any.
TEST(Pedestrians, CrossingsAloneChangeNoBit) {
  TrafficSettings settings;
  settings.vehicles = 40;
  TrafficModel with = TrafficModel::Make(settings, WithCrossings(*lanes::MapNetwork("town")), {}).value();
  TrafficModel without = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  for (int i = 0; i < 600; ++i) with.Step(0.05, {}), without.Step(0.05, {});
  EXPECT_EQ(DigestOf(with), DigestOf(without));
}

// A street of 400 m with a crossing 4 m wide in its middle; one lane each way, 3.5 m.
NetworkPointer Street(bool left_hand = false) {
  opendrive::RoadText road;
  road.length = 400.0;
  if (left_hand) road.attributes = "junction=\"-1\" rule=\"LHT\"";
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"400\"><line/></geometry>";
  road.more = R"(<objects><object id="z" type="crosswalk" s="200" t="0" zOffset="0" length="4" width="7"/></objects>)";
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

// The gaps between those that come are exponentially distributed (Kolmogorov and Smirnov at 1 %), and half come from
// each side.
TEST(Pedestrians, ComeByPoisson) {
  constexpr double kPerHour = 720.0;
  constexpr int kCount = 3000;
  TrafficModel model = TrafficModel::Make(WithPeople(0, kPerHour), Street(), {}).value();
  Pedestrians people = *model.people();
  std::vector<double> gaps_s;
  std::int64_t before_ns = 0;
  int from_begin = 0;
  std::vector<std::uint32_t> trips;
  while (gaps_s.size() < kCount) {
    const std::int64_t next_ns = people.counts()[0].next_ns;
    gaps_s.push_back(1e-9 * static_cast<double>(next_ns - before_ns));
    before_ns = next_ns;
    while (people.counts()[0].next_ns == next_ns) {
      people.LetGo(0);
      people.Step(5.0, next_ns + 1);
    }
    for (std::size_t p = 0; p < people.people().size(); ++p) {
      trips.resize(people.people().size(), 0);
      const Pedestrians::Person& person = people.people()[p];
      if (person.trip != trips[p]) trips[p] = person.trip, from_begin += person.side == 0 ? 1 : 0;
    }
  }
  std::sort(gaps_s.begin(), gaps_s.end());
  double apart = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double expected = 1.0 - std::exp(-gaps_s[static_cast<std::size_t>(i)] * kPerHour / 3600.0);
    apart = std::max({apart, std::fabs(expected - static_cast<double>(i) / kCount),
                      std::fabs(expected - static_cast<double>(i + 1) / kCount)});
  }
  EXPECT_LT(apart * std::sqrt(kCount), 1.63);
  const double all = people.counts()[0].arrived;
  EXPECT_NEAR(from_begin, 0.5 * all, 4.0 * std::sqrt(0.25 * all));
}

// Vehicles that do not yield come one every h seconds. Each keeps the kerb from where it cannot stop any more until its
// rear has passed: for T = (v²/(2 b) + v t + walkway + length)/v. One that comes at any time waits T²/(2 h) in the
// mean.
TEST(Pedestrians, WaitForEvenGapsAsLongAsTheFormulaSays) {
  constexpr double kSpeed = 12.0, kLength = 4.5, kEvery_s = 14.0, kStep_s = 0.05, kBrake = 2.0, kReacts_s = 1.0;
  const NetworkPointer network = Street();
  const TrafficModel empty = TrafficModel::Make(WithPeople(0, 0.0), network, {}).value();
  const lanes::FootCrossing& crossing = empty.people()->crossings()[0];
  const auto pass = std::find_if(crossing.passes.begin(), crossing.passes.end(),
                                 [&](const lanes::FootPass& p) { return empty.graph()[p.track].along; });
  const double T =
      (kSpeed * kSpeed / (2.0 * kBrake) + kSpeed * kReacts_s + pass->out_m - pass->in_m + kLength) / kSpeed;
  ASSERT_LT(T, kEvery_s);
  double sum = 0.0;
  constexpr int kPhases = 56;
  for (int phase = 0; phase < kPhases; ++phase) {
    TrafficModel model = TrafficModel::Make(WithPeople(0, 0.0), network, {}).value();
    const double at_s = 40.0 + kEvery_s * (phase + 0.5) / kPhases;
    bool called = false;
    for (int i = 0; i * kStep_s < at_s + 20.0; ++i) {
      const double now = i * kStep_s;
      if (!called && now >= at_s) {
        ASSERT_TRUE(model.SpawnPedestrian("1", 200.0, phase % 2 == 0).ok());
        called = true;
      }
      std::vector<driver::Footprint> others;
      for (int n = 0; n < 12; ++n) {
        const double x = kSpeed * (now - kEvery_s * n);
        if (x > 5.0 && x < 390.0)
          others.push_back({100000u + static_cast<std::uint32_t>(n), x, -1.75, 0.0, kSpeed, kLength, 1.8});
      }
      model.Step(kStep_s, others);
    }
    ASSERT_EQ(model.people()->counts()[0].let_go, 1u) << phase;
    sum += model.people()->counts()[0].waited_s;
  }
  EXPECT_NEAR(sum / kPhases, T * T / (2.0 * kEvery_s), 2.0 * kStep_s);
}

// One car and one person, pedestrian comes to the kerb when it is so far away: from where it can stop by three quarters
// of its comfortable braking, half a second later, it does, before the walkway; nearer, it drives on as if none was
// there, and the person goes when it has passed.
void YieldsWhereItCan(bool left_hand) {
  constexpr double kStep_s = 0.01;
  const NetworkPointer network = Street(left_hand);
  int yielded = 0, passed = 0;
  for (double far = 4.0; far < 90.0; far += 2.0) {
    TrafficSettings settings = Identical(1, 1.4);
    settings.pedestrians = PedestrianSettings{};
    settings.seed = 3;
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    for (int i = 0; i < 6000 && model.agent(0).trip == 0; ++i)
      model.Step(kStep_s, {});  // it leaves, and enters again at a lane's beginning
    const auto to_walkway = [&] {
      const Agent& agent = model.agent(0);
      for (const Pedestrians::OnTrack& on : model.people()->OfTrack(agent.path.front().track))
        return model.people()->crossings()[on.crossing].passes[on.pass].in_m + agent.path.front().zero_m - agent.o_m -
               0.5 * model.traits(0).length_m;
      return 1e9;
    };
    const double comes_m = model.people()->crossings()[0].before_m;
    bool called = false, judged = false, able = false, stood = false;
    double hardest = 0.0, closest = 1e9;
    for (int i = 0; i < 6000 && model.on_road() == 1 && to_walkway() < 1e8; ++i) {
      const double v = model.agent(0).speed_mps, way = to_walkway();
      // It walks to the kerb meanwhile.
      if (!called && way < far + comes_m / 1.35 * v) called = model.SpawnPedestrian("1", 200.0, false).ok();
      if (called && !judged && model.people()->Waits(0)) {
        judged = true;
        able = way - 1.0 >= v * v / (2.0 * 0.75 * settings.idm.braking_mps2) + 0.5 * v;
      }
      model.Step(kStep_s, {});
      if (model.on_road() == 0) break;
      hardest = std::max(hardest, -model.agent(0).acceleration_mps2);
      if (model.agent(0).speed_mps < 0.01) stood = true, closest = std::min(closest, to_walkway());
      for (const driver::Footprint& person : model.people()->Footprints())
        ASSERT_FALSE(driver::Overlap(FootprintOf(model.poses()[0], model.traits(0)), person)) << far;
    }
    ASSERT_TRUE(judged) << far;
    EXPECT_LE(hardest, settings.idm.braking_mps2 + 1e-9) << far;
    ++(able ? yielded : passed);
    EXPECT_TRUE(able || (!stood && hardest < 0.2)) << far << ": braked at " << hardest;
    EXPECT_TRUE(!stood || closest > 0.5) << far;
    EXPECT_EQ(model.people()->counts()[0].let_go, 1u) << far;
  }
  EXPECT_GT(yielded, 5);
  EXPECT_GT(passed, 5);
}

TEST(Pedestrians, CarsYieldWhereTheyCan) { YieldsWhereItCan(false); }
TEST(Pedestrians, CarsYieldInLeftHandTraffic) { YieldsWhereItCan(true); }

// More people than would ever leave a gap: each car is let go after some time, and each person after a while.
TEST(Pedestrians, NoPedestrianWaitsForEver) {
  StudySettings settings;
  settings.traffic = WithPeople(8, 3000.0);
  settings.duration_s = 900.0;
  PeopleWatcher watcher;
  const StudyResult r = RunStudy(settings, Street(), [&](const StudyMoment& moment) {
                          watcher.Observe(moment.model, moment.time_s);
                        }).value();
  EXPECT_EQ(watcher.touched, 0) << watcher.first;
  EXPECT_LT(r.longest_stand_s, 120.0);
  EXPECT_LT(watcher.longest_wait_s, 60.0);
  EXPECT_GT(r.arrivals, 20);
  EXPECT_GT(watcher.crossed, 500u);
}

// A crossing between two lights that face it: no pedestrian steps out while they do not show red, or would not as long
// as it walks; and cars do not stop for a pedestrian that waits at green.
TEST(Pedestrians, WalkWhileLightsAreRed) {
  opendrive::RoadText road;
  road.length = 400.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"400\"><line/></geometry>";
  const auto light = [](int id, int s, char way) {
    return fmt::format(
        "<signal s=\"{}\" t=\"-4\" id=\"{}\" dynamic=\"yes\" orientation=\"{}\" zOffset=\"2\" type=\"1000001\" "
        "subtype=\"-1\" country=\"OpenDRIVE\"/>",
        s, id, way);
  };
  road.more =
      R"(<objects><object id="z" type="crosswalk" s="200" t="0" zOffset="0" length="4" width="7"/></objects>
          <signals>)" +
      light(7, 190, '+') + light(8, 210, '-') + "</signals>";
  const NetworkPointer network = opendrive::MustRead(opendrive::Document(
      road.Text() +
      "<controller id=\"1\" name=\"only\"><control signalId=\"7\" type=\"0\"/><control signalId=\"8\" "
      "type=\"0\"/><userData code=\"rodeira:times\" value=\"60 5 25 3 1\"/></controller>"));
  TrafficModel model = TrafficModel::Make(WithPeople(10, 300.0), network, {}).value();
  const lanes::FootCrossing& crossing = model.people()->crossings()[0];
  ASSERT_FALSE(crossing.passes.empty());
  for (const lanes::FootPass& pass : crossing.passes) EXPECT_EQ(pass.light, 0);
  std::uint32_t before = 0, stood_at_green = 0;
  PeopleWatcher watcher;
  for (int i = 0; i < 12000; ++i) {
    const double in_cycle = std::fmod(0.05 * i, 60.0);  // red from 33 s to 4 s of the next one
    model.Step(0.05, {});
    watcher.Observe(model, 0.05 * i);
    const std::uint32_t now = model.people()->counts()[0].let_go;
    EXPECT_TRUE(now == before || in_cycle >= 33.0 - 1e-9 || in_cycle + crossing.length_m / 1.2 <= 4.0) << in_cycle;
    before = now;
    if (in_cycle < 20.0 || in_cycle > 29.0) continue;  // the queue of the red has gone
    for (const AgentPose& pose : model.poses())
      stood_at_green += pose.speed_mps < 0.1 && std::fabs(pose.p_WB_W.x() - 200.0) < 20.0 ? 1 : 0;
  }
  EXPECT_EQ(watcher.touched, 0) << watcher.first;
  EXPECT_GT(before, 30u);
  EXPECT_EQ(stood_at_green, 0u);
}

// A pedestrian that is hit stays, and so do oncoming cars: none drives over it.
TEST(Pedestrians, APedestrianThatIsHitStays) {
  TrafficModel model = TrafficModel::Make(WithPeople(6, 0.0), Street(), {}).value();
  ASSERT_TRUE(model.SpawnPedestrian("1", 200.0, true).ok());
  while (model.people()->counts()[0].let_go == 0) model.Step(0.05, {});
  for (int i = 0; i < 60; ++i) model.Step(0.05, {});
  model.HitPedestrian(Pedestrians::kFirstId);
  model.HitPedestrian(Pedestrians::kFirstId + 7);  // none
  const Eigen::Vector3d where = model.people()->Poses()[0].p_W;
  PeopleWatcher watcher;
  for (int i = 0; i < 1200; ++i) {
    model.Step(0.05, {});
    watcher.Observe(model, 0.05 * i);
  }
  EXPECT_EQ(watcher.touched, 0) << watcher.first;
  EXPECT_EQ(model.people()->Poses()[0].p_W, where);
  EXPECT_EQ(model.people()->Poses()[0].speed_mps, 0.0);
}

std::string Problem(const std::string& text) {
  auto file = config::File::Parse("rodeira: traffic/1\n" + text, "t.yaml");
  EXPECT_TRUE(file.ok());
  (void)file.value().root().Choice("rodeira", {"traffic/1"});
  const TrafficSettings settings = ReadTraffic(file.value().root(), 1);
  if (const auto status = file.value().Finish(); !status) return status.error().Text();
  const auto model = TrafficModel::Make(settings, Street(), {});
  return model ? "" : model.error().Text();
}

// The road runs to the east from x = 0 on, so that its stations are x; a junction at 100 m cuts it.
TEST(Pedestrians, ACrossingIsFoundByTheWholeRoadToo) {
  const auto world = road::World::Parse(
      "rodeira: world/2\nname: cross\nground: {kind: plane}\nroads:\n"
      "  - {id: main, axis: [line: {length_m: 300}], z_m: 0, section: {template: rural}, markings: [{type: crossing, "
      "s_m: 40, length_m: 3}, {type: crossing, s_m: 220, length_m: 3}]}\n"
      "  - {id: side, place: {road: main, s_m: 100, turn_deg: 90, own_s_m: 80}, axis: [line: {length_m: 160}], "
      "section: {template: rural}}\n"
      "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: side, s_m: 80}]}\n",
      "cross.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const network::Network& network = *world.value()->network();
  const auto model = TrafficModel::Make(WithPeople(1, 0.0), NetworkOf(world.value()), {});
  ASSERT_TRUE(model.ok()) << model.error().Text();
  const Pedestrians& people = *model.value().people();
  const auto near = people.Nearest(network, "main", 60.0), far = people.Nearest(network, "main", 200.0);
  ASSERT_TRUE(near && far);
  EXPECT_EQ(near, people.Nearest(network, "main/1", 40.0));
  EXPECT_EQ(far, people.Nearest(network, "main/2", 100.0));
  EXPECT_NE(near, far);
  EXPECT_FALSE(people.Nearest(network, "mian", 60.0).has_value());
}

TEST(Pedestrians, WrongSettingsAreNamed) {
  EXPECT_EQ(Problem("vehicles: 2\npedestrians: {per_hour: 100, at: [{road: '1', s_m: 190, per_hour: 20}]}\n"), "");
  EXPECT_NE(Problem("pedestrians: {per_hour: -1}\n").find("t.yaml:2"), std::string::npos);
  EXPECT_NE(Problem("pedestrians: {slowest_mps: 2, fastest_mps: 1}\n")
                .find("'fastest_mps' is 1, below 'slowest_mps', which is 2"),
            std::string::npos);
  EXPECT_NE(Problem("pedestrians: {per_hours: 10}\n").find("per_hour"), std::string::npos);
  EXPECT_NE(Problem("vehicles: 2\npedestrians:\n  at:\n    - {road: main, s_m: 1, per_hour: 5}\n")
                .find("there is no road 'main'"),
            std::string::npos);
  EXPECT_EQ(WithoutCrossing(*Street(), "1"), "the road '1' has no crossing for people on foot");
  const auto none = TrafficModel::Make(WithPeople(2, 100.0), lanes::MapNetwork("crossing"), {});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().Text().find("has no crossing for people on foot"), std::string::npos) << none.error().Text();
  TrafficModel without = TrafficModel::Make(Identical(1, 1.4), Street(), {}).value();
  EXPECT_FALSE(without.SpawnPedestrian("1", 200.0, false).ok());
}

}  // namespace
}  // namespace rodeira::traffic
