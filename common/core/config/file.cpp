// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "common/core/base/file_kind.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/base/utf8.hpp"
#include "common/core/config/yaml.hpp"

namespace rodeira::config {
namespace {

constexpr std::size_t kSlip = 5;  // 's_m' is as near to 't_m' as any other

const std::set<std::string, std::less<>>& Units() {
  static const std::set<std::string, std::less<>> kUnits = {
      "m",     "cm",  "mm", "km", "ft",  "s",   "ms",  "us",  "ns",   "min", "h",       "kg",   "g",
      "t",     "n",   "kn", "nm", "rad", "deg", "mps", "kmh", "kmph", "kph", "mph",     "mps2", "radps",
      "degps", "rpm", "hz", "w",  "kw",  "hp",  "pa",  "kpa", "bar",  "pct", "percent", "m2",   "kgm2"};
  return kUnits;
}

// 'mass_kg' where 'mass_t' was given: the same quantity in another unit.
bool DifferOnlyByUnit(const std::string& a, const std::string& b) {
  const auto cut_a = a.rfind('_');
  const auto cut_b = b.rfind('_');
  if (cut_a == std::string::npos || cut_b == std::string::npos || a.substr(0, cut_a) != b.substr(0, cut_b))
    return false;
  return Units().contains(a.substr(cut_a + 1)) && Units().contains(b.substr(cut_b + 1));
}

// 'heading_deg' where 'heading' was given.
bool LacksUnit(const std::string& key, const std::string& known) {
  return known.size() > key.size() + 1 && known.starts_with(key + '_') &&
         Units().contains(known.substr(key.size() + 1));
}

constexpr std::size_t kMaxUnknown = 50;  // keys of a mapping that are looked at: a file of another kind has thousands

// What an unknown key was probably meant to be, and the end of the sentence that says so.
struct Meant {
  std::string key;  // empty: nothing is near
  std::string hint;
};

Meant MeantBy(const std::string& key, const std::set<std::string, std::less<>>& asked) {
  const std::vector<std::string> known(asked.begin(), asked.end());
  for (const std::string& other : known) {
    if (DifferOnlyByUnit(other, key)) return {other, fmt::format("; the unit is part of the name: '{}'", other)};
  }
  const std::string nearest = base::NearestName(key, known);
  if (nearest.empty()) {
    for (const std::string& other : known) {
      if (LacksUnit(key, other)) return {other, fmt::format("; the unit is part of the name: '{}'", other)};
    }
  }
  return {nearest, base::DidYouMean(key, known)};
}

void CollectScalars(const YAML::Node& node, std::vector<std::string>& out) {
  if (node.IsScalar()) out.push_back(node.Scalar());
  if (node.IsSequence()) {
    for (const auto& item : node) CollectScalars(item, out);
  }
  if (node.IsMap()) {
    for (const auto& item : node) CollectScalars(item.second, out);
  }
}

// The same value without the lines that it had in its own text: it stands in no line of the file that it is put into.
YAML::Node WithoutLines(const YAML::Node& node) {
  YAML::Node out(node.Type());
  if (node.IsScalar()) out = YAML::Node(node.Scalar());
  if (node.IsSequence()) {
    for (const auto& item : node) out.push_back(WithoutLines(item));
  }
  if (node.IsMap()) {
    for (const auto& item : node) out.force_insert(WithoutLines(item.first), WithoutLines(item.second));
  }
  if (!node.IsNull()) out.SetTag(node.Tag());
  return out;
}

// The first bytes of a regular file; empty where there are none.
std::string BeginOf(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return "";
  std::string begin(4096, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  return begin;
}

}  // namespace

File::File(std::shared_ptr<detail::Context> context) : context_(std::move(context)) {}

base::Result<File> File::Load(const std::filesystem::path& path) {
  auto text = base::ReadText(path, 16u << 20);
  if (!text) {
    const std::string about = base::AboutOtherFormat(BeginOf(path), path);  // a recording is larger than that
    if (about.empty()) return text.error();
    return base::WrongInput("config.not_text", "YAML text was expected; this is " + about, path.string());
  }
  return Parse(text.value(), path);
}

base::Result<File> File::Parse(std::string_view text, const std::filesystem::path& name) {
  auto context = std::make_shared<detail::Context>();
  context->path = name;
  context->text = std::string(text);
  const std::string about = base::AboutOtherFormat(text, name);
  const auto other = [&about] { return about.empty() ? about : "; this is " + about; };
  if (text.find('\0') != std::string_view::npos)
    return base::WrongInput(
        "config.not_text",
        about.empty() ? "the file holds a zero byte; YAML text was expected" : "YAML text was expected" + other(),
        name.string());
  if (const auto at = base::FirstNotUtf8(text)) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(*at), '\n');
    return base::WrongInput(
        "config.not_utf8",
        fmt::format("byte 0x{:02x} is not UTF-8; YAML in UTF-8 was expected{}", static_cast<unsigned char>(text[*at]),
                    about.empty() ? "; save the file as UTF-8" : other()),
        fmt::format("{}:{}", name.string(), line));
  }
  const auto root = LoadYaml(context->text, "this");
  if (!root)
    return root.error()
        .WithMessage(root.error().message + other())
        .WithContext(root.error().context.empty() ? name.string() : name.string() + ":" + root.error().context);
  context->root.reset(root.value());
  if (!context->root.IsMap()) {
    return base::WrongInput(
        "config.not_mapping",
        fmt::format("the file holds {}; a mapping (key: value) was expected{}", KindOf(context->root), other()),
        name.string());
  }
  return File(context);
}

