// SPDX-License-Identifier: Apache-2.0
// What belongs to a junction and to no road of it: objects beside its own line, and the paths of pedestrians
// across it. It is given to the road beside which it lies.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/core/geometry/angle.hpp"
#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

using Eigen::Vector2d;
using network::Corner;
using network::LaneType;
using network::Object;
using network::Road;

constexpr double kSampled_m = 0.1;       // along a path
constexpr double kBeyond_m = 1e-3;       // between the elements of a line
constexpr double kSameCrossing_m = 4.0;  // a crossing so near is this one, told twice
constexpr double kMaxOfARow = 10000.0;

// A place in the plane, and where something there points.
struct Pose {
  Vector2d p_W = Vector2d::Zero();
  double heading_rad = 0.0;

  Vector2d ToLocal(const Vector2d& q_W) const {
    const Vector2d away = q_W - p_W, ahead(std::cos(heading_rad), std::sin(heading_rad));
    return {away.dot(ahead), away.dot(Vector2d(-ahead.y(), ahead.x()))};
  }
};

Pose Beside(const geometry::PlanAxis& axis, double s_m, double t_m) {
  const geometry::PlanPoint at = axis.Evaluate(s_m);
  return {at.p_W + t_m * at.left_W(), at.heading_rad};
}

struct Host {
  std::size_t road = 0;
  double s_m = 0.0, t_m = 0.0;
};

// The road with the reference line nearest beside a point; nothing where the point lies beside none.
template <class Takes>
std::optional<Host> HostOf(const std::vector<Road>& roads, const Vector2d& p_W, const Takes& takes) {
  std::optional<Host> best;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (!takes(i)) continue;
    for (const geometry::AxisPanel& panel : roads[i].axis().panels()) {
      const geometry::AxisFoot foot = roads[i].axis().Foot(panel, p_W);
      const double s = panel.middle_s_m + foot.u_m;
      if (std::fabs(foot.beyond_m) > kBeyond_m || s < 0.0 || s > roads[i].length_m() ||
          (best && std::fabs(foot.t_m) >= std::fabs(best->t_m)))
        continue;
      best = Host{i, s, foot.t_m};
    }
  }
  return best;
}

// An object at a pose, by its host; what it says beside the junction's line becomes its own.
void Give(Object object, const Pose& pose, const Host& host, network::NetworkSpec& spec) {
  Road& road = spec.roads[host.road];
  object.s_m = host.s_m, object.t_m = host.t_m;
  object.hdg_rad = geometry::WrapAngle(pose.heading_rad - road.axis().Evaluate(host.s_m).heading_rad);
  object.repeats.clear();
  network::RoadSpec with = road.spec();
  with.objects.push_back(std::move(object));
  road = Road(std::move(with), road.axis());
}

class JunctionLayout {
 public:
  JunctionLayout(const JunctionReading& junction, const geometry::PlanAxis& axis, network::NetworkSpec& spec,
                 Findings& findings)
      : junction_(junction), axis_(axis), spec_(spec), findings_(findings) {}

  void Lay(const JunctionObject& said) const {
    const Object& object = said.object;
    if (object.repeats.empty()) return Place(said, object, object.s_m, object.t_m);
    for (const network::Repeat& repeat : object.repeats) {
      if (!(repeat.distance_m > 0.0)) {
        Warn(said, "goes on along the junction's line: it is left out");
        continue;
      }
      const double last = std::min(std::floor(repeat.length_m / repeat.distance_m + 1e-9), kMaxOfARow);
      for (double i = 0.0; i <= last; i += 1.0) {
        const double share = repeat.length_m > 0.0 ? i * repeat.distance_m / repeat.length_m : 0.0;
        const auto at = [share](double start, double end, double own) {
          return start != 0.0 || end != 0.0 ? start + share * (end - start) : own;
        };
        Object one = object;
        one.z_offset_m = repeat.z_start_m + share * (repeat.z_end_m - repeat.z_start_m);
        one.height_m = at(repeat.height_start_m, repeat.height_end_m, object.height_m),
        one.width_m = at(repeat.width_start_m, repeat.width_end_m, object.width_m);
        one.length_m = at(repeat.length_start_m, repeat.length_end_m, object.length_m),
        one.radius_m = at(repeat.radius_start_m, repeat.radius_end_m, object.radius_m);
        Place(said, std::move(one), repeat.s_m + i * repeat.distance_m,
              repeat.t_start_m + share * (repeat.t_end_m - repeat.t_start_m));
      }
    }
  }

