// SPDX-License-Identifier: Apache-2.0
#include "tests/common/world/network/file_oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <pugixml.hpp>
#include <set>

namespace rodeira::network {
namespace {

constexpr double kStep_m = 0.5;
constexpr double kClosed_m = 0.05;  // docs/reference/opendrive.md, "What is checked": gaps up to this are closed

// Simpson's rule on short parts of [from, to].
template <class Value, class F>
Value Integral(double from, double to, double longest, Value zero, const F& f) {
  const int parts = std::max(1, static_cast<int>(std::ceil(std::fabs(to - from) / longest)));
  const double h = (to - from) / parts;
  Value sum = zero;
  for (int i = 0; i < parts; ++i) {
    const double a = from + i * h;
    sum += h / 6.0 * (f(a) + 4.0 * f(a + 0.5 * h) + f(a + h));
  }
  return sum;
}

double Number(const pugi::xml_node& node, const char* name) { return node.attribute(name).as_double(); }

}  // namespace

Eigen::Vector2d FileOracle::Element::Direction(double at) const {
  if (!cubic) {
    const double heading = heading_rad + at * (curvature + 0.5 * at * curvature_rate);
    return {std::cos(heading), std::sin(heading)};
  }
  const double du = u[1] + at * (2.0 * u[2] + 3.0 * at * u[3]), dv = v[1] + at * (2.0 * v[2] + 3.0 * at * v[3]);
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  return {c * du - s * dv, s * du + c * dv};
}

Eigen::Vector2d FileOracle::Element::From(const Sample& sample, double at) const {
  return sample.p + Integral(sample.at, at, cubic ? p_end / 4000.0 : 0.05, Eigen::Vector2d(0.0, 0.0),
                             [&](double x) { return Direction(x); });
}

double FileOracle::Element::StationFrom(const Sample& sample, double at) const {
  if (!cubic) return s_m + at;
  return sample.s_m + length_m / own_length *
                          Integral(sample.at, at, p_end / 4000.0, 0.0, [&](double x) { return Direction(x).norm(); });
}

void FileOracle::Element::Cut() {
  if (cubic) own_length = Integral(0.0, p_end, p_end / 4000.0, 0.0, [&](double x) { return Direction(x).norm(); });
  const int count = std::max(2, static_cast<int>(std::ceil(length_m / kStep_m)));
  const double end = cubic ? p_end : length_m;
  samples.push_back({0.0, s_m, start});
  for (int i = 1; i <= count; ++i) {
    const double at = i == count ? end : end * i / count;
    const Sample before = samples.back();
    samples.push_back({at, StationFrom(before, at), From(before, at)});
  }
}

FileOracle::FileOracle(const std::string& text) {
  pugi::xml_document document;
  if (!document.load_string(text.c_str())) {
    ADD_FAILURE() << "no XML";
    return;
  }
  const auto pieces = [](const pugi::xml_node& parent, const char* name, const char* from, double moved) {
    Pieces result;
    for (const pugi::xml_node& node : parent.children(name))
      result.push_back(
          {moved + Number(node, from), Number(node, "a"), Number(node, "b"), Number(node, "c"), Number(node, "d")});
    return result;
  };
  for (const pugi::xml_node& node : document.child("OpenDRIVE").children("road")) {
    OneRoad road;
    road.id = node.attribute("id").as_string();
    road.length_m = Number(node, "length");
    road.linked_before = node.child("link").child("predecessor"),
    road.linked_behind = node.child("link").child("successor");
    for (const pugi::xml_node& geometry : node.child("planView").children("geometry")) {
      Element element;
      element.s_m = Number(geometry, "s"), element.length_m = Number(geometry, "length"),
      element.heading_rad = Number(geometry, "hdg");
      element.start = {Number(geometry, "x"), Number(geometry, "y")};
      if (const auto arc = geometry.child("arc")) element.curvature = Number(arc, "curvature");
      if (const auto spiral = geometry.child("spiral")) {
        element.curvature = Number(spiral, "curvStart");
        element.curvature_rate = (Number(spiral, "curvEnd") - element.curvature) / element.length_m;
      }
      if (const auto graph = geometry.child("poly3")) {
        element.cubic = true;
        const char* names[4] = {"a", "b", "c", "d"};
        for (int i = 0; i < 4; ++i) element.v[i] = Number(graph, names[i]);
        // v over u: as far as the curve is as long as the element.
        double low = 0.0, high = element.length_m;
        for (int i = 0; i < 200; ++i) {
          const double middle = 0.5 * (low + high);
          const double long_m = Integral(0.0, middle, element.length_m / 2000.0, 0.0,
                                         [&](double x) { return element.Direction(x).norm(); });
          (long_m < element.length_m ? low : high) = middle;
        }
        element.p_end = 0.5 * (low + high);
      }
      if (const auto curve = geometry.child("paramPoly3")) {
        element.cubic = true;
        const char* u[4] = {"aU", "bU", "cU", "dU"};
        const char* v[4] = {"aV", "bV", "cV", "dV"};
        for (int i = 0; i < 4; ++i) element.u[i] = Number(curve, u[i]), element.v[i] = Number(curve, v[i]);
        element.p_end = std::string(curve.attribute("pRange").as_string()) == "normalized" ? 1.0 : element.length_m;
      }
      if (element.cubic) {
        const double c = std::cos(element.heading_rad), s = std::sin(element.heading_rad);
        element.start += Eigen::Vector2d(c * element.u[0] - s * element.v[0], s * element.u[0] + c * element.v[0]);
      }
      element.Cut();
      road.elements.push_back(std::move(element));
    }
    road.elevation = pieces(node.child("elevationProfile"), "elevation", "s", 0.0);
    for (const pugi::xml_node& lateral : node.child("lateralProfile").children()) {
      for (const char* name : {"a", "b", "c", "d"}) has_lateral_ = has_lateral_ || Number(lateral, name) != 0.0;
      has_lateral_ = has_lateral_ || std::string(lateral.name()) == "crossSectionSurface";
    }
    const pugi::xml_node lanes = node.child("lanes");
    road.offset = pieces(lanes, "laneOffset", "s", 0.0);
    for (const pugi::xml_node& part : lanes.children("laneSection")) {
      Section section;
      section.s_m = Number(part, "s");
      for (const char* side : {"left", "right"}) {
        for (const pugi::xml_node& lane : part.child(side).children("lane")) {
          has_borders_ = has_borders_ || lane.child("border");
          for (const pugi::xml_node& height : lane.children("height"))
            has_heights_ = has_heights_ || Number(height, "inner") != 0.0 || Number(height, "outer") != 0.0;
          auto& list = side[0] == 'l' ? section.left : section.right;
          list.push_back({lane.attribute("id").as_int(), lane.attribute("type").as_string(),
                          pieces(lane, "width", "sOffset", section.s_m)});
        }
      }
      const auto outward = [](const OneLane& a, const OneLane& b) { return std::abs(a.id) < std::abs(b.id); };
      std::sort(section.left.begin(), section.left.end(), outward),
          std::sort(section.right.begin(), section.right.end(), outward);
      road.sections.push_back(std::move(section));
    }
    roads_.push_back(std::move(road));
  }
}

double FileOracle::At(const Pieces& pieces, double s_m) {
  double value = 0.0;
  for (const Piece& piece : pieces) {
    if (piece.s_m > s_m && &piece != pieces.data()) break;
    const double x = s_m - piece.s_m;
    value = piece.a + piece.b * x + piece.c * x * x + piece.d * x * x * x;
  }
  return value;
}

bool FileOracle::Changes(const Pieces& pieces, double s_m) {
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](const Piece& piece) { return std::fabs(piece.s_m - s_m) < kNear_m; });
}

