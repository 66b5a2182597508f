// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/section_schema.hpp"

#include <string>
#include <utility>

#include "common/world/design/common_keys.hpp"
#include "common/world/network/earthwork.hpp"
#include "common/world/network/lane.hpp"
#include "common/world/network/line_kinds.hpp"

namespace rodeira::design {
namespace {

using config::ComputedNumberKey;
using config::Key;
using config::ListKey;
using config::MappingKey;
using config::NumberKey;
using config::Required;
using config::RequiredNumberKey;
using config::Summarised;
using config::WithDefaultNote;
using config::WithSample;
using config::WordKey;

std::vector<Key> LaneKeys() {
  std::vector<Key> keys{
      WithSample("-1", config::RequiredIntegerKey("id", -30, 30, "As in OpenDRIVE: −1, −2 … right, 1, 2 … left.")),
      Summarised("type of a lane in OpenDRIVE",
                 WordKey("type", network::LaneTypeNames(), "driving", "Type of the lane."))};
  AddTable(WithSample("3", ComputedNumberKey("width_m", {0.0, 50.0}, "or `widths`", "Width.")), "widths", "width_m",
           "Width there.", keys);
  for (Key& key : std::vector<Key>{
           MaterialKey("asphalt, concrete or grass by `type`"),
           ComputedNumberKey("fall", kFall, "that of `crossfall`", "Slope across, falling outward."),
           NumberKey("kerb_m", {-0.5, 0.5}, 0.0, "Raises the lane and what lies outside of it."),
           ComputedNumberKey("speed_limit_kmh", kSpeed_kmh, "that of the road", "Speed limit."),
           WithDefaultNote("by the side of traffic",
                           config::OptionalWordKey("direction", {"along", "against", "both"}, "Direction of travel."))})
    keys.push_back(std::move(key));
  return keys;
}

// Of a shoulder or a verge.
std::vector<Key> BorderKeys(Key width, const char* material, Key fall) {
  std::vector<Key> keys;
  AddTable(std::move(width), "widths", "width_m", "Width there.", keys);
  keys.push_back(MaterialKey(material));
  keys.push_back(std::move(fall));
  return keys;
}

std::vector<Key> ShoulderKeys() {
  return BorderKeys(NumberKey("width_m", {0.0, 20.0}, 0.0, "Width."), "asphalt",
                    ComputedNumberKey("fall", kFall, "that of `crossfall`", "Slope across, falling outward."));
}

std::vector<Key> MakeTemplateKeys() {
  const network::Earthwork earthwork;
  std::vector<Key> keys{
      WithDefaultNote("those of the template", config::Counted(1, kAnyNumber, ListKey("lanes", LaneKeys(), "Lanes."))),
      MappingKey("crossfall",
                 {WordKey("kind", {"crown", "left", "right"}, "crown", "Both sides fall, or the whole to one side."),
                  NumberKey("fall", {0.0, 0.2}, 0.025, "Slope across.")},
                 "Slope of the lanes."),
      config::Counted(1, kAnyNumber,
                      ListKey("crossfalls",
                              {RequiredNumberKey("s_m", {0.0, 1e8}, "Station, ascending; instead of `crossfall`."),
                               RequiredNumberKey("left", kFall, "Slope of the left side, falling outward."),
                               RequiredNumberKey("right", kFall, "Slope of the right side, falling outward.")},
                              "Instead of `crossfall`.")),
      MappingKey("shoulders",
                 {MappingKey("left", ShoulderKeys(), "Left shoulder."),
                  Summarised("as `left`", MappingKey("right", ShoulderKeys(), "Right shoulder."))},
                 "Shoulders."),
      MappingKey("verge",
                 BorderKeys(NumberKey("width_m", {0.0, 50.0}, 1.0, "Width."), "grass",
                            NumberKey("fall", {-0.5, 0.5}, 0.08, "Slope across, falling outward.")),
                 "Verge on both sides.")};
  AddTable(NumberKey("offset_m", {-100.0, 100.0}, 0.0, "Where the lanes of both sides meet, left of the axis."),
           "offsets", "t_m", "Left of the axis.", keys);
  keys.push_back(
      MappingKey("slopes",
                 {NumberKey("cut", {0.05, 20.0}, earthwork.cut, "Run over rise, where the terrain is higher."),
                  NumberKey("fill", {0.05, 20.0}, earthwork.fill, "Run over rise, where the terrain is lower."),
                  NumberKey("reach_m", {1.0, 500.0}, earthwork.reach_m, "How far a slope reaches from the verge.")},
                 "Slopes between verge and terrain."));
  keys.push_back(ListKey("lines", LineKeys(), "Painted lines."));
  return keys;
}

std::vector<Key> MakeSectionKeys() {
  std::vector<Key> keys{
      config::ComputedTextKey("template", "none", "rural", "Template; keys beside it replace the template's.")};
  keys.insert(keys.end(), TemplateKeys().begin(), TemplateKeys().end());
  return keys;
}

std::vector<Key> MakeLineKeys() {
  std::vector<std::string> kinds;
  for (const network::LineKind& kind : network::kLineKinds) kinds.emplace_back(kind.name);
  std::vector<Key> keys{
      Required(Summarised("see below", WordKey("kind", kinds, kinds.front(), "Kind of line."))),
      WithDefaultNote("or `t_m`", config::OptionalIntegerKey("lane", -30, 30, "On the outer edge of this lane."))};
  AddTable(ComputedNumberKey("t_m", {-200.0, 200.0}, "or `lane`", "Left of the axis."), "ts", "t_m",
           "Left of the axis.", keys);
  for (Key& key :
       std::vector<Key>{NumberKey("offset_m", {-50.0, 50.0}, 0.0, "Moved to the left."), FromKey(), ToKey(),
                        ComputedNumberKey("width_m", {0.01, 5.0}, "by `kind`", "Width of the paint."),
                        WordKey("colour", {"white", "yellow", "blue", "red", "orange"}, "white", "Colour."),
                        ComputedNumberKey("stroke_m", {0.1, 100.0}, "by `kind`", "Length of a dash."),
                        ComputedNumberKey("gap_m", {0.1, 100.0}, "by `kind`", "Length of a gap."),
                        WordKey("left", {"continuous", "dashed"}, "continuous", "Left line of the kind `mixed`."),
                        WordKey("right", {"continuous", "dashed"}, "dashed", "Right line of the kind `mixed`."),
                        NumberKey("apart_m", {0.02, 5.0}, network::kLinesApart_m, "Space between two lines.")})
    keys.push_back(std::move(key));
  return keys;
}

}  // namespace

const std::vector<Key>& MaterialKeys() {
  static const std::vector<Key> keys{
      config::TextKey("surface", "asphalt", "Surface, or an earlier material."),
      ComputedNumberKey("friction", kFriction, "that of `surface`", "Coefficient of friction."),
      config::ComputedTextKey("texture", "look of the surface", "worn.png", "Picture on the lane."),
      NumberKey("texture_m", {0.01, 10'000.0}, 4.0, "Width of the picture on the ground.")};
  return keys;
}

const std::vector<Key>& LineKeys() {
  static const std::vector<Key> keys = MakeLineKeys();
  return keys;
}

const std::vector<Key>& SectionKeys() {
  static const std::vector<Key> keys = MakeSectionKeys();
  return keys;
}

const std::vector<Key>& TemplateKeys() {
  static const std::vector<Key> keys = MakeTemplateKeys();
  return keys;
}

}  // namespace rodeira::design
