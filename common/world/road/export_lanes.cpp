// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/export_lanes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "common/world/road/export_text.hpp"

namespace rodeira::road {
namespace {

// A painted line at a lane's edge, and its distance from the edge.
struct EdgeMark {
  const network::PaintedLine* line;
  double t_offset_m;
};

// By lane (0: the centre) the marks of a section, from the left.
std::map<int, std::vector<EdgeMark>> MarksOf(const network::Road& road, const network::LaneSection& section) {
  std::map<int, std::vector<EdgeMark>> marks;
  for (const network::PaintedLine& line : road.spec().lines) {
    if (line.to_s_m <= section.s_m || line.from_s_m >= section.end_s_m) continue;
    const double s = 0.5 * (std::max(line.from_s_m, section.s_m) + std::min(line.to_s_m, section.end_s_m));
    const geometry::CubicPoint centre = road.CentreAt(s);
    const double t = line.t.Value(s);
    int nearest = 0;
    double offset = t - centre.value;
    for (const auto* side : {&section.left, &section.right}) {
      for (const network::Lane& lane : *side) {
        const double edge = section.Span(lane.id, centre, s)->outer_t_m;
        if (std::fabs(t - edge) < std::fabs(offset)) nearest = lane.id, offset = t - edge;
      }
    }
    marks[nearest].push_back({&line, offset});
  }
  for (auto& [lane, list] : marks) {
    std::stable_sort(list.begin(), list.end(),
                     [](const EdgeMark& a, const EdgeMark& b) { return a.t_offset_m > b.t_offset_m; });
  }
  return marks;
}

std::string MarksText(const std::vector<EdgeMark>& marks, const network::LaneSection& section) {
  std::set<double> begins;
  for (const EdgeMark& mark : marks) {
    begins.insert(std::max(mark.line->from_s_m, section.s_m));
    if (mark.line->to_s_m < section.end_s_m) begins.insert(mark.line->to_s_m);
  }
  std::string text;
  if (begins.empty() || *begins.begin() > section.s_m) text += "<roadMark sOffset=\"0\" type=\"none\"/>\n";
  for (const double s : begins) {
    std::string type, lines;
    const network::PaintedLine* first = nullptr;
    for (const EdgeMark& mark : marks) {
      const network::PaintedLine& line = *mark.line;
      if (line.from_s_m > s || line.to_s_m <= s) continue;
      if (first == nullptr) first = &line;
      const bool dashed = line.gap_m > 0.0;
      type += (type.empty() ? "" : " ") + std::string(dashed ? "broken" : "solid");
      const double period = line.stroke_m + line.gap_m;
      const double phase = dashed ? std::fmod(s - line.from_s_m, period) : 0.0;
      lines += fmt::format("<line length=\"{}\" space=\"{}\" tOffset=\"{}\" sOffset=\"{}\" width=\"{}\" color=\"{}\"/>",
                           dashed ? line.stroke_m : 0.0, dashed ? line.gap_m : 0.0, mark.t_offset_m,
                           phase > 0.0 ? period - phase : 0.0, line.width_m, line.colour);
    }
    if (first == nullptr) {
      text += fmt::format("<roadMark sOffset=\"{}\" type=\"none\"/>\n", s - section.s_m);
      continue;
    }
    const bool known = type == "solid" || type == "broken" || std::count(type.begin(), type.end(), ' ') == 1;
    text += fmt::format(
        "<roadMark sOffset=\"{}\" type=\"{}\" weight=\"standard\" color=\"{}\" width=\"{}\"><type name=\"{}\" "
        "width=\"{}\">{}</type></roadMark>\n",
        s - section.s_m, known ? type : "custom", first->colour, first->width_m, type, first->width_m, lines);
  }
  return text;
}

std::string LaneText(const network::Lane& lane, const network::LaneSection& section, bool left_hand,
                     const std::string& marks) {
  const int usual = (lane.id < 0) != left_hand ? 1 : -1;
  const char* direction = lane.direction == usual ? ""
                          : lane.direction == 0   ? " direction=\"both\""
                                                  : " direction=\"reversed\"";
  std::string text = fmt::format("<lane id=\"{}\" type=\"{}\" level=\"{}\"{}>\n", lane.id,
                                 network::LaneTypeName(lane.type), lane.level ? "true" : "false", direction);
  std::string links;
  for (const int id : lane.predecessors) links += fmt::format("<predecessor id=\"{}\"/>", id);
  for (const int id : lane.successors) links += fmt::format("<successor id=\"{}\"/>", id);
  if (!links.empty()) text += "<link>" + links + "</link>\n";
  // The first record holds from the section's beginning on.
  for (const geometry::Cubic& cubic : lane.width.records()) {
    const double offset = cubic.from - section.s_m;
    if (offset >= 0.0) text += CubicText("width", "sOffset", offset, cubic);
  }
  text += marks;
  for (const auto& material : lane.materials) {
    text += fmt::format("<material sOffset=\"{}\" surface=\"{}\"", material.s_m - section.s_m, material.surface);
    if (material.friction) text += fmt::format(" friction=\"{}\"", *material.friction);
    text += "/>\n";
  }
  for (const auto& speed : lane.speeds) {
    if (std::isfinite(speed.speed_mps))
      text +=
          fmt::format("<speed sOffset=\"{}\" max=\"{}\" unit=\"m/s\"/>\n", speed.s_m - section.s_m, speed.speed_mps);
  }
  for (const auto& height : lane.heights) {
    text += fmt::format("<height sOffset=\"{}\" inner=\"{}\" outer=\"{}\"/>\n", height.s_m - section.s_m,
                        height.inner_m, height.outer_m);
  }
  // OpenDRIVE cannot say where vehicles begin and end.
  if (lane.traffic_begins) text += "<userData code=\"rodeira:traffic\" value=\"begins\"/>\n";
  if (lane.traffic_ends) text += "<userData code=\"rodeira:traffic\" value=\"ends\"/>\n";
  const auto beside = [&text](const char* code, const std::optional<network::LaneName>& name) {
    if (name) text += fmt::format("<userData code=\"{}\" value=\"{} {}\"/>\n", code, name->lane, Escaped(name->road));
  };
  beside("rodeira:left", lane.left_beside), beside("rodeira:right", lane.right_beside);
  return text + "</lane>\n";
}

}  // namespace

std::string LanesText(const network::Road& road) {
  std::string text = "<lanes>\n";
  for (const geometry::Cubic& cubic : road.spec().lane_offset.records()) {
    if (cubic.from >= 0.0 && !road.spec().lane_offset.zero()) text += CubicText("laneOffset", "s", cubic.from, cubic);
  }
  for (const network::LaneSection& section : road.spec().sections) {
    const auto marks = MarksOf(road, section);
    const auto of = [&](int lane) {
      return MarksText(marks.contains(lane) ? marks.at(lane) : std::vector<EdgeMark>(), section);
    };
    text += fmt::format("<laneSection s=\"{}\">\n", section.s_m);
    if (!section.left.empty()) {
      text += "<left>\n";
      for (std::size_t i = section.left.size(); i-- > 0;) {
        text += LaneText(section.left[i], section, road.spec().left_hand, of(section.left[i].id));
      }
      text += "</left>\n";
    }
    text += "<center>\n<lane id=\"0\" type=\"none\" level=\"false\">\n" + of(0) + "</lane>\n</center>\n";
    if (!section.right.empty()) {
      text += "<right>\n";
      for (const network::Lane& lane : section.right)
        text += LaneText(lane, section, road.spec().left_hand, of(lane.id));
      text += "</right>\n";
    }
    text += "</laneSection>\n";
  }
  return text + "</lanes>\n";
}

}  // namespace rodeira::road
