// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/road_heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <pugixml.hpp>
#include <sstream>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/terrain/elevation_file.hpp"
#include "common/world/terrain/geographic.hpp"

namespace rodeira::sumo {
namespace {

constexpr double kKnots_m = 20.0;      // between two heights of a road
constexpr double kBlend_m = 60.0;      // from a junction's height to the ground's
constexpr double kOneRoad_rad = 0.35;  // arms of one road through a junction lie within this angle
constexpr double kMaxJunctionGrade = 0.1;
constexpr int kTurns = 400;  // of moving junctions that roads between them are too steep for

// A junction's surface: a height in its middle, and a slope.
struct Plane {
  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero(), slope = Eigen::Vector2d::Zero();
  double z_m = 0.0;

  double At(const Eigen::Vector2d& p_W) const { return z_m + slope.dot(p_W - middle_W); }
};

// An end of a road at a junction.
struct Arm {
  Eigen::Vector2d p_W, along_W;
};

// A knot of a height along a road.
struct Knot {
  double s_m, z_m, grade;
};

Eigen::Vector2d PointAt(const network::Road& road, double s_m) { return road.axis().Evaluate(s_m).p_W; }

Eigen::Vector2d AlongAt(const network::Road& road, double s_m) {
  const double heading_rad = road.axis().Evaluate(s_m).heading_rad;
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

// The mean height within half of kSmooth_m to each side.
std::optional<double> SmoothAt(const GroundHeight& ground, const Eigen::Vector2d& p_W) {
  constexpr int kHalf = 2;
  double sum = 0.0;
  int count = 0;
  for (int x = -kHalf; x <= kHalf; ++x) {
    for (int y = -kHalf; y <= kHalf; ++y) {
      const auto z_m = ground(p_W + 0.5 * kSmooth_m / kHalf * Eigen::Vector2d(x, y));
      if (z_m) sum += *z_m, ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

class Heights {
 public:
  Heights(const network::Network& network, const GroundHeight& ground) : network_(network), ground_(ground) {}

  base::Result<RoadHeights> Make() {
    FindArms();
    FindPlanes();
    EaseGrades();
    RoadHeights heights;
    for (const network::Road& road : network_.roads()) heights[road.id()] = PiecesOf(road);
    if (!unknown_.empty())
      return base::WrongInput("terrain.does_not_fit", "the ground at road " + unknown_ + " is not known");
    return heights;
  }

 private:
  // The junction at a road's end; of a connecting road its own.
  static std::string JunctionAt(const network::Road& road, bool end) {
    if (!road.spec().junction.empty()) return road.spec().junction;
    const auto& link = end ? road.spec().successor : road.spec().predecessor;
    return link && link->junction ? link->id : std::string();
  }

  double Ground(const network::Road& road, const Eigen::Vector2d& p_W) {
    const auto z_m = SmoothAt(ground_, p_W);
    if (!z_m && unknown_.empty())
      unknown_ = fmt::format("'{}' (x {:.1f}, y {:.1f})", road.spec().name.empty() ? road.id() : road.spec().name,
                             p_W.x(), p_W.y());
    return z_m.value_or(0.0);
  }

  void FindArms() {
    for (const network::Road& road : network_.roads()) {
      if (!road.spec().junction.empty()) continue;
      for (const bool end : {false, true}) {
        const std::string junction = JunctionAt(road, end);
        const double s_m = end ? road.length_m() : 0.0;
        if (!junction.empty()) arms_[junction].push_back({PointAt(road, s_m), AlongAt(road, s_m)});
      }
    }
  }

  void FindPlanes() {
    for (const auto& [junction, arms] : arms_) {
      Plane plane;
      for (const Arm& arm : arms) plane.middle_W += arm.p_W / static_cast<double>(arms.size());
      plane.z_m = SmoothAt(ground_, plane.middle_W).value_or(0.0);
      const Eigen::Vector2d along = arms.front().along_W;
      const bool one_road = std::all_of(arms.begin(), arms.end(), [&](const Arm& arm) {
        return std::fabs(arm.along_W.dot(along)) > std::cos(kOneRoad_rad);
      });
      if (one_road) {
        const auto before = SmoothAt(ground_, plane.middle_W - kKnots_m * along),
                   after = SmoothAt(ground_, plane.middle_W + kKnots_m * along);
        if (before && after)
          plane.slope =
              std::clamp((*after - *before) / (2.0 * kKnots_m), -kMaxJunctionGrade, kMaxJunctionGrade) * along;
      }
      planes_[junction] = plane;
    }
  }

  // Moves junctions until the roads between them are no steeper than allowed, or for so many turns.
  void EaseGrades() {
    for (int turn = 0; turn < kTurns; ++turn) {
      bool moved = false;
      for (const network::Road& road : network_.roads()) {
        if (!road.spec().junction.empty()) continue;
        const auto a = planes_.find(JunctionAt(road, false)), b = planes_.find(JunctionAt(road, true));
        if (a == planes_.end() || b == planes_.end() || a == b) continue;
        const double rise = b->second.At(PointAt(road, road.length_m())) - a->second.At(PointAt(road, 0.0));
        const double excess = std::fabs(rise) - kMaxGrade * road.length_m();
        if (excess <= 1e-3) continue;
        const double each = std::copysign(0.5 * excess, rise);
        a->second.z_m += each, b->second.z_m -= each;
        moved = true;
      }
      if (!moved) return;
    }
  }

  // The height and grade at a road's end; at an end without a junction those of the ground.
  Knot EndKnot(const network::Road& road, bool end) {
    const double s_m = end ? road.length_m() : 0.0;
    const Eigen::Vector2d p = PointAt(road, s_m), along = AlongAt(road, s_m);
    if (const auto plane = planes_.find(JunctionAt(road, end)); plane != planes_.end())
      return {s_m, plane->second.At(p), plane->second.slope.dot(along)};
    const double z_m = Ground(road, p), inner_m = end ? -kKnots_m : kKnots_m;
    return {s_m, z_m, (Ground(road, p + inner_m * along) - z_m) / inner_m};
  }

  std::vector<HeightPiece> PiecesOf(const network::Road& road) {
    const double length_m = road.length_m();
    std::vector<Knot> knots{EndKnot(road, false)};
    const Knot last = EndKnot(road, true);
    const bool inside = !road.spec().junction.empty();
    const int between = inside ? 0 : static_cast<int>(length_m / kKnots_m) - 1;
    const double blend_m = std::min(kBlend_m, length_m);
    const auto weight = [&](double distance_m) {
      const double u = std::clamp(distance_m / blend_m, 0.0, 1.0);
      return 1.0 - u * u * (3.0 - 2.0 * u);
    };
    const double first_off = between > 0 ? knots[0].z_m - Ground(road, PointAt(road, 0.0)) : 0.0,
                 last_off = between > 0 ? last.z_m - Ground(road, PointAt(road, length_m)) : 0.0;
    for (int i = 1; i <= between; ++i) {
      const double s_m = length_m * i / (between + 1);
      knots.push_back(
          {s_m, Ground(road, PointAt(road, s_m)) + first_off * weight(s_m) + last_off * weight(length_m - s_m), 0.0});
    }
    knots.push_back(last);
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
      knots[i].grade = (knots[i + 1].z_m - knots[i - 1].z_m) / (knots[i + 1].s_m - knots[i - 1].s_m);
    return Pieces(knots);
  }

  // Cubics from knot to knot.
  static std::vector<HeightPiece> Pieces(const std::vector<Knot>& knots) {
    std::vector<HeightPiece> pieces;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      const Knot &from = knots[i], &to = knots[i + 1];
      const double h = to.s_m - from.s_m, mean = (to.z_m - from.z_m) / h;
      pieces.push_back({from.s_m, from.z_m, from.grade, (3.0 * mean - 2.0 * from.grade - to.grade) / h,
                        (from.grade + to.grade - 2.0 * mean) / (h * h)});
    }
    return pieces;
  }

  const network::Network& network_;
  const GroundHeight& ground_;
  std::map<std::string, std::vector<Arm>> arms_;
  std::map<std::string, Plane> planes_;  // by junction
  std::string unknown_;                  // the first road on unknown ground
};

}  // namespace

base::Result<GroundHeight> GroundOf(const std::filesystem::path& elevation, const network::Network& network) {
  const auto loaded = terrain::LoadElevation(elevation);
  if (!loaded) return loaded.error();
  const std::shared_ptr<const terrain::ElevationGrid> grid = loaded.value();
  const auto height = [grid](const Eigen::Vector2d& p) -> std::optional<double> {
    const terrain::GridSample sample = grid->At(p.x(), p.y());
    return sample.inside ? std::optional(sample.z_m) : std::nullopt;
  };
  const std::string &of_net = network.geo_reference(), &of_grid = grid->projection_wkt();
  if (of_net.empty() && of_grid.empty()) return GroundHeight(height);
  if (of_net.empty() || of_grid.empty())
    return base::WrongInput("terrain.does_not_fit",
                            of_net.empty()
                                ? "the roads do not say where on the earth they lie, and the elevation file does"
                                : "the elevation file does not say where on the earth it lies (a .prj beside it does)",
                            elevation.string());
  const auto from = terrain::Geographic::Make(of_net), to = terrain::Geographic::Make(of_grid);
  if (!from) return from.error();
  if (!to) return to.error();
  const network::GeoOffset offset = network.geo_offset();
  return GroundHeight([height, offset, from = from.value(), to = to.value()](const Eigen::Vector2d& p_W) {
    const Eigen::Vector2d map = offset.ToMap(p_W);
    const auto earth = from.ToEarth(map.x(), map.y());
    const auto place = earth ? to.ToMap(*earth) : std::nullopt;
    return place ? height(*place) : std::nullopt;
  });
}

base::Result<RoadHeights> HeightsOf(const network::Network& network, const GroundHeight& ground) {
  return Heights(network, ground).Make();
}

std::string WithHeights(const std::string& drive, const RoadHeights& heights) {
  pugi::xml_document document;
  document.load_string(drive.c_str());
  for (pugi::xml_node road : document.child("OpenDRIVE").children("road")) {
    const auto of = heights.find(road.attribute("id").value());
    if (of == heights.end()) continue;
    road.remove_child("elevationProfile");
    pugi::xml_node profile = road.insert_child_after("elevationProfile", road.child("planView"));
    for (const HeightPiece& piece : of->second) {
      pugi::xml_node elevation = profile.append_child("elevation");
      for (const auto& [name, value] : {std::pair("s", piece.s_m), std::pair("a", piece.a), std::pair("b", piece.b),
                                        std::pair("c", piece.c), std::pair("d", piece.d)})
        elevation.append_attribute(name) = fmt::format("{}", value).c_str();
    }
  }
  std::ostringstream out;
  document.save(out, " ");
  return std::move(out).str();
}

}  // namespace rodeira::sumo
