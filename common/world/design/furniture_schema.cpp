// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/furniture_schema.hpp"

#include <string>
#include <utility>

#include "common/world/design/common_keys.hpp"
#include "common/world/design/furniture_reader.hpp"
#include "common/world/design/object_reader.hpp"

namespace rodeira::design {
namespace {

using config::ComputedNumberKey;
using config::Key;
using config::MappingKey;
using config::NumberKey;
using config::Required;
using config::Summarised;
using config::WithDefaultNote;
using config::WordKey;

Key MarkedLaneKey(const char* usual) {
  return WithDefaultNote(usual, config::OptionalIntegerKey("lane", -30, 30, "Lane."));
}

Key MakeMarkingItem() {
  const Key s = StationKey("s_m", "Station of its middle.");
  return config::KindsItem(
      Required(WordKey("type", {"crossing", "stop_line", "arrow"}, "crossing", "Type of the marking.")),
      {MappingKey("crossing",
                  {s, NumberKey("length_m", {1.0, 20.0}, 4.0, "Length of the stripes along the road."),
                   MarkedLaneKey("all drivable ones")},
                  "Zebra crossing with stripes of 0.5 m."),
       MappingKey("stop_line",
                  {s, NumberKey("length_m", {0.1, 2.0}, 0.5, "Thickness along the road."),
                   WordKey("for", {"along", "against"}, "along", "Direction of the traffic that stops."),
                   MarkedLaneKey("all of `for`")},
                  "Stop line."),
       MappingKey("arrow",
                  {s, NumberKey("length_m", {1.0, 20.0}, 5.0, "Length."),
                   Required(config::OptionalIntegerKey("lane", -30, 30, "Lane that it lies in.")),
                   Required(config::Counted(
                       1, kAnyNumber,
                       config::ListKey("ways", config::WordItem({"straight", "left", "right"}), "Where it points.")))},
                  "Arrow, which is only drawn.")});
}

// Along the road: once, or repeated.
void AddStand(std::vector<Key>& keys) {
  for (Key& key : std::vector<Key>{
           ComputedNumberKey("s_m", config::Range::NotNegative(), "or `every_m`", "Station."),
           config::OptionalNumberKey("every_m", {0.1, 1e6}, "Repeats it at this distance."),
           NumberKey("from_s_m", config::Range::NotNegative(), 0.0, "First station of what is repeated or goes on."),
           ComputedNumberKey("to_s_m", config::Range::NotNegative(), "end of the road",
                             "Last station of what is repeated or goes on.")})
    keys.push_back(std::move(key));
}

// Across the road.
void AddBeside(const char* usual_side, const char* usual_m, std::vector<Key>& keys) {
  for (Key& key : std::vector<Key>{
           ComputedNumberKey("t_m", {-1000.0, 1000.0}, "or `beside_m`", "Left of the axis."),
           WithDefaultNote(usual_side, config::OptionalWordKey("side", {"left", "right"}, "Side of the road.")),
           ComputedNumberKey("beside_m", {-100.0, 1000.0}, usual_m, "Beyond the outermost edge.")})
    keys.push_back(std::move(key));
}

Key RotationKey() { return NumberKey("rotation_deg", kTurn_deg, 0.0, "Turned to the left."); }

std::vector<Key> MakeSignKeys() {
  std::vector<std::string> names;
  for (const SignKind& kind : SignKinds()) names.emplace_back(kind.name);
  std::vector<Key> keys{
      Required(Summarised("see below", WordKey("type", names, names.front(), "Type of the sign."))),
      ComputedNumberKey("value", {0.0, 1000.0}, "required where shown", "Number on the sign: km/h or %.")};
  AddStand(keys);
  AddBeside("by `for`", "-0.3", keys);
  for (Key& key : std::vector<Key>{WordKey("for", {"along", "against", "both"}, "along", "Direction of its traffic."),
                                   NumberKey("z_m", {-50.0, 50.0}, 2.0, "Lower edge over the road."),
                                   ComputedNumberKey("height_m", {0.1, 10.0}, "by `type`", "Height of the sign."),
                                   RotationKey(), config::TextKey("text", "", "Name of the town.")})
    keys.push_back(std::move(key));
  return keys;
}

// Of every object, wherever it stands.
std::vector<Key> OwnKeys() {
  const std::vector<std::string> types = ObjectTypes();
  return {Required(WordKey("type", types, types.front(), "Type of the object.")),
          config::ComputedTextKey("name", "that of `type`", "mill", "Name."),
          config::ComputedTextKey("model", "drawn by `type`", "worn.png", "File of a model, or a picture."),
          ComputedNumberKey("length_m", {0.0, 1000.0}, "by `type`", "Length."),
          ComputedNumberKey("width_m", {0.0, 1000.0}, "by `type`", "Width."),
          ComputedNumberKey("height_m", {0.0, 200.0}, "by `type`", "Height."),
          ComputedNumberKey("radius_m", {0.1, 50.0}, "0.3 of the height", "Radius of a tree or bush."),
          NumberKey("z_m", {-50.0, 50.0}, 0.0, "Height over the ground.")};
}

std::vector<Key> MakeObjectKeys() {
  std::vector<Key> keys = OwnKeys();
  AddStand(keys);
  AddBeside("right", "4; -0.5 of rails and walls", keys);
  keys.push_back(RotationKey());
  return keys;
}

std::vector<Key> MakePropKeys() {
  std::vector<Key> keys = OwnKeys();
  for (Key& key : std::vector<Key>{
           ComputedNumberKey("x_m", kPlace_m, "or `along`", "Place to the east."),
           ComputedNumberKey("y_m", kPlace_m, "or `along`", "Place to the north."),
           NumberKey("heading_deg", kTurn_deg, 0.0, "Direction of its x axis, from east to north."),
           WithDefaultNote(
               "or `x_m`, `y_m`",
               config::WithSample("[[0, 0], [10, 0]]",
                                  config::ListKey("along", config::OtherKey("", "[x, y]", "[0, 0], [10, 0]", ""),
                                                  "Line of a row, or of a rail or wall; two points or more."))),
           ComputedNumberKey("every_m", {0.1, 1e6}, "required of a row", "Distance in the row."), RotationKey()})
    keys.push_back(std::move(key));
  return keys;
}

}  // namespace

const Key& MarkingItem() {
  static const Key item = MakeMarkingItem();
  return item;
}

const std::vector<Key>& SignKeys() {
  static const std::vector<Key> keys = MakeSignKeys();
  return keys;
}

const std::vector<Key>& ObjectKeys() {
  static const std::vector<Key> keys = MakeObjectKeys();
  return keys;
}

const std::vector<Key>& PropKeys() {
  static const std::vector<Key> keys = MakePropKeys();
  return keys;
}

}  // namespace rodeira::design
