// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/pedestrians/pedestrians.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/traffic/demand/arrivals.hpp"
#include "common/world/road/road_chains.hpp"

namespace rodeira::traffic {
namespace {

// Purposes of draws; never renumber.
enum PedestrianDraw : std::uint64_t {
  kDrawSide = 201,
  kDrawSpeed = 202,
  kDrawFile = 203,
  kDrawHeight = 204,
  kDrawColour = 205
};

constexpr std::uint64_t kFlows = 1'000'000;  // numbers of the crossings' flows lie beyond those of vehicles
constexpr double kFile_m = 0.7;              // between pedestrians side by side …
constexpr double kPedestrianGap_m = 0.7;     // … and one behind the other
constexpr double kAtKerb_m = 1e-9;
constexpr std::array<std::uint32_t, 6> kClothes{0x2F4B6E, 0x7A2E2E, 0x3E5B3A, 0xC8B48A, 0x55505A, 0xB4562C};

}  // namespace

std::string WithoutCrossing(const network::Network& network, std::string_view road) {
  if (road::FindRoadOrChain(network, road))
    return fmt::format("the road '{}' has no crossing for people on foot", road);
  return fmt::format("there is no road '{}'{}", road, base::DidYouMean(road, road::NamesOfRoads(network)));
}

base::Result<Pedestrians> Pedestrians::Make(const lanes::Graph& graph, const lanes::LargestCar& car,
                                            const PedestrianSettings& settings, std::uint64_t seed) {
  Pedestrians made(settings, seed);
  made.crossings_ = std::make_shared<const std::vector<lanes::FootCrossing>>(lanes::FindFootCrossings(graph, car));
  if (settings.per_h > 0.0 && made.crossings_->empty()) {
    return base::WrongInput("traffic.no_crossing",
                            "the network '" + graph.network().name() +
                                "' has no crossing for people on foot; one ('crossing' of a road's markings, "
                                "OpenDRIVE's 'crosswalk' or signal 293), or no 'pedestrians', was expected",
                            settings.place);
  }
  auto of_track = std::make_shared<std::vector<std::vector<OnTrack>>>(graph.tracks().size());
  for (std::uint32_t c = 0; c < made.crossings().size(); ++c) {
    for (std::uint32_t p = 0; p < made.crossings()[c].passes.size(); ++p)
      (*of_track)[made.crossings()[c].passes[p].track].push_back({c, p});
  }
  made.of_track_ = std::move(of_track);
  made.per_h_.assign(made.crossings().size(), settings.per_h);
  for (const CrossingFlow& flow : settings.at) {
    const auto crossing = made.Nearest(graph.network(), flow.road, flow.s_m);
    if (!crossing)
      return base::WrongInput("traffic.no_crossing", WithoutCrossing(graph.network(), flow.road), flow.place);
    made.per_h_[*crossing] = flow.per_h;
  }
  made.counts_.resize(made.crossings().size());
  for (std::uint32_t c = 0; c < made.counts_.size(); ++c) made.counts_[c].next_ns = made.NextAt(c);
  made.OrderAll();
  return made;
}

// When the next one of the flow comes.
std::int64_t Pedestrians::NextAt(std::uint32_t crossing) const {
  FlowSettings flow;
  flow.per_h = {per_h_[crossing]};
  const Count& count = counts_[crossing];
  return NextArrival_ns(flow, seed_, kFlows + crossing, count.flowed, count.flowed == 0 ? 0 : count.next_ns);
}

std::optional<std::uint32_t> Pedestrians::Nearest(const network::Network& network, std::string_view road,
                                                  double s_m) const {
  const auto named = road::FindRoadOrChain(network, road);
  std::optional<std::uint32_t> nearest;
  double least_m = 0.0;
  for (std::uint32_t c = 0; named && c < crossings().size(); ++c) {
    for (const road::RoadChain::Part& part : named->parts) {
      if (crossings()[c].road != part.road) continue;
      const double away_m = std::fabs(part.from_s_m + crossings()[c].s_m - s_m);
      if (nearest && !(away_m < least_m)) continue;
      nearest = c;
      least_m = away_m;
    }
  }
  return nearest;
}

double Pedestrians::Draw(const Person& person, std::uint64_t what) const {
  return base::RandomUniform({seed_, kFlows + person.crossing, what, person.number});
}

double Pedestrians::WalkingSpeed(const Person& person) const {
  return settings_.slowest_mps + (settings_.fastest_mps - settings_.slowest_mps) * Draw(person, kDrawSpeed);
}

// So many can walk beside one another each way.
int Pedestrians::FilesOf(std::uint32_t crossing) const {
  return std::max(1, static_cast<int>(crossings()[crossing].half_width_m / kFile_m));
}

int Pedestrians::FileOf(const Person& person) const {
  return static_cast<int>(Draw(person, kDrawFile) * static_cast<double>(FilesOf(person.crossing)));
}

double Pedestrians::BeforeOf(const Person& person) const {
  const lanes::FootCrossing& crossing = crossings()[person.crossing];
  return person.side == 0 ? crossing.before_m : crossing.after_m;
}

double Pedestrians::AfterOf(const Person& person) const {
  const lanes::FootCrossing& crossing = crossings()[person.crossing];
  return person.side == 0 ? crossing.after_m : crossing.before_m;
}

bool Pedestrians::Waits(std::uint32_t crossing) const {
  return std::any_of(order_[crossing].begin(), order_[crossing].end(), [&](std::uint32_t p) {
    return !people_[p].walks && !people_[p].is_hit && people_[p].u_m >= -kAtKerb_m;
  });
}

bool Pedestrians::IsUsed(std::uint32_t crossing, std::uint32_t pass) const {
  const lanes::FootCrossing& at = crossings()[crossing];
  const lanes::FootPass& of = at.passes[pass];
  return std::any_of(order_[crossing].begin(), order_[crossing].end(), [&](std::uint32_t p) {
    const Person& person = people_[p];
    const double end = person.side == 0 ? of.to_m : at.length_m - of.from_m;
    const double begin = person.side == 0 ? of.from_m : at.length_m - of.to_m;
    return person.walks && person.u_m <= end && !(person.is_hit && person.u_m < begin);
  });
}

void Pedestrians::LetGo(std::uint32_t crossing) {
  for (const std::uint32_t p : order_[crossing]) {
    Person& person = people_[p];
    if (person.walks || person.is_hit || person.u_m < -kAtKerb_m) continue;
    person.walks = true;
    ++counts_[crossing].let_go;
    counts_[crossing].waited_s += person.waited_s;
  }
}

void Pedestrians::Come(std::uint32_t crossing, std::uint32_t side) {
  auto free = std::find_if(people_.begin(), people_.end(), [](const Person& person) { return !person.present; });
  if (free == people_.end()) free = people_.insert(people_.end(), Person());
  const std::uint32_t trip = free->trip + 1;
  *free = Person();
  free->present = true;
  free->crossing = crossing;
  free->side = side;
  free->number = counts_[crossing].arrived++;
  free->trip = trip;
  free->u_m = -BeforeOf(*free);
  for (const std::uint32_t p : order_[crossing]) {  // there is no room for two
    if (people_[p].side == side && FileOf(people_[p]) == FileOf(*free))
      free->u_m = std::min(free->u_m, people_[p].u_m - kPedestrianGap_m);
  }
  order_[crossing].push_back(static_cast<std::uint32_t>(free - people_.begin()));
}

void Pedestrians::Step(double dt_s, std::int64_t until_ns) {
  std::vector<double> last;  // by side and file: how far the one before has come
  for (std::uint32_t c = 0; c < order_.size(); ++c) {
    const auto files = static_cast<std::size_t>(FilesOf(c));
    last.assign(2 * files, 1e9);
    for (const std::uint32_t p : order_[c]) {
      Person& person = people_[p];
      double& before = last[person.side * files + static_cast<std::size_t>(FileOf(person))];
      if (person.is_hit) continue;
      if (!person.walks && person.u_m >= -kAtKerb_m) person.waited_s += dt_s;
      const double stop = std::min(person.walks ? 1e9 : 0.0, before - kPedestrianGap_m);
      const double u = std::max(person.u_m, std::min(person.u_m + WalkingSpeed(person) * dt_s, stop));
      person.speed_mps = (u - person.u_m) / dt_s;
      person.gone_m += u - person.u_m;
      before = person.u_m = u;
      if (u >= crossings()[c].length_m + AfterOf(person)) person.present = false, ++counts_[c].left;
    }
    std::erase_if(order_[c], [&](std::uint32_t p) { return !people_[p].present; });
    Count& count = counts_[c];
    while (count.next_ns >= 0 && count.next_ns < until_ns) {
      Person drawn;
      drawn.crossing = c, drawn.number = count.arrived;
      Come(c, Draw(drawn, kDrawSide) < 0.5 ? 0 : 1);
      ++count.flowed;
      count.next_ns = NextAt(c);
    }
  }
}

void Pedestrians::Hit(std::uint32_t id) {
  if (id < kFirstId || id - kFirstId >= people_.size() || !people_[id - kFirstId].present) return;
  people_[id - kFirstId].is_hit = true;
  people_[id - kFirstId].walks = true;
  people_[id - kFirstId].speed_mps = 0.0;
}

// Keeping to the right of the walkway's middle.
Eigen::Vector3d Pedestrians::PlaceOf(const Person& person) const {
  const lanes::FootCrossing& at = crossings()[person.crossing];
  const double u = person.side == 0 ? person.u_m : at.length_m - person.u_m;
  const double aside = std::min(at.half_width_m, (0.5 + static_cast<double>(FileOf(person))) * kFile_m) *
                       (person.side == 0 ? -1.0 : 1.0);
  const Eigen::Vector2d p = at.begin_W + u * at.across_W + aside * at.left_W();
  return {p.x(), p.y(), at.HeightAt(u)};
}

std::vector<PersonPose> Pedestrians::Poses() const {
  std::vector<PersonPose> poses;
  for (std::uint32_t p = 0; p < people_.size(); ++p) {
    const Person& person = people_[p];
    if (!IsSeen(person)) continue;
    PersonPose pose;
    pose.id = kFirstId + p;
    pose.trip = person.trip;
    pose.p_W = PlaceOf(person);
    const Eigen::Vector2d ahead = (person.side == 0 ? 1.0 : -1.0) * crossings()[person.crossing].across_W;
    pose.heading_rad = std::atan2(ahead.y(), ahead.x());
    pose.speed_mps = person.speed_mps;
    pose.stride_rad = geometry::WrapAngle(person.gone_m / kStrideRadius_m);
    pose.height_m = 1.6 + 0.25 * Draw(person, kDrawHeight);
    pose.colour_rgb =
        kClothes[static_cast<std::size_t>(Draw(person, kDrawColour) * static_cast<double>(kClothes.size()))];
    poses.push_back(pose);
  }
  return poses;
}

std::vector<driver::Footprint> Pedestrians::Footprints() const {
  std::vector<driver::Footprint> footprints;
  for (const PersonPose& pose : Poses())
    footprints.push_back({pose.id, pose.p_W.x(), pose.p_W.y(), pose.heading_rad, pose.speed_mps, kLength_m, kWidth_m});
  return footprints;
}

void Pedestrians::OrderAll() {
  order_.assign(crossings().size(), {});
  for (std::uint32_t p = 0; p < people_.size(); ++p) {
    if (people_[p].present) order_[people_[p].crossing].push_back(p);
  }
  for (auto& order : order_)
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return people_[a].number < people_[b].number; });
}

}  // namespace rodeira::traffic