Eigen::Vector3d FileOracle::On(std::size_t road_index, double s_m) const {
  const OneRoad& road = roads_[road_index];
  const Sample* nearest = &road.elements[0].samples[0];
  for (const Element& element : road.elements) {
    for (const Sample& sample : element.samples) {
      if (std::fabs(sample.s_m - s_m) < std::fabs(nearest->s_m - s_m)) nearest = &sample;
    }
  }
  return {nearest->p.x(), nearest->p.y(), At(road.elevation, nearest->s_m)};
}

void FileOracle::See(const OneRoad& road, std::size_t index, const Sample& from, double at, bool end,
                     const Eigen::Vector2d& p, std::optional<double> z_m, std::vector<Foot>& feet) const {
  const Element& element = road.elements[index];
  Foot foot;
  foot.road = road.id;
  foot.s_m = std::clamp(element.StationFrom(from, at), 0.0, road.length_m);
  const Eigen::Vector2d away = p - element.From(from, at), ahead = element.Direction(at).normalized();
  foot.t_m = ahead.x() * away.y() - ahead.y() * away.x();
  const double beyond = end ? std::fabs(ahead.dot(away)) : 0.0;
  foot.past_end = beyond > 0.0;

  std::size_t k = 0;
  while (k + 1 < road.sections.size() && road.sections[k + 1].s_m <= foot.s_m) ++k;
  const Section& section = road.sections[k];
  const double centre = At(road.offset, foot.s_m);
  foot.near_change = std::any_of(road.sections.begin() + 1, road.sections.end(),
                                 [&](const Section& other) { return std::fabs(other.s_m - foot.s_m) < kNear_m; }) ||
                     Changes(road.offset, foot.s_m) || std::fabs(foot.t_m - centre) < kNear_m;
  const bool to_left = foot.t_m >= centre;
  const double sign = to_left ? 1.0 : -1.0, wanted = sign * (foot.t_m - centre);
  double reached = 0.0, inner = 0.0;
  for (const OneLane& lane : to_left ? section.left : section.right) {
    inner = reached;
    reached += std::max(0.0, At(lane.width, foot.s_m));
    foot.near_change = foot.near_change || std::fabs(wanted - reached) < kNear_m || Changes(lane.width, foot.s_m);
    static const std::set<std::string> kDriven = {
        "driving",  "bidirectional", "entry", "exit", "onRamp", "offRamp",  "connectingRamp",
        "slipLane", "shared",        "bus",   "taxi", "HOV",    "mwyEntry", "mwyExit"};
    foot.lane = lane.id, foot.drivable = kDriven.contains(lane.type);
    foot.from_centre_m = std::fabs(wanted - 0.5 * (inner + reached));
    if (wanted <= reached && reached > inner) break;
  }
  const double aside = std::max(0.0, wanted - reached);
  // At a road's own end that leads nowhere nothing is closed; between elements that meet without a gap no more than
  // rounding.
  const bool first = index == 0 && at == 0.0, last = index + 1 == road.elements.size() && at != 0.0;
  const bool closed = first ? road.linked_before : (last ? road.linked_behind : true);
  foot.outside_m = beyond > (closed ? kClosed_m : kNear_m) ? std::hypot(aside, beyond) : aside;
  if (beyond > 0.0 && beyond < kClosed_m + kNear_m) foot.near_change = true;
  foot.z_m = At(road.elevation, foot.s_m);
  const double above = z_m ? std::max(0.0, std::fabs(*z_m - foot.z_m) - 2.0) : 0.0;
  if (z_m && std::fabs(std::fabs(*z_m - foot.z_m) - 2.0) < kNear_m) foot.near_change = true;
  foot.distance_m = std::hypot(foot.outside_m, above);
  feet.push_back(foot);
}

