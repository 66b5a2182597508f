// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numeric>

#include "common/core/base/nearest_file.hpp"

namespace rodeira::opendrive {
namespace {

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

constexpr double kLargest = 1e15;
// A record that is in force for 1e-15 m may have such a coefficient; its values are what CheckMeasures bounds.
constexpr double kLargestCoefficient = 1e60;

// A whole text that is a finite number of at most `most`.
std::optional<double> NumberOf(std::string_view text, double most) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (text.empty() || result.ptr != end) return std::nullopt;
  // Underflow is a number all the same.
  if (result.ec == std::errc::result_out_of_range)
    return text.find("e-") == std::string_view::npos ? std::nullopt : std::optional(0.0);
  if (!std::isfinite(value) || std::fabs(value) > most) return std::nullopt;
  return value;
}

bool Same(const geometry::Cubic& x, const geometry::Cubic& y) {
  return x.a == y.a && x.b == y.b && x.c == y.c && x.d == y.d;
}

// The number that a text with a slip begins with: with a decimal comma, an exponent without its letter ("1.5+3"), or
// something behind it ("3.5m"). Empty: it begins with none.
std::string MeantNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto length = static_cast<std::size_t>(result.ptr - text.data());
  if (result.ec != std::errc() || length == 0 || !std::isfinite(value)) return {};
  std::string meant(text.substr(0, length));
  const std::string_view rest = text.substr(length);
  const auto digits = [](std::string_view of) {
    return !of.empty() && of.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (rest.size() > 1 && digits(rest.substr(1))) {
    if (rest[0] == ',' && meant.find_first_of(".eE") == std::string::npos)
      return meant + "." + std::string(rest.substr(1));
    if ((rest[0] == '+' || rest[0] == '-') && meant.find('.') != std::string::npos &&
        meant.find_first_of("eE") == std::string::npos)
      return meant + "e" + std::string(rest);
  }
  return meant;
}

}  // namespace

std::string Repair::Name() const { return element.empty() ? std::string(NameOf(kind)) : element + ".dropped"; }

std::string Finding::Text() const {
  std::string place;
  const auto add = [&place](std::string more) { place += (place.empty() ? "" : ", ") + more; };
  if (!road.empty()) add(fmt::format("road {}", road));
  if (lane) add(fmt::format("lane {}", *lane));
  if (s_m) add(fmt::format("s {:.6g}", *s_m));
  return fmt::format("{}: {}{}{}{}{}", rule, place, place.empty() ? "" : ": ", message,
                     repair.done.empty() ? "" : "; repaired: ", repair.done);
}

std::vector<std::size_t> LineStarts(std::string_view text) {
  std::vector<std::size_t> starts{0};
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') starts.push_back(at + 1);
  }
  return starts;
}

base::Result<std::unique_ptr<Source>> Source::Parse(std::string text, const std::filesystem::path& path,
                                                    const Edited* edited) {
  std::unique_ptr<Source> source(new Source());
  source->text_ = std::move(text);
  source->edited_ = edited;
  source->line_starts_ = edited != nullptr ? edited->line_starts : LineStarts(source->text_);
  const auto result = source->document_.load_buffer(source->text_.data(), source->text_.size(), pugi::parse_default,
                                                    pugi::encoding_utf8);
  if (!result) {
    return base::WrongInput("opendrive.not_xml", fmt::format("this is no XML: {}", result.description()),
                            fmt::format("{}:{}", path.string(), source->LineAt(result.offset)));
  }
  return source;
}

std::size_t Source::LineAt(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  auto at = static_cast<std::size_t>(offset);
  if (edited_ != nullptr) {
    for (auto map = edited_->maps.rbegin(); map != edited_->maps.rend(); ++map) at = map->Before(at);
  }
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
  return static_cast<std::size_t>(after - line_starts_.begin());
}

std::string Source::WhyUnread(const std::string& include) const {
  if (edited_ == nullptr) return "";
  const auto found = edited_->unread.find(include);
  return found == edited_->unread.end() ? "" : found->second;
}

