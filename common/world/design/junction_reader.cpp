// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredMap;
using config::Map;

constexpr double kMeets_m = 0.5;
constexpr double kFlattest_rad = 0.6;  // between the directions of two roads
constexpr double kSteepFit = 0.12, kSteepestFit = 0.5;

// Nothing where the road is not there. Without roads, because something is wrong with one of them, the rest is looked
// at all the same.
std::optional<Meeting> ReadMeeting(const DeclaredMap& keys, const std::vector<RoadDesign>& designs,
                                   const std::vector<network::Road>& roads) {
  const Map& item = keys.map();
  Meeting meeting;
  const std::string id = keys.Text("road");
  std::vector<std::string> ids;
  bool found = false;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    ids.push_back(designs[i].spec.id);
    if (designs[i].spec.id == id) meeting.road = i, found = true;
  }
  if (!found)
    item.Problem("road", "world.unknown_road", fmt::format("there is no road '{}'{}", id, base::DidYouMean(id, ids)));
  const double length = found && !roads.empty() ? roads[meeting.road].length_m() : 1e7;
  if (item.Has("end") == item.Has("s_m")) {
    item.Problem(item.Has("end") ? "end" : "", "config.conflicting_keys",
                 "a road either passes a junction ('s_m') or has an 'end' there (start or end)");
  }
  if (item.Has("end")) {
    meeting.before = keys.Word("end", "start") == "end";
    meeting.after = !meeting.before;
    meeting.s_m = meeting.before ? length : 0.0;
  } else if (item.Has("s_m")) {
    meeting.s_m = Station(keys, "s_m", length);
  }
  return found ? std::optional(meeting) : std::nullopt;
}

// The phases of a junction's lights: every road that meets it is green in one of them.
void ReadLights(const DeclaredMap& item, const std::vector<RoadDesign>& designs, JunctionSpec& junction) {
  const Map map = item.MapWith("lights").Child("lights");
  junction.lights = lights::ReadLightPlan(map);
  if (junction.lights->phases.empty()) return;
  const std::vector<std::string> names = junction.lights->Names();
  std::vector<std::string> roads;
  for (const Meeting& meeting : junction.meetings) roads.push_back(designs[meeting.road].spec.id);
  bool all_known = true;  // or the one that is green in no phase may be the misspelt one
  for (const std::string& name : names) {
    if (std::find(roads.begin(), roads.end(), name) != roads.end()) continue;
    map.Problem("phases", "config.unknown_name",
                fmt::format("no road '{}' meets junction '{}'{}", name, junction.id, base::DidYouMean(name, roads)));
    all_known = false;
  }
  if (!all_known) return;
  for (const std::string& road : roads) {
    if (std::find(names.begin(), names.end(), road) == names.end())
      map.Problem("phases", fmt::format("road '{}' is green in no phase of junction '{}'", road, junction.id));
  }
}

// How much lower than its axis a road's outermost edges lie, in the mean. Other roads come to the height of these.
double EdgeDrop(const network::Road& road, double s_m) {
  const network::LaneSection& section = road.SectionAt(s_m);
  const geometry::CubicPoint centre = road.CentreAt(s_m);
  double edges = 0.0;
  for (const double far : {-1e4, 1e4}) {
    double outside;
    (void)section.At(far, centre, s_m, outside);
    edges += 0.5 * road.Surface(s_m, far > 0.0 ? far - outside : far + outside, section, {}).p_W.z();
  }
  return road.spec().elevation.Value(s_m) - edges;
}

void CheckMeets(const JunctionSpec& junction, const std::vector<network::Road>& roads) {
  const Meeting& first = junction.meetings[0];
  const geometry::PlanPoint at = roads[first.road].axis().Evaluate(first.s_m);
  const config::List items = junction.map.Items("roads");
  for (std::size_t i = 1; i < junction.meetings.size(); ++i) {
    const Meeting& other = junction.meetings[i];
    const geometry::PlanPoint there = roads[other.road].axis().Evaluate(other.s_m);
    const double apart = (there.p_W - at.p_W).norm();
    if (apart > kMeets_m) {
      items.Problem(
          i, "config.out_of_range",
          fmt::format(
              "road '{}' is {:.2f} m away from road '{}' there, at ({:.2f}, {:.2f}) and ({:.2f}, {:.2f}); at most {} m "
              "was expected",
              roads[other.road].id(), apart, roads[first.road].id(), there.p_W.x(), there.p_W.y(), at.p_W.x(),
              at.p_W.y(), kMeets_m));
    }
    const double sine = std::fabs(geometry::Cross(at.tangent_W, there.tangent_W));
    if (sine < std::sin(kFlattest_rad)) {
      items.Problem(i, "config.out_of_range",
                    fmt::format("road '{}' meets road '{}' at an angle of {:.1f} degrees; at least {:.1f} was expected "
                                "(slip roads, forks and merges are what OpenDRIVE files and traffic maps have)",
                                roads[other.road].id(), roads[first.road].id(), std::asin(sine) * 57.29577951308232,
                                kFlattest_rad * 57.29577951308232));
    }
  }
}

}  // namespace