FileOracle::Answer FileOracle::Locate(const Eigen::Vector2d& p, std::optional<double> z_m) const {
  std::vector<Foot> feet;
  for (const OneRoad& road : roads_) {
    for (std::size_t e = 0; e < road.elements.size(); ++e) {
      const Element& element = road.elements[e];
      const auto& samples = element.samples;
      const auto ahead = [&](const Sample& from, double at) {
        return (p - element.From(from, at)).dot(element.Direction(at));
      };
      double behind = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const double here = (p - samples[i].p).dot(element.Direction(samples[i].at));
        if (i > 0 && behind > 0.0 && here <= 0.0) {  // the distance has a minimum between the two
          double low = samples[i - 1].at, high = samples[i].at;
          for (int n = 0; n < 60 && low < high; ++n) {
            const double middle = 0.5 * (low + high);
            (ahead(samples[i - 1], middle) > 0.0 ? low : high) = middle;
          }
          See(road, e, samples[i - 1], 0.5 * (low + high), false, p, z_m, feet);
        }
        if ((i == 0 && here <= 0.0) || (i + 1 == samples.size() && here >= 0.0))
          See(road, e, samples[i], samples[i].at, true, p, z_m, feet);
        behind = here;
      }
    }
  }
  Answer answer;
  if (feet.empty()) return answer;
  std::vector<const Foot*> on;
  double top = -std::numeric_limits<double>::infinity();
  for (const Foot& foot : feet) {
    if (foot.distance_m > 0.0) continue;
    on.push_back(&foot);
    top = std::max(top, foot.z_m);
  }
  const auto open_beside = [&](const Foot& foot) {  // whether this one belongs to the road at all is open
    return foot.near_change && foot.distance_m < 2.0 * kClosed_m;
  };
  if (on.empty()) {
    const auto nearer = [](const Foot& a, const Foot& b) { return a.distance_m < b.distance_m; };
    const Foot& best = *std::min_element(feet.begin(), feet.end(), nearer);
    answer.best = best;
    answer.open = best.near_change;
    for (const Foot& foot : feet) {
      const bool same = foot.road == best.road && foot.lane == best.lane && std::fabs(foot.s_m - best.s_m) < kNear_m;
      if (!same && (foot.distance_m < best.distance_m + kNear_m || open_beside(foot))) answer.open = true;
    }
    return answer;
  }
  const auto counts = [&](const Foot& foot) { return z_m || foot.z_m >= top - 2.0; };
  const Foot* best = nullptr;
  const auto before = [](const Foot& a, const Foot& b) {
    if (a.past_end != b.past_end) return b.past_end;
    if (a.drivable != b.drivable) return a.drivable;
    return a.from_centre_m < b.from_centre_m;
  };
  for (const Foot* foot : on) {
    if (counts(*foot) && (best == nullptr || before(*foot, *best))) best = foot;
  }
  answer.best = *best;
  answer.open = best->near_change;
  for (const Foot& foot : feet) {
    if (&foot == best || (foot.distance_m > 0.0 && !open_beside(foot))) continue;
    if (foot.near_change || (!z_m && std::fabs(foot.z_m - (top - 2.0)) < kNear_m)) answer.open = true;
    const bool alike = foot.past_end == best->past_end && foot.drivable == best->drivable;
    if (alike && counts(foot) && std::fabs(foot.from_centre_m - best->from_centre_m) < kNear_m) answer.open = true;
  }
  return answer;
}

}  // namespace rodeira::network