void Source::PassOverTemporaryLanes() {
  std::size_t count = 0, line = 0;
  for (pugi::xml_node road : document_.document_element().children("road")) {
    const auto is_temporary = [](const pugi::xml_node& lanes) {
      return std::string_view(lanes.attribute("layer").value()) == "temporary";
    };
    std::vector<pugi::xml_node> temporary;
    bool has_other = false;
    for (const pugi::xml_node lanes : road.children("lanes")) {
      if (is_temporary(lanes))
        temporary.push_back(lanes);
      else
        has_other = true;
    }
    if (!has_other) continue;  // lanes that come and go are better than none
    for (const pugi::xml_node& lanes : temporary) {
      if (count++ == 0) line = LineAt(lanes.offset_debug());
      road.remove_child(lanes);
    }
  }
  if (count == 0) return;
  warnings.push_back(
      {"not_read",
       fmt::format("<lanes> of the layer 'temporary' are not read{}: those of the layer 'permanent' count",
                   count == 1 ? "" : fmt::format(" ({} times)", count)),
       line,
       "",
       {},
       {}});
}

void Source::Wrong(std::string_view rule, std::string message, std::size_t line, Repair repair) {
  if (errors.size() < most_findings)
    errors.push_back(
        {std::string(rule), std::move(message), line, where.road, where.lane, where.s_m, std::move(repair)});
}

std::size_t Node::line() const { return source_->LineAt(node_.offset_debug()); }

void Node::Wrong(std::string_view rule, std::string message) const { Wrong(rule, std::move(message), TakeOut(*this)); }

void Node::Wrong(std::string_view rule, std::string message, Repair repair) const {
  source_->Wrong(rule, std::move(message), line(), std::move(repair));
}

std::string_view Node::Text() const {
  return source_->text().substr(Begin(), ElementEnd(source_->text(), Begin()) - Begin());
}
Edit Node::Remove() const { return Replace(""); }
Edit Node::Replace(std::string text) const { return {Begin(), ElementEnd(source_->text(), Begin()), std::move(text)}; }
Edit Node::Set(std::string_view attribute, std::string_view value) const {
  return SetAttribute(source_->text(), Begin(), attribute, value);
}
Edit Node::Insert(std::string_view xml) const {
  const std::size_t tag = TagEnd(source_->text(), Begin());
  return {tag, tag, std::string(xml)};
}
Edit Node::Append(std::string_view xml) const { return AppendChild(source_->text(), Begin(), xml); }

Repair TakeOut(const Node& node) {
  constexpr std::array<std::string_view, 13> kNeeded = {"planView", "geometry",   "line",  "arc",         "spiral",
                                                        "poly3",    "paramPoly3", "lanes", "laneSection", "left",
                                                        "center",   "right",      "lane"};
  pugi::xml_node at = node.xml();
  for (const char* curve : {"arc", "spiral", "poly3", "paramPoly3"}) {
    const Node kind = std::string_view(at.name()) == curve ? node : node.Child(curve);
    if (kind && std::string_view(kind.xml().parent().name()) == "geometry")
      return {RepairKind::kReadAsLine, "it is read as a line", {kind.Replace("<line/>")}};
  }
  while (at && std::find(kNeeded.begin(), kNeeded.end(), std::string_view(at.name())) != kNeeded.end())
    at = at.parent();
  if (std::string_view(at.name()) == "junction" && at != node.xml()) at = at.child("planView");
  const std::string_view name = at.name();
  if (name == "header") return {RepairKind::kHeaderIgnored, "it is passed over"};
  if (!at || name == "OpenDRIVE") return {};
  const Node taken(&node.source(), at);
  if (name == "road") return {RepairKind::kRoadLeftOut, kLeftOut, {taken.Remove()}};
  return {RepairKind::kElementDropped, fmt::format("<{}> is passed over", name), {taken.Remove()}, std::string(name)};
}

std::vector<Edit> Reorder(const std::vector<Node>& nodes, const std::vector<std::size_t>& order) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (order[i] != i) edits.push_back(nodes[i].Replace(std::string(nodes[order[i]].Text())));
  }
  return edits;
}

std::optional<double> Node::Read(const char* attribute, double most) const {
  const pugi::xml_attribute found = node_.attribute(attribute);
  if (!found) return std::nullopt;
  const std::string_view text = Trimmed(found.value());
  if (const auto value = NumberOf(text, most)) return *value;
  std::string message =
      fmt::format("attribute '{}' of <{}> is '{}'; a number was expected", attribute, name(), found.value());
  const std::string meant = MeantNumber(text);
  if (meant.empty() || !NumberOf(meant, most))
    Wrong("xml.attribute", std::move(message));
  else
    Wrong("xml.attribute", std::move(message),
          {RepairKind::kValueReplaced, fmt::format("it is read as {}", meant), {Set(attribute, meant)}});
  return 0.0;
}

