// SPDX-License-Identifier: Apache-2.0
// What of a file OpenDRIVE does not have: elements and attributes with names that it does not know, words that it does
// not allow, elements that may stand once and stand twice. A misspelt name would otherwise be passed over in silence.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/world/opendrive/known_elements.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

bool Holds(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool SameLetters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// Of each kind the first one, and how often.
class Warnings {
 public:
  void Add(const std::string& rule, std::string message, const Node& at) {
    auto [said, fresh] = said_.try_emplace(message, Said{rule, at.line(), 0});
    ++said->second.count;
    if (fresh) order_.push_back(std::move(message));
  }
  void TellTo(Source& source) const {
    for (const std::string& message : order_) {
      const Said& said = said_.at(message);
      const std::string more = said.count == 1 ? "" : fmt::format(" ({} times)", said.count);
      source.warnings.push_back({said.rule, message + more, said.line, "", {}, {}});
    }
  }

 private:
  struct Said {
    std::string rule;
    std::size_t line;
    int count;
  };
  std::map<std::string, Said> said_;
  std::vector<std::string> order_;
};

class Walk {
 public:
  explicit Walk(Source& source) : source_(source) {}

  void Through(const pugi::xml_node& outermost) {
    std::vector<pugi::xml_node> open{outermost};
    while (!open.empty()) {
      const pugi::xml_node node = open.back();
      open.pop_back();
      const KnownElement* known = FindKnown(node.parent().name(), node.name());
      if (known == nullptr) continue;  // told of by the reader of its parent, or not read at all
      Attributes(node, *known);
      Children(node, *known);
      if (std::string_view(node.name()) == "lane") Width(node);
      std::vector<pugi::xml_node> inner;
      for (const pugi::xml_node& child : node.children()) {
        if (child.type() == pugi::node_element) inner.push_back(child);
      }
      open.insert(open.end(), inner.rbegin(), inner.rend());
    }
    warnings_.TellTo(source_);
  }

 private:
  void Attributes(const pugi::xml_node& node, const KnownElement& known) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string name = attribute.name();
      if (name.starts_with("xmlns") || name.find(':') != std::string::npos) continue;  // of XML itself
      if (!Holds(known.attributes, name)) {
        warnings_.Add("not_known",
                      fmt::format("<{}> of <{}> has an attribute '{}', which OpenDRIVE does not know{}", node.name(),
                                  node.parent().name(), name, base::DidYouMean(name, known.attributes)),
                      At(node));
      }
      const auto& words = WordsOf(node.parent().name(), node.name(), name);
      const std::string_view said = attribute.value();
      if (words.empty() ||
          std::any_of(words.begin(), words.end(), [&](const std::string& word) { return SameLetters(word, said); }))
        continue;
      warnings_.Add("not_known",
                    fmt::format("the attribute '{}' of <{}> is '{}'{}", name, node.name(), said,
                                base::DidYouMean(std::string(said), words)),
                    At(node));
    }
  }

  void Children(const pugi::xml_node& node, const KnownElement& known) {
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const std::string name = child.name();
      if (!Holds(known.children, name)) {
        warnings_.Add(
            "not_known",
            fmt::format("OpenDRIVE knows no <{}> of <{}>{}", name, node.name(), base::DidYouMean(name, known.children)),
            At(child));
      } else if (Holds(known.once, name) && child.previous_sibling(child.name())) {
        source_.where.road = RoadOf(node);
        source_.Wrong("core.once",
                      fmt::format("a second <{}> of <{}> was found; at most one was expected", name, node.name()),
                      At(child).line(), {RepairKind::kDuplicateDropped, "the first counts", {At(child).Remove()}});
      }
    }
  }

  static std::string RoadOf(pugi::xml_node node) {
    while (node && std::string_view(node.name()) != "road") node = node.parent();
    return node.attribute("id").value();
  }

  // A lane beside the centre one that nothing gives a width: it is as good as not there.
  void Width(const pugi::xml_node& lane) {
    if (std::string_view(lane.parent().name()) == "center" || lane.child("width") || lane.child("border")) return;
    warnings_.Add("road.lane.width.missing",
                  fmt::format("a lane of type '{}' has neither <width> nor <border>: it is read as 0 m wide",
                              lane.attribute("type").value()),
                  At(lane));
  }

  Node At(const pugi::xml_node& node) { return {&source_, node}; }

  Source& source_;
  Warnings warnings_;
};

}  // namespace

void TellUnknown(const Node& root) { Walk(root.source()).Through(root.xml()); }

}  // namespace rodeira::opendrive