 private:
  void Place(const JunctionObject& said, Object object, double s_m, double t_m) const {
    Pose pose = Beside(axis_, s_m, t_m);
    pose.heading_rad += object.hdg_rad;
    const auto host = HostOf(spec_.roads, pose.p_W, [](std::size_t) { return true; });
    if (!host) return Warn(said, "lies beside no road: it is left out");
    const auto to_local = [&](bool& local, double& first, double& second, double& dz) {
      if (local) return;
      const Vector2d p = pose.ToLocal(Beside(axis_, first, second).p_W);
      local = true, first = p.x(), second = p.y(), dz -= object.z_offset_m;
    };
    for (network::Outline& outline : object.outlines) {
      for (Corner& corner : outline.corners) to_local(corner.local, corner.first_m, corner.second_m, corner.dz_m);
    }
    for (network::SkeletonLine& line : object.skeleton) {
      for (network::SkeletonPoint& point : line) to_local(point.local, point.first_m, point.second_m, point.dz_m);
    }
    Give(std::move(object), pose, *host, spec_);
  }
  void Warn(const JunctionObject& said, std::string_view what) const {
    findings_.warnings.push_back(
        {"junctions.objects",
         fmt::format("the object '{}' of junction {} {}", said.object.id, junction_.junction.id, what),
         said.line,
         "",
         {},
         {}});
  }

  const JunctionReading& junction_;
  const geometry::PlanAxis& axis_;
  network::NetworkSpec& spec_;
  Findings& findings_;
};

bool IsWalked(LaneType type) { return type == LaneType::kSidewalk || type == LaneType::kWalking; }

// Whether a point lies on a lane of any road but one that is not for people on foot alone.
bool IsCarriageway(const std::vector<Road>& roads, std::size_t but, const Vector2d& p_W) {
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (i == but) continue;
    for (const geometry::AxisPanel& panel : roads[i].axis().panels()) {
      const geometry::AxisFoot foot = roads[i].axis().Foot(panel, p_W);
      const double s = panel.middle_s_m + foot.u_m;
      if (std::fabs(foot.beyond_m) > kBeyond_m || s < 0.0 || s > roads[i].length_m()) continue;
      double outside = 0.0;
      const network::LaneSpan span = roads[i].SectionAt(s).At(foot.t_m, roads[i].CentreAt(s), s, outside);
      if (span.lane == nullptr || outside > 0.0) continue;
      const LaneType type = span.lane->type;
      if (!IsWalked(type) && type != LaneType::kNone && type != LaneType::kCurb && type != LaneType::kMedian)
        return true;
    }
  }
  return false;
}

// Across which s of a path's road there is a carriageway; all of it where there is none.
std::pair<double, double> Across(const std::vector<Road>& roads, std::size_t path) {
  const Road& road = roads[path];
  const double steps = std::max(1.0, std::ceil(road.length_m() / kSampled_m));
  double from = road.length_m(), to = 0.0;
  for (double k = 0.0; k <= steps; k += 1.0) {
    const double s = road.length_m() * k / steps;
    if (IsCarriageway(roads, path, road.axis().Evaluate(s).p_W)) from = std::min(from, s), to = std::max(to, s);
  }
  return from < to ? std::pair(from, to) : std::pair(0.0, road.length_m());
}

bool IsToldAsObject(const std::vector<Road>& roads, const Vector2d& p_W) {
  for (const Road& road : roads) {
    for (const Object& object : road.spec().objects) {
      if (object.type == "crosswalk" &&
          (road.Surface(object.s_m, object.t_m).p_W.head<2>() - p_W).norm() < kSameCrossing_m)
        return true;
    }
  }
  return false;
}

// The path as a crossing: from edge to edge of the lanes that are walked on, across the carriageway.
void LayPath(const JunctionReading& junction, const CrossPath& said, std::size_t path, network::NetworkSpec& spec) {
  const Road road = spec.roads[path];
  const auto [from, to] = Across(spec.roads, path);
  const double middle = 0.5 * (from + to);
  const Pose pose{road.axis().Evaluate(middle).p_W, road.axis().Evaluate(middle).heading_rad};
  const auto host = HostOf(spec.roads, pose.p_W, [&](std::size_t i) { return i != path; });
  if (!host || IsToldAsObject(spec.roads, pose.p_W)) return;
  Object crossing;
  crossing.id = fmt::format("{}/{}", junction.junction.id, said.id);
  crossing.type = "crosswalk";
  crossing.orientation = "none";
  network::Outline outline;
  for (const bool left : {false, true}) {
    for (const double share : {0.0, 0.5, 1.0}) {
      const double s = left ? to + share * (from - to) : from + share * (to - from);
      const network::LaneSection& section = road.SectionAt(s);
      double low = 1e9, high = -1e9;
      for (const auto* side : {&section.left, &section.right}) {
        for (const network::Lane& lane : *side) {
          const auto span = section.Span(lane.id, road.CentreAt(s), s);
          if (IsWalked(lane.type) && span)
            low = std::min({low, span->inner_t_m, span->outer_t_m}),
            high = std::max({high, span->inner_t_m, span->outer_t_m});
        }
      }
      if (low > high) return;
      const Vector2d local = pose.ToLocal(Beside(road.axis(), s, left ? high : low).p_W);
      outline.corners.push_back({true, local.x(), local.y(), 0.0, 0.0, ""});
    }
  }
  crossing.outlines.push_back(std::move(outline));
  Give(std::move(crossing), pose, *host, spec);
}

