// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/design_schema.hpp"

#include <utility>

#include "common/world/design/furniture_schema.hpp"
#include "common/world/design/junction_schema.hpp"
#include "common/world/design/road_schema.hpp"
#include "common/world/design/section_schema.hpp"

namespace rodeira::design {
namespace {

using config::Key;
using config::ListKey;
using config::MappingKey;
using config::Schema;
using config::Summarised;

constexpr const char* kFormat = "world/2";

// Of the world file and of every file that it includes.
std::vector<Key> SharedKeys() {
  return {ListKey("include", config::TextItem("village.yaml"), "Files with more of these keys, relative to this one."),
          config::NamedKey("materials", MaterialKeys(), "Materials beside the five surfaces."),
          config::NamedValueKey("templates",
                                Summarised("as `world.section`", MappingKey("", TemplateKeys(), "Cross-section.")),
                                "Cross-sections beside `rural`, `bypass`, `motorway`."),
          ListKey("roads", Summarised("as `world.road`", MappingKey("", RoadKeys(), "Road.")), "Roads."),
          ListKey("junctions", Summarised("as `world.junction`", MappingKey("", JunctionKeys(), "Junction.")),
                  "Junctions."),
          ListKey("objects", Summarised("as `world.object`", MappingKey("", PropKeys(), "Object at no road.")),
                  "Objects at no road.")};
}

std::vector<Key> MakeDesignKeys() {
  std::vector<Key> keys{config::WordKey("rule", {"right", "left"}, "right", "Side of traffic.")};
  for (Key& key : SharedKeys()) keys.push_back(std::move(key));
  return keys;
}

}  // namespace

const std::vector<Key>& DesignKeys() {
  static const std::vector<Key> keys = MakeDesignKeys();
  return keys;
}

const Schema& IncludeSchema() {
  static const Schema schema{"world.include", kFormat, "A file that a world file includes.",
                             config::FileKeys(kFormat, SharedKeys())};
  return schema;
}

const Schema& RoadSchema() {
  static const Schema schema{"world.road", kFormat, "A road of a world file.", RoadKeys()};
  return schema;
}

const Schema& JunctionSchema() {
  static const Schema schema{"world.junction", kFormat, "A junction of a world file.", JunctionKeys()};
  return schema;
}

const Schema& ObjectSchema() {
  static const Schema schema{"world.object", kFormat, "An object of a world file at no road.", PropKeys()};
  return schema;
}

const Schema& SectionSchema() {
  static const Schema schema{"world.section", kFormat, "A cross-section of a world file.", SectionKeys()};
  return schema;
}

}  // namespace rodeira::design