std::vector<JunctionSpec> ReadJunctions(const DeclaredMap& file, const std::vector<RoadDesign>& designs,
                                        const std::vector<network::Road>& roads) {
  std::vector<JunctionSpec> junctions;
  const config::DeclaredList list = file.Items("junctions");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const DeclaredMap keys = list.At(i);
    const Map& item = keys.map();
    JunctionSpec junction{{}, {}, {}, Control::kGiveWay, 8.0, 60.0, item, {}};
    junction.id = keys.Text("id");
    junction.name = keys.Text("name", junction.id);
    for (const JunctionSpec& other : junctions) {
      if (other.id == junction.id)
        item.Problem("id", "config.duplicate_name", fmt::format("there is a junction '{}' already", junction.id));
    }
    if (junction.id.find('/') != std::string::npos)
      item.Problem("id", "a junction's id holds no '/': the ways through it are named with it");
    const config::DeclaredList meetings = keys.Items("roads");
    for (std::size_t k = 0; k < meetings.size(); ++k) {
      if (const auto meeting = ReadMeeting(meetings.At(k), designs, roads)) junction.meetings.push_back(*meeting);
    }
    const bool all_found = junction.meetings.size() == meetings.size();
    const std::string control = keys.Word("control");
    junction.control = control == "stop"     ? Control::kStop
                       : control == "none"   ? Control::kNone
                       : control == "lights" ? Control::kLights
                                             : Control::kGiveWay;
    if (junction.control == Control::kLights && all_found)
      ReadLights(keys, designs, junction);
    else if (junction.control == Control::kLights)
      item.IgnoreKey("lights");
    junction.radius_m = keys.Number("radius_m");
    junction.fit_m = keys.Number("fit_m");
    if (meetings.size() < 2)
      item.Problem("roads", "config.too_few", "a junction has two roads or more");
    else if (all_found && !roads.empty())
      CheckMeets(junction, roads);
    junctions.push_back(std::move(junction));
  }
  return junctions;
}

void FitHeights(const std::vector<JunctionSpec>& junctions, std::vector<RoadDesign>& designs,
                const std::vector<network::Road>& roads, std::vector<std::string>& warnings) {
  for (const JunctionSpec& junction : junctions) {
    const Meeting& first = junction.meetings[0];
    geometry::CubicPoint z = designs[first.road].spec.elevation.Evaluate(first.s_m);
    z.value -= EdgeDrop(roads[first.road], first.s_m);
    const Eigen::Vector2d along = roads[first.road].axis().Evaluate(first.s_m).tangent_W;
    for (std::size_t i = 1; i < junction.meetings.size(); ++i) {
      const Meeting& minor = junction.meetings[i];
      network::RoadSpec& spec = designs[minor.road].spec;
      const double slope = z.slope * along.dot(roads[minor.road].axis().Evaluate(minor.s_m).tangent_W);
      for (const bool before : {true, false}) {
        if (!(before ? minor.before : minor.after)) continue;
        // As far as it is asked for, but not beyond the middle to the road's next junction, nor beyond the road.
        double fit = std::min(junction.fit_m, before ? minor.s_m : spec.length_m - minor.s_m);
        for (const JunctionSpec& other : junctions) {
          for (const Meeting& meeting : other.meetings) {
            const double apart = before ? minor.s_m - meeting.s_m : meeting.s_m - minor.s_m;
            if (meeting.road == minor.road && apart > 0.0) fit = std::min(fit, 0.5 * apart);
          }
        }
        if (!(fit > 1e-6)) continue;
        const double far = before ? minor.s_m - fit : minor.s_m + fit;
        const geometry::CubicPoint there = spec.elevation.Evaluate(far);
        const Hermite piece = before ? Hermite{far, minor.s_m, there.value, there.slope, z.value, slope}
                                     : Hermite{minor.s_m, far, z.value, slope, there.value, there.slope};
        spec.elevation = WithHermite(spec.elevation, piece);
        const double steepest =
            1.5 * std::fabs(z.value - there.value) / fit + 0.25 * (std::fabs(slope) + std::fabs(there.slope));
        if (!(steepest > kSteepFit)) continue;
        const std::string told = fmt::format(
            "road '{}' changes its height by {:.2f} m within {:.1f} m to meet road '{}': up to {:.0f} % steep", spec.id,
            z.value - there.value, fit, roads[first.road].id(), 100.0 * steepest);
        if (steepest > kSteepestFit)
          junction.map.Problem("roads", "config.out_of_range",
                               fmt::format("{}; at most {:.0f} % was expected", told, 100.0 * kSteepestFit));
        else
          warnings.push_back(fmt::format("{}: {}", junction.map.Place("roads"), told));
      }
    }
  }
}

}  // namespace rodeira::design