bool HasFurniture(const network::RoadSpec& spec) {
  return !spec.objects.empty() || !spec.signals.empty() || !spec.signal_references.empty() ||
         !spec.object_references.empty() || !spec.structures.empty();
}

bool IsWalked(const network::RoadSpec& road) {
  return std::all_of(road.sections.begin(), road.sections.end(), [](const network::LaneSection& section) {
    const auto walked = [](const network::Lane& lane) { return IsWalked(lane.type); };
    const auto driven = [](const network::Lane& lane) { return network::IsDrivable(lane.type); };
    return (std::any_of(section.left.begin(), section.left.end(), walked) ||
            std::any_of(section.right.begin(), section.right.end(), walked)) &&
           std::none_of(section.left.begin(), section.left.end(), driven) &&
           std::none_of(section.right.begin(), section.right.end(), driven);
  });
}

}  // namespace

std::set<std::string, std::less<>> PathsOnFoot(std::span<const RoadReading> roads,
                                               std::span<const JunctionReading> junctions) {
  std::set<std::string, std::less<>> paths;
  for (const JunctionReading& junction : junctions) {
    for (const CrossPath& path : junction.cross_paths) {
      const auto road =
          std::find_if(roads.begin(), roads.end(), [&](const RoadReading& of) { return of.spec.id == path.road; });
      if (road != roads.end() && IsWalked(road->spec)) paths.insert(path.road);
    }
  }
  return paths;
}

void LayJunctionObjects(std::span<const JunctionReading> junctions, const std::set<std::string, std::less<>>& on_foot,
                        network::NetworkSpec& spec, std::vector<RoadLines>& lines, Findings& findings) {
  const auto find = [&](const std::string& id) {
    return static_cast<std::size_t>(
        std::find_if(spec.roads.begin(), spec.roads.end(), [&](const Road& road) { return road.id() == id; }) -
        spec.roads.begin());
  };
  for (const JunctionReading& junction : junctions) {
    for (const CrossPath& path : junction.cross_paths) {
      const auto wrong = [&](std::string_view rule, std::string message) {
        findings.warnings.push_back(
            {std::string(rule),
             fmt::format("the cross path '{}' of junction {} {}", path.id, junction.junction.id, message),
             path.line,
             "",
             {},
             {}});
      };
      if (find(path.road) == spec.roads.size())
        wrong("junctions.cross_path.road",
              fmt::format("is the road '{}', which is not in the file: no pedestrian walks there", path.road));
      else if (!on_foot.contains(path.road))
        wrong("junctions.cross_path.only_connect_correct_type",
              fmt::format("is the road '{}', which has no lane for pedestrians: none walks there", path.road));
      else
        LayPath(junction, path, find(path.road), spec);
    }
    if (junction.objects.empty()) continue;
    const auto axis = geometry::PlanAxis::Make(junction.elements);
    if (axis) {
      const JunctionLayout things(junction, *axis, spec, findings);
      for (const JunctionObject& object : junction.objects) things.Lay(object);
    } else {
      findings.warnings.push_back(
          {"junctions.objects",
           fmt::format("junction {} has objects, but no <planView> that they would lie beside: they are left out",
                       junction.junction.id),
           junction.objects.front().line,
           "",
           {},
           {}});
    }
  }
  // The path's own road would be ground of its own over the roads that it crosses, and its heights are to be passed
  // over.
  for (const std::string& id : on_foot) {
    const std::size_t road = find(id);
    if (HasFurniture(spec.roads[road].spec())) continue;
    spec.roads.erase(spec.roads.begin() + static_cast<std::ptrdiff_t>(road));
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(road));
  }
}

}  // namespace rodeira::opendrive
