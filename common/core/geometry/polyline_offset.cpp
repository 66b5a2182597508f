// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/polyline_offset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/geometry/polyline_crossings.hpp"

namespace rodeira::geometry {
namespace {

Eigen::Vector2d LeftOf(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x()}; }

// The node's vector, between a segment that arrives and one that leaves, both unit.
Eigen::Vector2d MitreVector(const Eigen::Vector2d& arriving, const Eigen::Vector2d& leaving, Mitre mitre) {
  // Towards the next node and towards the one before; where the line hardly turns that difference is mostly rounding,
  // and the sum of both perpendiculars has the same direction.
  const bool turns_much = arriving.dot(leaving) < 0.0;
  Eigen::Vector2d along_mitre =
      turns_much ? Eigen::Vector2d(leaving - arriving) : Eigen::Vector2d(LeftOf(arriving) + LeftOf(leaving));
  const Eigen::Vector2d perpendicular = LeftOf(leaving);
  along_mitre.normalize();
  if (along_mitre.dot(LeftOf(arriving) + LeftOf(leaving)) < 0.0) along_mitre = -along_mitre;
  if (mitre == Mitre::kKeepLength) return along_mitre;
  // The mitre's angle to the perpendicular is half the deflection.
  const double cosine = std::max(along_mitre.dot(perpendicular), std::cos(0.5 * kSharpest_rad));
  return along_mitre / cosine;
}

std::vector<Eigen::Vector2d> Directions(const Polyline& line) {
  std::vector<Eigen::Vector2d> directions;
  for (std::size_t i = 1; i < line.points_W.size(); ++i) {
    directions.push_back((line.points_W[i] - line.points_W[i - 1]).head<2>().normalized());
  }
  return directions;
}

// Runs of segments that go backward, and turns beyond the sharpest.
std::vector<OffsetFault> Folds(const Polyline& line, const Polyline& offset) {
  const std::vector<double> stations = StationsOf(line);
  std::vector<OffsetFault> faults;
  std::optional<std::size_t> begin;
  for (std::size_t i = 0; i + 1 < line.points_W.size(); ++i) {
    const Eigen::Vector2d original = (line.points_W[i + 1] - line.points_W[i]).head<2>();
    const bool backward = original.dot((offset.points_W[i + 1] - offset.points_W[i]).head<2>()) <= 0.0;
    if (backward && !begin) begin = i;
    const bool last = i + 2 == line.points_W.size();
    if (begin && (!backward || last)) {
      faults.push_back({OffsetFault::Kind::kCusp, stations[*begin], stations[backward ? i + 1 : i]});
      begin.reset();
    }
  }
  const std::vector<Eigen::Vector2d> directions = Directions(line);
  const auto sharp = [&](std::size_t before, std::size_t after) {
    return directions[before].dot(directions[after]) < std::cos(kSharpest_rad);
  };
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (sharp(i - 1, i)) faults.push_back({OffsetFault::Kind::kSharp, stations[i], stations[i]});
  }
  if (line.closed() && sharp(directions.size() - 1, 0)) faults.push_back({OffsetFault::Kind::kSharp, 0.0, 0.0});
  return faults;
}

}  // namespace

std::vector<Eigen::Vector2d> MitreVectors(const Polyline& line, Mitre mitre) {
  const std::vector<Eigen::Vector2d> directions = Directions(line);
  std::vector<Eigen::Vector2d> vectors = {LeftOf(directions.front())};
  for (std::size_t i = 1; i < directions.size(); ++i)
    vectors.push_back(MitreVector(directions[i - 1], directions[i], mitre));
  vectors.push_back(LeftOf(directions.back()));
  if (line.closed()) vectors.front() = vectors.back() = MitreVector(directions.back(), directions.front(), mitre);
  return vectors;
}

OffsetLine Offset(const Polyline& line, double left_m, Mitre mitre) {
  OffsetLine offset{line, {}};
  const std::vector<Eigen::Vector2d> vectors = MitreVectors(line, mitre);
  for (std::size_t i = 0; i < vectors.size(); ++i) offset.line.points_W[i].head<2>() += left_m * vectors[i];
  offset.faults = Folds(line, offset.line);

  // What crosses in the offset line and not in the original, and is no part of a cusp that is told of already.
  const std::vector<Crossing> before = CrossingsOf(line, StationsOf(line));
  const double near = 4.0 * std::fabs(left_m);
  for (const Crossing& crossing : CrossingsOf(offset.line, StationsOf(line))) {
    const bool known = std::any_of(before.begin(), before.end(), [&](const Crossing& old) {
      return std::fabs(old.first_m - crossing.first_m) <= near && std::fabs(old.second_m - crossing.second_m) <= near;
    });
    const bool of_a_cusp = std::any_of(offset.faults.begin(), offset.faults.end(), [&](const OffsetFault& fault) {
      return fault.kind != OffsetFault::Kind::kCrossing && crossing.first_m <= fault.to_m &&
             crossing.second_m >= fault.from_m;
    });
    if (!known && !of_a_cusp)
      offset.faults.push_back({OffsetFault::Kind::kCrossing, crossing.first_m, crossing.second_m});
  }
  return offset;
}

std::string FaultText(const OffsetFault& fault, double left_m) {
  const std::string by =
      fmt::format("the offset by {:.6g} m to the {}", std::fabs(left_m), left_m > 0.0 ? "left" : "right");
  switch (fault.kind) {
    case OffsetFault::Kind::kCusp:
      return fmt::format(
          "{} folds between stations {:.3f} m and {:.3f} m, where the line bends more sharply than it is offset", by,
          fault.from_m, fault.to_m);
    case OffsetFault::Kind::kCrossing:
      return fmt::format("{} crosses itself: stations {:.3f} m and {:.3f} m come to lie at one place", by, fault.from_m,
                         fault.to_m);
    case OffsetFault::Kind::kSharp:
      break;
  }
  return fmt::format("the line turns back by more than 160 degrees at station {:.3f} m; no mitre keeps its width there",
                     fault.from_m);
}

}  // namespace rodeira::geometry
