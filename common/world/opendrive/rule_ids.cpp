// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/rule_ids.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace rodeira::opendrive {

namespace {

// All rules that findings name; {} stands for the name of an element or attribute. tools/error_ids compares this list
// with the rest of the sources.
constexpr std::array kRules = std::to_array<std::string_view>({
    "core.header",
    "core.include",
    "core.once",
    "core.roads",
    "core.version",
    "ids.id_unique_in_class",
    "ids.id_unique_in_class.{}",
    "junctions.boundary.lane",
    "junctions.boundary.only_for_common_junctions",
    "junctions.boundary.road",
    "junctions.boundary.segment_type",
    "junctions.boundary.segments_close_boundry",
    "junctions.boundary.segments_counter_clockwise_order",
    "junctions.connection.lane_link",
    "junctions.connection.road",
    "junctions.cross_path.only_connect_correct_type",
    "junctions.cross_path.road",
    "junctions.elevation_grid.height",
    "junctions.elevation_grid.only_one_elev_grid",
    "junctions.elevation_grid.perpendicular_vectors",
    "junctions.elevation_grid.squares",
    "junctions.elevation_grid.valid_for_entire_boundry",
    "junctions.id",
    "junctions.objects",
    "junctions.virtual.heading_equal_mainroad",
    "lane_smoothness.contact_point_no_horizontal_gaps",
    "lane_smoothness.contact_point_no_vertical_gaps",
    "not_read",
    "road.elevation",
    "road.elevation.contact_point",
    "road.elevation.elem_asc_order",
    "road.elevation.s",
    "road.geometry.contact_heading",
    "road.geometry.contact_point",
    "road.geometry.contact_s",
    "road.geometry.curvature",
    "road.geometry.elem_asc_order",
    "road.geometry.length",
    "road.geometry.one_element",
    "road.geometry.paramPoly3.length_match",
    "road.geometry.paramPoly3.range",
    "road.geometry.position",
    "road.geometry.shape",
    "road.lane.access.elem_asc_order",
    "road.lane.access.no_mix_of_deny_or_allow",
    "road.lane.border",
    "road.lane.border.elem_asc_order",
    "road.lane.border.exclusive_offset_border",
    "road.lane.border.exclusive_width_border",
    "road.lane.border.overlap_with_inner_lanes",
    "road.lane.center_lane",
    "road.lane.center_lane_no_width",
    "road.lane.fold",
    "road.lane.height",
    "road.lane.id",
    "road.lane.lane_section.elem_asc_order",
    "road.lane.lane_section.one",
    "road.lane.lane_section.s",
    "road.lane.link.lanes_across_lane_sections",
    "road.lane.material",
    "road.lane.roadMark",
    "road.lane.roadMark.sway.elem_asc_order",
    "road.lane.speed",
    "road.lane.type",
    "road.lane.width",
    "road.lane.width.elem_asc_order",
    "road.lane.width.missing",
    "road.lane.{}.elem_asc_order",
    "road.lane.{}.first",
    "road.lane.{}.s_offset",
    "road.lane_offset",
    "road.lane_offset.elem_asc_order",
    "road.lane_offset.s",
    "road.lateral.contact_point",
    "road.lateral.crossfall",
    "road.lateral.crossfall.elem_asc_order",
    "road.lateral.css",
    "road.lateral.css.elem_asc_order",
    "road.lateral.css.strip_id",
    "road.lateral.height",
    "road.lateral.shape.elem_asc_order",
    "road.lateral.superelevation",
    "road.lateral.superelevation.elem_asc_order",
    "road.lateral.{}.s",
    "road.length",
    "road.linkage.both_ways",
    "road.linkage.contact_point",
    "road.linkage.element_dir",
    "road.linkage.element_s",
    "road.linkage.element_type",
    "road.linkage.id",
    "road.linkage.is_junction_needed",
    "road.object.borders",
    "road.object.borders.outline_id",
    "road.object.borders.useCompleteOutline_true",
    "road.object.marking",
    "road.object.material",
    "road.object.measures",
    "road.object.repeat.distance",
    "road.object.repeat.{}",
    "road.object.skeleton.polyline_followed_by_vertex",
    "road.object.skeleton.use_radius_or_width_length",
    "road.object.skeleton.vertex_road.polyline_elements",
    "road.object.type",
    "road.rule",
    "road.signal.measures",
    "road.signal.position",
    "road.signal.type",
    "road.surface.crg",
    "road.surface.crg.s",
    "road.surface.crg.{}",
    "road.type.s",
    "road.{}.first",
    "road.{}.s",
    "rodeira.beside",
    "rodeira.goes_on",
    "rodeira.iso_8608",
    "rodeira.lane.dead_end",
    "rodeira.light_height",
    "rodeira.orientation",
    "rodeira.signal.limit_of_lane",
    "rodeira.signal.limit_of_type",
    "rodeira.surface.damaged",
    "rodeira.surface.file",
    "rodeira.times",
    "rodeira.traffic",
    "xml.attribute",
});

// The rule's id. `{}` and the dot before it are left out.
struct Text {
  std::array<char, 80> letters{};  // zeros at the end
};
constexpr Text TextOf(std::string_view rule) {
  Text text;
  std::size_t size = 0;
  for (const char c : std::string_view("opendrive.")) text.letters[size++] = c;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    if (rule.substr(i).starts_with(".{}")) {
      i += 2;
      continue;
    }
    const char c = rule[i];
    text.letters[size++] = c == '.' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}
constexpr auto kTexts = [] {
  std::array<Text, kRules.size()> texts;
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i] = TextOf(kRules[i]);
  return texts;
}();

template <std::size_t... kIndices>
consteval std::array<base::ErrorId, sizeof...(kIndices)> MakeIds(std::index_sequence<kIndices...> /*all*/) {
  return {base::ErrorId(kTexts[kIndices].letters.data())...};
}

constexpr auto kIds = MakeIds(std::make_index_sequence<kRules.size()>());

// Whether the rule is `pattern` with one part without dots in the place of {}.
bool IsOf(std::string_view rule, std::string_view pattern) {
  const std::size_t at = pattern.find("{}");
  if (at == std::string_view::npos) return rule == pattern;
  const std::string_view before = pattern.substr(0, at), after = pattern.substr(at + 2);
  if (rule.size() <= before.size() + after.size() || !rule.starts_with(before) || !rule.ends_with(after)) return false;
  const std::string_view part = rule.substr(before.size(), rule.size() - before.size() - after.size());
  return part.find('.') == std::string_view::npos;
}

}  // namespace

base::ErrorId IdOfRule(std::string_view rule) {
  // A rule without {} first: "road.lane.first" would have its own id beside "road.{}.first".
  auto found = std::find(kRules.begin(), kRules.end(), rule);
  if (found == kRules.end())
    found = std::find_if(kRules.begin(), kRules.end(), [&](std::string_view pattern) { return IsOf(rule, pattern); });
  if (found == kRules.end()) return base::ErrorId("opendrive.rule_broken");
  return kIds[static_cast<std::size_t>(found - kRules.begin())];
}

}  // namespace rodeira::opendrive