double Node::Number(const char* attribute) const {
  const auto value = Read(attribute, kLargest);
  if (!value) Wrong("xml.attribute", fmt::format("<{}> has no attribute '{}'", name(), attribute));
  return value.value_or(0.0);
}

double Node::Number(const char* attribute, double default_value) const {
  return Read(attribute, kLargest).value_or(default_value);
}

int Node::Integer(const char* attribute) const {
  const double value = Number(attribute);
  if (value != std::floor(value) || std::fabs(value) > 1e6) {
    Wrong("xml.attribute", fmt::format("attribute '{}' of <{}> is '{}'; a whole number was expected", attribute, name(),
                                       node_.attribute(attribute).value()));
    return 0;
  }
  return static_cast<int>(value);
}

std::string Node::Text(const char* attribute) const {
  std::string text = node_.attribute(attribute).value();
  if (text.empty()) Wrong("xml.attribute", fmt::format("<{}> has no attribute '{}'", name(), attribute));
  return text;
}

std::string Node::Text(const char* attribute, std::string_view default_value) const {
  return Has(attribute) ? node_.attribute(attribute).value() : std::string(default_value);
}

bool Node::Flag(const char* attribute, bool default_value) const {
  if (!Has(attribute)) return default_value;
  const std::string_view text = Trimmed(node_.attribute(attribute).value());
  for (const std::string_view yes : {"true", "1", "yes"}) {
    if (text == yes) return true;
  }
  for (const std::string_view no : {"false", "0", "no", ""}) {
    if (text == no) return false;
  }
  Wrong("xml.attribute",
        fmt::format("attribute '{}' of <{}> is '{}'; true or false was expected", attribute, name(), text));
  return default_value;
}

geometry::Cubic Node::Cubic(const char* from, double origin) const {
  const auto coefficient = [&](const char* name) { return Read(name, kLargestCoefficient).value_or(0.0); };
  return {origin + Number(from), Number("a"), coefficient("b"), coefficient("c"), coefficient("d")};
}

std::vector<Node> Node::Children(const char* element) const {
  std::vector<Node> children;
  for (const pugi::xml_node child : node_.children(element)) children.emplace_back(source_, child);
  return children;
}

namespace {

constexpr double kStationRounding = 1e-6;  // comes from the digits of a file; m

void WarnOfTwo(const Node& record, std::string_view rule, const char* from, double s_m) {
  Source& source = record.source();
  source.warnings.push_back({std::string(rule),
                             fmt::format("another <{}> with other numbers has the {} {:.6g}, too: the later one counts",
                                         record.name(), from, record.xml().attribute(from).as_double()),
                             record.line(), source.where.road, source.where.lane, s_m});
}

}  // namespace

geometry::CubicTable ReadCubics(const std::vector<Node>& records, const char* from, double origin,
                                std::string_view rule) {
  std::vector<geometry::Cubic> cubics;
  std::optional<std::size_t> behind;  // the first that stands behind a later one
  for (const Node& record : records) {
    cubics.push_back(record.Cubic(from, origin));
    if (cubics.size() > 1 && cubics.back().from < cubics[cubics.size() - 2].from && !behind) behind = cubics.size() - 1;
  }
  std::vector<std::size_t> order(cubics.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cubics[a].from < cubics[b].from; });
  if (behind) {
    const Node& record = records[*behind];
    Within within(record.source());
    record.source().where.s_m = cubics[*behind].from;
    Repair repair{RepairKind::kSorted, fmt::format("they are read in the order of {}", from), Reorder(records, order)};
    // Both at one place but for rounding: the one written later counts, as of two with the same digits.
    for (std::size_t i = 0; i < *behind; ++i) {
      if (!(cubics[i].from > cubics[*behind].from && cubics[i].from - cubics[*behind].from <= kStationRounding))
        continue;
      repair = {RepairKind::kDuplicateDropped, "of those at one place the last counts", {records[i].Remove()}};
      break;
    }
    record.Wrong(rule,
                 fmt::format("<{}> with {} {:.6g} stands behind one with a larger {}; ascending order was expected",
                             record.name(), from, record.Number(from), from),
                 std::move(repair));
  }
  std::vector<geometry::Cubic> table;  // of those at one place the last
  for (const std::size_t i : order) {
    if (!table.empty() && table.back().from == cubics[i].from) {
      if (!Same(table.back(), cubics[i])) WarnOfTwo(records[i], rule, from, cubics[i].from);
      table.pop_back();
    }
    table.push_back(cubics[i]);
  }
  return geometry::CubicTable(std::move(table));
}

}  // namespace rodeira::opendrive
