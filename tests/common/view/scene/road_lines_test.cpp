// SPDX-License-Identifier: Apache-2.0
// The lines and rows of points that a road is drawn by, against its formulas between the points: chord errors, and how
// far apart points lie.
#include "common/view/scene/breaklines/road_lines.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// As the numbers are asked of the four levels, whatever the code takes: in plan and in height.
constexpr std::array<Tolerance, 4> kTolerances = {{{0.001, 0.003}, {0.02, 0.02}, {0.10, 0.10}, {0.50, 0.50}}};

struct Worst {
  double plan_m = 0.0, height_m = 0.0;
  std::string where;  // the worst in height
  std::size_t asked = 0;
};

struct RoadPlace {
  double s_m, t_m, z_m;  // z: of its surface
};

// The road's own place over or under a point. By its plan alone, the nearest foot of all panels, so that it is found
// beside the road's edges too; where a road leans, as SUELO finds it, and then nothing beside its edges.
std::optional<RoadPlace> PlaceOn(const network::Network& network, std::uint32_t index, const Eigen::Vector3d& p_W) {
  const network::Road& road = network.roads()[index];
  if (road.rolled()) {
    thread_local std::vector<network::Surfacing> surfaces;
    network.Surfaces(p_W.x(), p_W.y(), surfaces);
    std::optional<RoadPlace> nearest;
    for (const network::Surfacing& surface : surfaces) {
      const double z_m = surface.sample.p_W.z();
      if (surface.place.lane.road != index || surface.place.distance_m > 0.0 ||
          (nearest && std::fabs(nearest->z_m - p_W.z()) <= std::fabs(z_m - p_W.z())))
        continue;
      nearest = RoadPlace{surface.place.s_m, surface.place.t_m, z_m};
    }
    return nearest;
  }
  double s = 0.0, t = 1e9, beyond = 1e9;
  for (const geometry::AxisPanel& panel : road.axis().panels()) {
    if ((panel.middle_W - p_W.head<2>()).norm() > panel.half_m + 40.0) continue;
    const geometry::AxisFoot foot = road.axis().Foot(panel, p_W.head<2>());
    if (std::hypot(foot.t_m, foot.beyond_m) < std::hypot(t, beyond))
      t = foot.t_m, beyond = foot.beyond_m, s = panel.middle_s_m + foot.u_m;
  }
  if (std::fabs(beyond) > 1e-6 || s < 0.0 || s > road.length_m()) return std::nullopt;
  return RoadPlace{s, t, road.Surface(s, t).p_W.z()};
}

// Dense places on the chords between neighbouring points of a road's lines: how far the nearest edge of a lane is from
// them across the road, and the road's surface above or below. Lines across the road and those between lanes' edges are
// held in height alone.
void Measure(const network::Network& network, std::uint32_t index, const Tolerance& tolerance, Worst& worst) {
  const network::Road& road = network.roads()[index];
  const network::LaneSection* section = nullptr;
  for (const Line3& line : RoadLinesOf(road, tolerance)) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Eigen::Vector3d chord = line[i + 1] - line[i];
      if (chord.head<2>().norm() < 0.01) continue;
      for (int k = 1; k < 16; ++k) {
        const Eigen::Vector3d p = line[i] + chord * (k / 16.0);
        const std::optional<RoadPlace> place = PlaceOn(network, index, p);
        if (!place) continue;
        const double s = place->s_m, t = place->t_m;
        section = &road.SectionAt(s);
        ++worst.asked;
        const double off_m = std::fabs(place->z_m - p.z());
        if (off_m > worst.height_m)
          worst.height_m = off_m, worst.where = fmt::format("road {}, s {:.3f}, t {:.4f}, {}/16 of a chord of {:.3f} m",
                                                            road.id(), s, t, k, chord.norm());
        const geometry::CubicPoint centre = road.CentreAt(s);
        double nearest = std::fabs(t - centre.value), width = 1e9;
        for (const auto* side : {&section->left, &section->right}) {
          for (const network::Lane& lane : *side) {
            const auto span = section->Span(lane.id, centre, s);
            nearest = std::min(nearest, std::fabs(t - span->outer_t_m));
            width = std::min(width, span->width_m());
          }
        }
        const bool along = std::fabs(chord.head<2>().normalized().dot(road.axis().Evaluate(s).tangent_W)) > 0.9;
        if (along && nearest < 0.1 * width) worst.plan_m = std::max(worst.plan_m, nearest);
      }
    }
  }
}

TEST(RoadLines, KeepTheChordErrorOfTheirLevel) {
  for (const std::string name : {"n222", "haste", "motorway"}) {
    const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    for (std::size_t level = 0; level < kTolerances.size(); ++level) {
      Worst worst;
      const network::Network& network = *loaded.value()->network();
      for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
        // In a junction the ground is the junction's, and so is what is drawn (JunctionMesh).
        if (network.roads()[index].spec().junction.empty()) Measure(network, index, kTolerances[level], worst);
      }
      if (level < 2) {  // coarser ones are farther off than a tenth of a narrow lane, so that this does not tell its
                        // edge from another line
        EXPECT_LE(worst.plan_m, kTolerances[level].plan_m) << name << ", level " << level;
      }
      EXPECT_LE(worst.height_m, kTolerances[level].height_m) << name << ", level " << level << ": " << worst.where;
      EXPECT_GT(worst.asked, 100u) << name;
      std::printf("%s, level %zu: %zu places, worst %.2f mm in plan, %.2f mm in height\n", name.c_str(), level,
                  worst.asked, 1e3 * worst.plan_m, 1e3 * worst.height_m);
    }
  }
}

}  // namespace
}  // namespace rodeira::scene
