// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rodeira::config {
namespace {

// Counts the values of a document as a reader meets them: an alias has those of what it stands for. Throws where an
// alias lies inside of what it stands for, which would have no end, and where aliases make too many.
class AliasCheck final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { AddValue(anchor); }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    AddValue(anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (std::ranges::any_of(open_, [anchor](const Open& one) { return one.anchor == anchor; }))
      throw YAML::ParserException(mark, "an alias refers to a list or mapping that it is part of");
    const auto found = values_.find(anchor);
    const std::size_t values = found == values_.end() ? 1 : found->second;
    count_ += values;
    by_aliases_ += values;
    if (by_aliases_ > kMaxByAliases)
      throw YAML::ParserException(mark, fmt::format("aliases stand for more than {} values", kMaxByAliases));
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Begin(anchor);
  }
  void OnSequenceEnd() override { End(); }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    Begin(anchor);
  }
  void OnMapEnd() override { End(); }

 private:
  static constexpr std::size_t kMaxByAliases = 100'000;
  struct Open {
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::size_t before = 0;  // values, when it began
  };
  void AddValue(YAML::anchor_t anchor) {
    ++count_;
    if (anchor != YAML::NullAnchor) values_[anchor] = 1;
  }
  void Begin(YAML::anchor_t anchor) {
    open_.push_back({anchor, count_});
    ++count_;
  }
  void End() {
    if (open_.back().anchor != YAML::NullAnchor) values_[open_.back().anchor] = count_ - open_.back().before;
    open_.pop_back();
  }

  std::size_t count_ = 0, by_aliases_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, std::size_t> values_;  // by anchor, with those that its aliases stand for
};

// Whether a second document begins somewhere, and where.
struct BeginsAt final : YAML::EventHandler {
  void OnDocumentStart(const YAML::Mark& at) override { mark = at; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
  YAML::Mark mark;
};

void CheckDocument(const std::string& text) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  AliasCheck check;
  if (!parser.HandleNextDocument(check)) return;
  BeginsAt second;
  if (parser.HandleNextDocument(second))
    throw YAML::ParserException(second.mark, "a second document begins here; one was expected");
}

}  // namespace

int LineOf(const YAML::Node& node) { return node.IsDefined() && !node.Mark().is_null() ? node.Mark().line + 1 : 0; }

namespace {

// "a.b" and "a.b[0]" lie within "a.b", and within "a".
bool LiesWithin(std::string_view path, std::string_view key) {
  return path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.' || path[key.size()] == '[');
}

}  // namespace

std::string PlaceOf(const detail::Context& context, const std::string& path, int line) {
  for (auto one = context.overrides.rbegin(); one != context.overrides.rend(); ++one) {
    if (LiesWithin(path, one->key) || (LiesWithin(one->key, path) && LiesWithin(path, one->made))) return one->place;
  }
  return line > 0 ? fmt::format("{}:{}", context.path.string(), line) : context.path.string();
}

std::string KindOf(const YAML::Node& node) {
  if (!node.IsDefined()) return "nothing";
  if (node.IsNull()) return "an empty value";
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  return fmt::format("'{}'", node.Scalar().substr(0, 60));
}

std::optional<double> ToNumber(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [at, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc{} || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> ToInteger(const std::string& text) {
  std::int64_t value = 0;
  const auto [at, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || at != text.data() + text.size()) return std::nullopt;
  return value;
}

namespace {

// The first line, from 1, that is indented by a tab, which YAML does not allow; 0: there is none.
int LineWithTab(std::string_view text) {
  int line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view now = text.substr(at, end - at);
    const std::size_t first = now.find_first_not_of(" \t\r");
    if (first != std::string_view::npos && now[first] != '#' &&
        now.substr(0, first).find('\t') != std::string_view::npos)
      return line;
    at = end + 1;
  }
  return 0;
}

}  // namespace

base::Result<YAML::Node> LoadYaml(const std::string& text, const char* what) {
  const auto failed = [](const std::string& why, const YAML::Mark& mark) {
    return base::WrongInput("config.not_yaml", why, mark.is_null() ? "" : std::to_string(mark.line + 1));
  };
  try {
    CheckDocument(text);
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion&
               problem) {  // the library's own bound: it descends a level of its stack with each level of the text
    return failed(fmt::format("{} is nested too deeply: lists and mappings lie in one another, {} levels are too many",
                              what, problem.depth()),
                  problem.mark);
  } catch (const YAML::Exception& problem) {
    if (const int line = LineWithTab(text); line > 0)
      return base::WrongInput("config.not_yaml",
                              fmt::format("{} is no YAML: a tab indents this line; spaces were expected", what),
                              std::to_string(line));
    return failed(fmt::format("{} is no YAML: {}", what, problem.msg), problem.mark);
  }
}

YAML::Node Find(const YAML::Node& map, std::string_view key) {
  if (!map.IsDefined() || !map.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  for (const auto& item : map) {
    if (item.first.IsScalar() && item.first.Scalar() == key) return item.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

int LineOfKey(const YAML::Node& map, std::string_view key) {
  if (map.IsDefined() && map.IsMap()) {
    for (const auto& item : map) {
      if (item.first.IsScalar() && item.first.Scalar() == key) return LineOf(item.first);
    }
  }
  return LineOf(map);
}

std::string Sub(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

std::string RangeText(Range range) {
  const bool low = range.low > -std::numeric_limits<double>::max();
  const bool high = range.high < std::numeric_limits<double>::max();
  if (low && high) return fmt::format("from {} to {}", range.low, range.high);
  if (low && range.low == std::numeric_limits<double>::min()) return "greater than 0";
  if (low) return fmt::format("at least {}", range.low);
  if (high) return fmt::format("at most {}", range.high);
  return "finite";
}

}  // namespace rodeira::config
