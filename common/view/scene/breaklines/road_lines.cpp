// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/breaklines/road_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

using network::LaneSection;
using network::Road;

constexpr double kMaxStationStep_m = 24.0;  // between two stations
constexpr double kMinStationStep_m = 0.05;  // at a kink a finer subdivision gains nothing
constexpr double kAtQuarters =
    0.91;  // of how far a cubic lies from its chord at most, this much at least is seen at one of the chord's quarters
constexpr int kMaxParts = 16;  // of a lane, across

// How far q lies from the chord from a to b, in plan and in height.
std::pair<double, double> FromChord(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& q) {
  const Eigen::Vector2d along = (b - a).head<2>(), to = (q - a).head<2>();
  const double part = along.squaredNorm() > 0.0 ? std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.5;
  return {(to - part * along).norm(), std::fabs(a.z() + part * (b.z() - a.z()) - q.z())};
}

// One lane section's lines.
class SectionLines {
 public:
  SectionLines(const Road& road, std::size_t section, const Tolerance& tolerance)
      : road_(road), section_(road.spec().sections[section]), number_(section), tolerance_(tolerance) {
    parts_.assign(section_.left.size() + section_.right.size(), 1);
  }

  void AddTo(std::vector<Line3>& lines) {
    const std::vector<double> breaks = Breaks();
    if (breaks.size() < 2) return;
    Divide(breaks);
    rows_.push_back(Row(breaks.front()));
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) Refine(breaks[i], breaks[i + 1], Row(breaks[i + 1]), 0);
    const std::size_t first = lines.size();
    lines.resize(first + rows_.front().size());
    for (const Line3& row : rows_) {
      for (std::size_t k = 0; k < row.size(); ++k) lines[first + k].push_back(row[k]);
    }
    lines.push_back(CrossLine(breaks.front()));
    lines.push_back(CrossLine(breaks.back()));
  }

 private:
  // Lanes' edges from right to left, with what lies between them: each point's t.
  std::vector<double> Across(double s) const {
    const geometry::CubicPoint centre = road_.CentreAt(s);
    std::vector<double> edges = {centre.value};
    for (const network::Lane& lane : section_.left) edges.push_back(section_.Span(lane.id, centre, s)->outer_t_m);
    std::reverse(edges.begin(), edges.end());
    for (const network::Lane& lane : section_.right) edges.push_back(section_.Span(lane.id, centre, s)->outer_t_m);
    std::reverse(edges.begin(), edges.end());
    std::vector<double> across = {edges.front()};
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      for (int k = 1; k <= parts_[i]; ++k) across.push_back(edges[i] + (edges[i + 1] - edges[i]) * k / parts_[i]);
    }
    for (const network::Shape& shape : road_.spec().lateral.shapes) {
      for (const geometry::Cubic& record : shape.height.records())
        across.push_back(std::clamp(record.from, edges.front(), edges.back()));
    }
    return across;
  }

  // Heights are asked a little inside of the section: at its end others begin.
  Line3 Row(double s) const {
    Line3 row;
    for (const double t : Across(road_.Held(number_, s))) row.push_back(road_.Surface(road_.Held(number_, s), t).p_W);
    return row;
  }

  Line3 CrossLine(double s) const {
    std::vector<double> across = Across(road_.Held(number_, s));
    std::sort(across.begin(), across.end());
    Line3 line;
    for (const double t : across) line.push_back(road_.Surface(road_.Held(number_, s), t).p_W);
    return line;
  }

  std::vector<double> Breaks() const {
    const double low = section_.s_m, high = std::min(section_.end_s_m, road_.length_m());
    std::vector<double> breaks = {low, high};
    const auto add = [&](double s) {
      if (s > low && s < high) breaks.push_back(s);
    };
    const auto add_table = [&](const geometry::CubicTable& table) {
      for (const geometry::Cubic& record : table.records()) add(record.from);
    };
    const network::RoadSpec& spec = road_.spec();
    for (const geometry::PlanElement& element : road_.axis().elements()) add(element.s_m);
    for (const geometry::CubicTable* table : {&spec.elevation, &spec.superelevation, &spec.lane_offset})
      add_table(*table);
    for (const network::Shape& shape : spec.lateral.shapes) add(shape.s_m);
    for (const auto* side : {&section_.left, &section_.right}) {
      for (const network::Lane& lane : *side) {
        add_table(lane.width);
        add_table(lane.border);
        for (const network::LaneHeight& height : lane.heights) add(height.s_m);
      }
    }
    std::sort(breaks.begin(), breaks.end());
    std::vector<double> kept;
    for (const double s : breaks) {
      if (kept.empty() || s - kept.back() > 1e-6) kept.push_back(s);
    }
    if (kept.size() > 1) kept.back() = high;
    std::vector<double> all = {kept.front()};
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
      const int count = std::max(1, static_cast<int>(std::ceil((kept[i + 1] - kept[i]) / kMaxStationStep_m)));
      for (int k = 1; k <= count; ++k)
        all.push_back(k == count ? kept[i + 1] : kept[i] + (kept[i + 1] - kept[i]) * k / count);
    }
    return all;
  }

  // How many parts each lane needs across, so that its height is straight enough between them.
  void Divide(const std::vector<double>& stations) {
    const network::LateralProfile& lateral = road_.spec().lateral;
    if (lateral.flat() && road_.spec().ground == nullptr) return;
    for (std::size_t lane = 0; lane < parts_.size(); ++lane) {
      for (bool enough = false; !enough && parts_[lane] < kMaxParts;) {
        enough = true;
        for (const double s : stations) enough = enough && IsStraight(lane, road_.Held(number_, s));
        if (!enough) parts_[lane] *= 2;
      }
    }
  }
  bool IsStraight(std::size_t lane, double s) const {
    std::vector<double> across = Across(s);
    std::size_t first = 0;
    for (std::size_t i = 0; i < lane; ++i) first += static_cast<std::size_t>(parts_[i]);
    for (int k = 0; k < parts_[lane]; ++k) {
      const double from = across[first + static_cast<std::size_t>(k)],
                   to = across[first + static_cast<std::size_t>(k) + 1];
      const Eigen::Vector3d a = road_.Surface(s, from).p_W, b = road_.Surface(s, to).p_W;
      for (const double part : {0.3, 0.5, 0.7}) {
        const auto [plan, height] = FromChord(a, b, road_.Surface(s, from + part * (to - from)).p_W);
        if (height > 0.5 * tolerance_.height_m) return false;
      }
    }
    return true;
  }

  bool Fits(const Line3& a, const Line3& b, const Line3& between) const {
    std::size_t edges = 1;
    for (const int parts : parts_) edges += static_cast<std::size_t>(parts);
    for (std::size_t k = 0; k < a.size(); ++k) {
      const auto [plan, height] = FromChord(a[k], b[k], between[k]);
      if (plan > kAtQuarters * tolerance_.plan_m || height > kAtQuarters * tolerance_.height_m) return false;
      if (k > 0 && k < edges &&
          std::fabs(a[k].z() - a[k - 1].z() - b[k].z() + b[k - 1].z()) / 4.0 > tolerance_.height_m)
        return false;
    }
    return true;
  }

  // Rows from the last one to s = to, its own included.
  void Refine(double from, double to, const Line3& last, int depth) {
    const Line3 first = rows_.back();
    bool fits = true;
    if (to - from > kMinStationStep_m && depth < 20) {
      for (const double part : {0.5, 0.25, 0.75}) fits = fits && Fits(first, last, Row(from + part * (to - from)));
    }
    if (fits) {
      rows_.push_back(last);
      return;
    }
    const double middle = 0.5 * (from + to);
    Refine(from, middle, Row(middle), depth + 1);
    Refine(middle, to, last, depth + 1);
  }

  const Road& road_;
  const LaneSection& section_;
  std::size_t number_;
  Tolerance tolerance_;
  std::vector<int> parts_;  // of each lane, from right to left
  std::vector<Line3> rows_;
};

}  // namespace

std::vector<Line3> RoadLinesOf(const network::Road& road, const Tolerance& tolerance) {
  std::vector<Line3> lines;
  for (std::size_t section = 0; section < road.spec().sections.size(); ++section) {
    const network::LaneSection& lanes = road.spec().sections[section];
    if (lanes.left.empty() && lanes.right.empty()) continue;
    SectionLines(road, section, tolerance).AddTo(lines);
  }
  return lines;
}

}  // namespace rodeira::scene
