// SPDX-License-Identifier: Apache-2.0
// What of a file is passed over: each kind is said once.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

// An element, or an attribute, of another element.
struct Unread {
  std::string_view parent, name;
  bool attribute;
};
// Why each of them is not, stands in docs/decisions/0023-what-is-not-read.md.
constexpr std::array<Unread, 24> kUnread = {{
    {"object", "surface", false},
    {"object", "perpToRoad", true},
    {"outline", "laneType", true},
    {"tunnel", "lighting", true},
    {"tunnel", "daylight", true},
    {"tunnel", "validity", false},
    {"bridge", "validity", false},
    {"signal", "reference", false},
    {"sign", "reference", false},
    {"semantics", "speed", false},
    {"semantics", "lane", false},
    {"semantics", "prohibited", false},
    {"lane", "rule", false},
    {"lane", "advisory", true},
    {"lane", "dynamicLaneDirection", true},
    {"lane", "dynamicLaneType", true},
    {"lane", "roadWorks", true},
    {"connection", "predecessor", false},
    {"connection", "successor", false},
    {"junction", "surface", false},
    {"road", "railroad", false},
    {"header", "defaultRegulations", false},
    {"OpenDRIVE", "junctionGroup", false},
    {"OpenDRIVE", "station", false},
}};

// An attribute that is there and not "no".
bool Says(const pugi::xml_attribute& attribute) {
  const std::string_view value = attribute.value();
  return attribute && !value.empty() && value != "false" && value != "no" && value != "none" && value != "0";
}

bool IsOfGroups(std::string_view name) { return name == "railroad" || name == "station" || name == "junctionGroup"; }

struct Walker final : pugi::xml_tree_walker {
  std::array<std::size_t, kUnread.size()> count{};
  std::array<pugi::xml_node, kUnread.size()> first;

  bool for_each(pugi::xml_node& node) override {
    const std::string_view name = node.name(), parent = node.parent().name();
    for (std::size_t i = 0; i < kUnread.size(); ++i) {
      const Unread& unread = kUnread[i];
      const bool here = unread.attribute ? name == unread.parent && Says(node.attribute(unread.name.data()))
                                         : name == unread.name && parent == unread.parent;
      if (here && count[i]++ == 0) first[i] = node;
    }
    return true;
  }
};

}  // namespace

void TellIncludes(const Node& root) {
  struct Finder final : pugi::xml_tree_walker {
    std::vector<pugi::xml_node> found;
    bool for_each(pugi::xml_node& node) override {
      if (std::string_view(node.name()) == "include") found.push_back(node);
      return true;
    }
  } finder;
  pugi::xml_node(root.xml()).traverse(finder);
  for (const pugi::xml_node& include : finder.found) {
    const Node node(&root.source(), include);
    const std::string file = include.attribute("file").value();
    const std::string why = root.source().WhyUnread(file);
    node.Wrong("core.include",
               file.empty()
                   ? std::string("<include> names no file")
                   : fmt::format("'{}', which <include> names, is not read{}{}", file, why.empty() ? "" : ": ", why),
               {RepairKind::kElementDropped, "it is left out", {node.Remove()}, "include"});
  }
}

void TellUnread(const Node& root) {
  Walker walker;
  pugi::xml_node node = root.xml();
  node.traverse(walker);
  std::string groups;  // trains, and what groups junctions: one sentence for all
  std::size_t first_group = 0;
  for (std::size_t i = 0; i < kUnread.size(); ++i) {
    if (walker.count[i] == 0) continue;
    const Unread& unread = kUnread[i];
    const std::string more = walker.count[i] == 1 ? "" : fmt::format(" ({} times)", walker.count[i]);
    if (IsOfGroups(unread.name)) {
      groups += fmt::format("{}<{}> of <{}>{}", groups.empty() ? "" : ", ", unread.name, unread.parent, more);
      const std::size_t line = Node(&root.source(), walker.first[i]).line();
      first_group = first_group == 0 ? line : std::min(first_group, line);
      continue;
    }
    const std::string what = unread.attribute ? fmt::format("the attribute '{}' of <{}>", unread.name, unread.parent)
                                              : fmt::format("<{}> of <{}>", unread.name, unread.parent);
    root.source().warnings.push_back({"not_read",
                                      fmt::format("{} is not read{}", what, more),
                                      Node(&root.source(), walker.first[i]).line(),
                                      "",
                                      {},
                                      {}});
  }
  if (!groups.empty()) {
    root.source().warnings.push_back({"not_read",
                                      fmt::format("railways and groups of junctions are not read: {}", groups),
                                      first_group,
                                      "",
                                      {},
                                      {}});
  }
}

}  // namespace rodeira::opendrive
