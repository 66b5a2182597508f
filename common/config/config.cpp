#include "common/config/config.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "common/base/files.hpp"
#include "common/base/suggest.hpp"

namespace rodeira::config {

namespace detail {

struct YamlNode {
  YAML::Node node;  // may be null (absent)
  bool present = true;
};

struct Context {
  std::filesystem::path path;
  std::string text;
  YAML::Node root;
  std::vector<std::pair<int, std::string>> problems;  // line (1-based, 0: no place), message
  // Which keys of which mapping were asked for; the mapping is named by its mark in the text.
  struct Asked {
    YAML::Node node;
    std::string path;
    std::set<std::string, std::less<>> keys;
  };
  std::map<std::pair<int, std::string>, Asked> asked;

  void Add(int line, std::string message) { problems.emplace_back(line, std::move(message)); }
};

}  // namespace detail

namespace {

int LineOf(const YAML::Node& node) { return node.IsDefined() && !node.Mark().is_null() ? node.Mark().line + 1 : 0; }

std::string PlaceOf(const detail::Context& context, int line) {
  return line > 0 ? fmt::format("{}:{}", context.path.string(), line) : context.path.string();
}

std::string KindOf(const YAML::Node& node) {
  if (!node.IsDefined()) return "nothing";
  if (node.IsNull()) return "an empty value";
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  return fmt::format("'{}'", node.Scalar().substr(0, 60));
}

// Whole-text conversions: what std::from_chars takes, with nothing left over. Decimal point, no locale.
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

// The first document of a text, which `what` names in a sentence. The error's context is the line, where there is one.
base::Result<YAML::Node> LoadYaml(const std::string& text, const char* what) {
  const auto failed = [](const std::string& why, const YAML::Mark& mark) {
    return base::WrongInput(why, mark.is_null() ? "" : std::to_string(mark.line + 1));
  };
  try {
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& problem) {  // the library's own bound: it descends a level of its stack with each level of the text
    return failed(fmt::format("{} is nested too deeply: lists and mappings lie in one another, {} levels are too many", what, problem.depth()), problem.mark);
  } catch (const YAML::Exception& problem) {
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

std::string Sub(const std::string& path, std::string_view key) { return path.empty() ? std::string(key) : path + "." + std::string(key); }

std::string RangeText(Range range) {
  const bool low = range.low > -std::numeric_limits<double>::max();
  const bool high = range.high < std::numeric_limits<double>::max();
  if (low && high) return fmt::format("from {} to {}", range.low, range.high);
  if (low && range.low == std::numeric_limits<double>::min()) return "greater than 0";
  if (low) return fmt::format("at least {}", range.low);
  if (high) return fmt::format("at most {}", range.high);
  return "finite";
}

// 'mass_kg' where 'mass_t' was given: the same quantity in another unit.
bool DifferOnlyByUnit(const std::string& a, const std::string& b) {
  static const std::set<std::string, std::less<>> kUnits = {
      "m",  "cm", "mm", "km", "ft", "s",  "ms", "us",  "ns",  "min", "h",   "kg",  "g",  "t",  "n",  "kn",  "nm",  "rad",   "deg",
      "mps", "kmh", "kmph", "kph", "mph", "mps2", "radps", "degps", "rpm", "hz", "w", "kw", "hp", "pa", "kpa", "bar", "pct", "percent", "m2", "kgm2"};
  const auto cut_a = a.rfind('_');
  const auto cut_b = b.rfind('_');
  if (cut_a == std::string::npos || cut_b == std::string::npos || a.substr(0, cut_a) != b.substr(0, cut_b)) return false;
  return kUnits.contains(a.substr(cut_a + 1)) && kUnits.contains(b.substr(cut_b + 1));
}

}  // namespace

Map::Map(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path)
    : context_(std::move(context)), node_(std::move(node)), path_(std::move(path)) {
  if (node_->present && node_->node.IsMap()) {
    auto& asked = context_->asked[{LineOf(node_->node), path_}];
    asked.node = node_->node;
    asked.path = path_;
  }
}

bool Map::Has(std::string_view key) const { return node_->present && Find(node_->node, key).IsDefined(); }

std::string Map::Place() const { return PlaceOf(*context_, node_->present ? LineOf(node_->node) : 0); }

std::string Map::Place(std::string_view key) const {
  return PlaceOf(*context_, node_->present ? LineOfKey(node_->node, key) : 0);
}

void Map::Problem(std::string_view key, std::string message) const {
  context_->Add(node_->present ? LineOfKey(node_->node, key) : 0, std::move(message));
}

template <class T>
std::optional<T> Map::Scalar(std::string_view key, bool required, std::string_view expected) const {
  if (node_->present && node_->node.IsMap()) context_->asked[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  if (!found.IsDefined()) {
    if (required && node_->present) Problem(key, fmt::format("key '{}' is missing; {} was expected", Sub(path_, key), expected));
    return std::nullopt;
  }
  std::optional<T> value;
  if (found.IsScalar()) {
    if constexpr (std::is_same_v<T, double>) value = ToNumber(found.Scalar());
    else if constexpr (std::is_same_v<T, std::int64_t>) value = ToInteger(found.Scalar());
    else if constexpr (std::is_same_v<T, bool>) {
      if (found.Scalar() == "true") value = true;
      if (found.Scalar() == "false") value = false;
    } else {
      value = found.Scalar();
    }
  }
  if (!value) Problem(key, fmt::format("'{}' is {}; {} was expected", Sub(path_, key), KindOf(found), expected));
  return value;
}

std::optional<double> Map::Checked(std::string_view key, std::optional<double> value, Range range) const {
  if (value && !(*value >= range.low && *value <= range.high)) {
    Problem(key, fmt::format("'{}' is {}; a number {} was expected", Sub(path_, key), *value, RangeText(range)));
  }
  return value;
}

double Map::Number(std::string_view key, Range range) const {
  return Checked(key, Scalar<double>(key, true, "a number"), range).value_or(std::clamp(0.0, range.low, range.high));
}
double Map::Number(std::string_view key, Range range, double otherwise) const {
  return Checked(key, Scalar<double>(key, false, "a number"), range).value_or(otherwise);
}

std::int64_t Map::Integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  if (!Has(key)) {
    (void)Scalar<std::int64_t>(key, true, fmt::format("a whole number from {} to {}", low, high));
    return low;
  }
  return Integer(key, low, high, low);
}
std::int64_t Map::Integer(std::string_view key, std::int64_t low, std::int64_t high, std::int64_t otherwise) const {
  const std::string expected = fmt::format("a whole number from {} to {}", low, high);
  const auto value = Scalar<std::int64_t>(key, false, expected);
  if (value && (*value < low || *value > high)) Problem(key, fmt::format("'{}' is {}; {} was expected", Sub(path_, key), *value, expected));
  return std::clamp(value.value_or(otherwise), low, high);
}

bool Map::Flag(std::string_view key, bool otherwise) const {
  return Scalar<bool>(key, false, "true or false").value_or(otherwise);
}

std::string Map::Text(std::string_view key) const { return Scalar<std::string>(key, true, "a text").value_or(""); }
std::string Map::Text(std::string_view key, std::string_view otherwise) const {
  return Scalar<std::string>(key, false, "a text").value_or(std::string(otherwise));
}

std::string Map::Choice(std::string_view key, const std::vector<std::string>& allowed) const {
  if (!Has(key)) {
    (void)Scalar<std::string>(key, true, fmt::format("one of {}", fmt::join(allowed, ", ")));
    return allowed.front();
  }
  return Choice(key, allowed, allowed.front());
}
std::string Map::Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view otherwise) const {
  const auto value = Scalar<std::string>(key, false, "a word");
  if (!value) return std::string(otherwise);
  if (std::find(allowed.begin(), allowed.end(), *value) == allowed.end()) {
    Problem(key, fmt::format("'{}' is '{}'{}", Sub(path_, key), *value, base::DidYouMean(*value, allowed)));
    return std::string(otherwise);
  }
  return *value;
}

std::filesystem::path Map::Path(std::string_view key) const {
  const std::string text = Text(key);
  return text.empty() ? std::filesystem::path() : (context_->path.parent_path() / text).lexically_normal();
}
std::optional<std::filesystem::path> Map::OptionalPath(std::string_view key) const {
  const auto text = Scalar<std::string>(key, false, "a path");
  if (!text) return std::nullopt;
  return (context_->path.parent_path() / *text).lexically_normal();
}

std::vector<double> Map::Numbers(std::string_view key, Range range) const {
  std::vector<double> values;
  const List list = Items(key);
  for (std::size_t i = 0; i < list.size(); ++i) values.push_back(list.Number(i, range));
  return values;
}

Map Map::OptionalChild(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->asked[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  const bool present = found.IsDefined() && found.IsMap();
  if (found.IsDefined() && !present) Problem(key, fmt::format("'{}' is {}; a mapping was expected", Sub(path_, key), KindOf(found)));
  auto child = std::make_shared<detail::YamlNode>();
  if (present) child->node.reset(found);
  child->present = present;
  return Map(context_, child, Sub(path_, key));
}
Map Map::Child(std::string_view key) const {
  if (node_->present && !Has(key)) Problem(key, fmt::format("key '{}' is missing; a mapping was expected", Sub(path_, key)));
  return OptionalChild(key);
}

List Map::OptionalItems(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->asked[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  const bool present = found.IsDefined() && found.IsSequence();
  if (found.IsDefined() && !present) Problem(key, fmt::format("'{}' is {}; a list was expected", Sub(path_, key), KindOf(found)));
  auto child = std::make_shared<detail::YamlNode>();
  if (present) child->node.reset(found);
  child->present = present;
  return List(context_, child, Sub(path_, key));
}
List Map::Items(std::string_view key) const {
  if (node_->present && !Has(key)) Problem(key, fmt::format("key '{}' is missing; a list was expected", Sub(path_, key)));
  return OptionalItems(key);
}

void Map::LeaveToOthers(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->asked[{LineOf(node_->node), path_}].keys.emplace(key);
}

std::optional<std::string> Map::Peek(std::initializer_list<std::string_view> way) const {
  if (!node_->present) return std::nullopt;
  YAML::Node node;
  node.reset(node_->node);
  for (const std::string_view key : way) node.reset(Find(node, key));
  if (!node.IsDefined() || !node.IsScalar()) return std::nullopt;
  return node.Scalar();
}

std::vector<std::string> Map::Keys() const {
  std::vector<std::string> keys;
  if (!node_->present || !node_->node.IsMap()) return keys;
  for (const auto& item : node_->node) {
    if (!item.first.IsScalar()) continue;
    keys.push_back(item.first.Scalar());
    context_->asked[{LineOf(node_->node), path_}].keys.insert(item.first.Scalar());
  }
  return keys;
}

List::List(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path)
    : context_(std::move(context)), node_(std::move(node)), path_(std::move(path)) {}

std::size_t List::size() const { return node_->present ? node_->node.size() : 0; }

std::string List::Place(std::size_t index) const { return PlaceOf(*context_, index < size() ? LineOf(node_->node[index]) : 0); }

void List::Problem(std::size_t index, std::string message) const {
  context_->Add(index < size() ? LineOf(node_->node[index]) : 0, std::move(message));
}

Map List::At(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  auto child = std::make_shared<detail::YamlNode>();
  child->present = found.IsMap();
  if (child->present) child->node.reset(found);
  else Problem(index, fmt::format("item {} of '{}' is {}; a mapping was expected", index + 1, path_, KindOf(found)));
  return Map(context_, child, fmt::format("{}[{}]", path_, index));
}

double List::Number(std::size_t index, Range range) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  const auto value = found.IsScalar() ? ToNumber(found.Scalar()) : std::nullopt;
  if (!value || !(*value >= range.low && *value <= range.high)) {
    Problem(index, fmt::format("item {} of '{}' is {}; a number {} was expected", index + 1, path_, KindOf(found), RangeText(range)));
  }
  return value.value_or(std::clamp(0.0, range.low, range.high));
}

std::string List::Text(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  if (found.IsScalar()) return found.Scalar();
  Problem(index, fmt::format("item {} of '{}' is {}; a text was expected", index + 1, path_, KindOf(found)));
  return {};
}

std::vector<double> List::Numbers(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  std::vector<double> values;
  if (!found.IsSequence()) {
    Problem(index, fmt::format("item {} of '{}' is {}; a list of numbers was expected", index + 1, path_, KindOf(found)));
    return values;
  }
  for (const auto& item : found) {
    const auto value = item.IsScalar() ? ToNumber(item.Scalar()) : std::nullopt;
    if (!value) context_->Add(LineOf(item), fmt::format("'{}[{}]' holds {}; numbers were expected", path_, index, KindOf(item)));
    values.push_back(value.value_or(0.0));
  }
  return values;
}

File::File(std::shared_ptr<detail::Context> context) : context_(std::move(context)) {}

base::Result<File> File::Load(const std::filesystem::path& path) {
  auto text = base::ReadText(path, 16u << 20);
  if (!text) return text.error();
  return Parse(text.value(), path);
}

base::Result<File> File::Parse(std::string_view text, const std::filesystem::path& name) {
  auto context = std::make_shared<detail::Context>();
  context->path = name;
  context->text = std::string(text);
  if (text.find('\0') != std::string_view::npos) return base::WrongInput("the file holds a zero byte; YAML text was expected", name.string());
  const auto root = LoadYaml(context->text, "this");
  if (!root) return base::WrongInput(root.error().message, root.error().context.empty() ? name.string() : name.string() + ":" + root.error().context);
  context->root.reset(root.value());
  if (!context->root.IsMap()) {
    return base::WrongInput(fmt::format("the file holds {}; a mapping (key: value) was expected", KindOf(context->root)), name.string());
  }
  return File(context);
}

base::Status File::Override(std::string_view key, std::string_view value) {
  const std::string where = fmt::format("--set {}={}", key, value);
  const auto leaf = LoadYaml(std::string(value), "the value");
  if (!leaf) return base::WrongInput(leaf.error().message, where);
  YAML::Node at;
  at.reset(context_->root);
  std::size_t from = 0;
  for (;;) {
    const std::size_t dot = key.find('.', from);
    const std::string part(key.substr(from, dot == std::string_view::npos ? dot : dot - from));
    if (part.empty()) return base::WrongInput("a key of the form a.b.c was expected", where);
    if (!at.IsMap() && !at.IsNull()) return base::WrongInput(fmt::format("'{}' is {}, no mapping", key.substr(0, from == 0 ? 0 : from - 1), KindOf(at)), where);
    if (dot == std::string_view::npos) {
      at[part] = leaf.value();
      return {};
    }
    if (!Find(at, part).IsDefined()) at[part] = YAML::Node(YAML::NodeType::Map);
    YAML::Node next;
    next.reset(at[part]);
    at.reset(next);
    from = dot + 1;
  }
}

Map File::root() const {
  auto node = std::make_shared<detail::YamlNode>();
  node->node.reset(context_->root);
  return Map(context_, node, "");
}

std::vector<base::Error> File::Problems() const {
  std::vector<std::pair<int, std::string>> all = context_->problems;
  for (const auto& [place, asked] : context_->asked) {
    const std::vector<std::string> known(asked.keys.begin(), asked.keys.end());
    std::set<std::string> seen;
    for (const auto& item : asked.node) {
      if (!item.first.IsScalar()) {
        all.emplace_back(LineOf(item.first), "a key is no plain word");
        continue;
      }
      const std::string key = item.first.Scalar();
      if (!seen.insert(key).second) all.emplace_back(LineOf(item.first), fmt::format("key '{}' stands twice", Sub(asked.path, key)));
      if (asked.keys.contains(key)) continue;
      std::string hint = base::DidYouMean(key, known);
      for (const std::string& other : known) {
        if (DifferOnlyByUnit(other, key)) hint = fmt::format("; the unit is part of the name: '{}'", other);
      }
      all.emplace_back(LineOf(item.first), fmt::format("unknown key '{}'{}", Sub(asked.path, key), hint));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<base::Error> errors;
  for (auto& [line, message] : all) errors.push_back(base::WrongInput(message, PlaceOf(*context_, line)));
  return errors;
}

base::Status File::Finish() const {
  const auto problems = Problems();
  if (problems.empty()) return {};
  return problems.front();
}

const std::string& File::text() const { return context_->text; }
const std::filesystem::path& File::path() const { return context_->path; }

}  // namespace rodeira::config