namespace {

bool NamesAFile(const YAML::Node& node) {
  return node.IsScalar() && (node.Scalar().ends_with(".yaml") || node.Scalar().ends_with(".yml"));
}

}  // namespace

base::Status File::Override(std::string_view key, std::string_view value) {
  const std::string where = fmt::format("--set {}={}", key, value);
  const auto leaf = LoadYaml(std::string(value), "the value");
  if (!leaf) return leaf.error().WithContext(where);
  YAML::Node at;
  at.reset(context_->root);
  std::size_t from = 0;
  std::string made;
  for (;;) {
    const std::size_t dot = key.find('.', from);
    const std::string part(key.substr(from, dot == std::string_view::npos ? dot : dot - from));
    if (part.empty()) return base::WrongInput("config.wrong_override", "a key of the form a.b.c was expected", where);
    if (!at.IsMap() && !at.IsNull())
      return base::WrongInput("config.not_mapping",
                              fmt::format("'{}' is {}, no mapping{}", key.substr(0, from == 0 ? 0 : from - 1),
                                          KindOf(at), NamesAFile(at) ? "; change the key in a copy of that file" : ""),
                              where);
    if (made.empty() && (dot == std::string_view::npos || !Find(at, part).IsDefined())) made = key.substr(0, dot);
    if (dot == std::string_view::npos) {
      context_->overrides.push_back({std::string(key), made, where});
      if (leaf.value().IsNull())
        at.remove(part);
      else
        at[part] = WithoutLines(leaf.value());
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
  std::vector<detail::Problem> all = context_->problems, misspelt, strange;
  for (const auto& [place, asked] : context_->keys_read) {
    std::set<std::string> seen;
    for (const auto& item : asked.node) {
      if (!item.first.IsScalar()) {
        all.push_back({LineOf(item.first), "config.wrong_key", "a key is not a scalar", "", asked.path});
        continue;
      }
      const std::string key = item.first.Scalar();
      if (!seen.insert(key).second)
        all.push_back({LineOf(item.first), "config.duplicate_key",
                       fmt::format("key '{}' appears twice", Sub(asked.path, key)), "", Sub(asked.path, key)});
      if (asked.keys.contains(key)) continue;
      if (strange.size() + misspelt.size() >= kMaxUnknown) break;
      std::set<std::string, std::less<>> known = asked.keys;
      known.insert(asked.hoped.begin(), asked.hoped.end());
      known.erase(key);  // it may stand there, but what is wrong elsewhere kept it from being read
      const Meant meant = MeantBy(key, known);
      // Where the mapping is wrong itself its reader may have stopped before this key; only what is long enough
      // to be a slip of the pen is told.
      if (asked.wrong && (meant.key.empty() || key.size() < kSlip)) continue;
      const std::string missing = Sub(asked.path, meant.key);
      if (!meant.key.empty()) std::erase_if(all, [&](const auto& problem) { return problem.missing == missing; });
      (meant.key.empty() ? strange : misspelt)
          .push_back({LineOf(item.first), "config.unknown_key",
                      fmt::format("unknown key '{}'{}", Sub(asked.path, key), meant.hint), "", Sub(asked.path, key)});
    }
  }
  // What is misspelt comes before what is missing in its line, perhaps for that; what no reader asked for behind both,
  // perhaps since something is missing.
  for (auto& problem : misspelt) {
    const auto missing = std::find_if(all.begin(), all.end(), [&](const auto& other) {
      return other.line == problem.line && !other.missing.empty();
    });
    all.insert(missing, std::move(problem));
  }
  all.insert(all.end(), strange.begin(), strange.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  // A file of another kind has its keys: that is said first.
  std::stable_partition(all.begin(), all.end(),
                        [](const auto& problem) { return problem.id == base::ErrorId("config.other_kind"); });
  std::vector<base::Error> errors;
  for (auto& problem : all)
    errors.push_back(base::WrongInput(problem.id, problem.message, PlaceOf(*context_, problem.path, problem.line)));
  return errors;
}

base::Status File::Finish() const {
  const auto problems = Problems();
  if (problems.empty()) return {};
  return problems.front();
}

std::vector<std::string> File::Scalars() const {
  std::vector<std::string> scalars;
  CollectScalars(context_->root, scalars);
  return scalars;
}

const std::string& File::text() const { return context_->text; }
const std::filesystem::path& File::path() const { return context_->path; }

}  // namespace rodeira::config
