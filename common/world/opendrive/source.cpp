// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

namespace rodeira::opendrive {
namespace {

constexpr std::size_t kMostFindings = 1000;

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace

std::string Finding::Text() const {
  std::string place;
  const auto add = [&place](std::string more) { place += (place.empty() ? "" : ", ") + more; };
  if (!road.empty()) add(fmt::format("road {}", road));
  if (lane) add(fmt::format("lane {}", *lane));
  if (s_m) add(fmt::format("s {:.6g}", *s_m));
  return fmt::format("{}: {}{}{}", rule, place, place.empty() ? "" : ": ", message);
}

base::Result<std::unique_ptr<Source>> Source::Parse(std::string text, const std::filesystem::path& path) {
  std::unique_ptr<Source> source(new Source());
  source->text_ = std::move(text);
  source->line_starts_.push_back(0);
  for (std::size_t at = 0; at < source->text_.size(); ++at) {
    if (source->text_[at] == '\n') source->line_starts_.push_back(at + 1);
  }
  const auto result = source->document_.load_buffer(source->text_.data(), source->text_.size(), pugi::parse_default,
                                                    pugi::encoding_utf8);
  if (!result) {
    return base::WrongInput(fmt::format("this is no XML: {}", result.description()),
                            fmt::format("{}:{}", path.string(), source->LineAt(result.offset)));
  }
  return source;
}

std::size_t Source::LineAt(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), static_cast<std::size_t>(offset));
  return static_cast<std::size_t>(after - line_starts_.begin());
}

void Source::Wrong(std::string_view rule, std::string message, std::size_t line) {
  if (errors.size() < kMostFindings)
    errors.push_back({std::string(rule), std::move(message), line, where.road, where.lane, where.s_m});
}

std::size_t Node::line() const { return source_->LineAt(node_.offset_debug()); }

void Node::Wrong(std::string_view rule, std::string message) const { source_->Wrong(rule, std::move(message), line()); }

std::optional<double> Node::Read(const char* attribute) const {
  const pugi::xml_attribute found = node_.attribute(attribute);
  if (!found) return std::nullopt;
  std::string_view text = Trimmed(found.value());
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || result.ptr != text.data() + text.size() || !std::isfinite(value) || std::fabs(value) > 1e15) {
    // Underflow is a number all the same.
    if (result.ec == std::errc::result_out_of_range && result.ptr == text.data() + text.size() &&
        text.find("e-") != std::string_view::npos)
      return 0.0;
    Wrong("xml.attribute",
          fmt::format("attribute '{}' of <{}> is '{}'; a number was expected", attribute, name(), found.value()));
    return 0.0;
  }
  return value;
}

double Node::Number(const char* attribute) const {
  const auto value = Read(attribute);
  if (!value) Wrong("xml.attribute", fmt::format("<{}> has no attribute '{}'", name(), attribute));
  return value.value_or(0.0);
}

double Node::Number(const char* attribute, double otherwise) const { return Read(attribute).value_or(otherwise); }

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

std::string Node::Text(const char* attribute, std::string_view otherwise) const {
  return Has(attribute) ? node_.attribute(attribute).value() : std::string(otherwise);
}

bool Node::Flag(const char* attribute, bool otherwise) const {
  if (!Has(attribute)) return otherwise;
  const std::string_view text = Trimmed(node_.attribute(attribute).value());
  for (const std::string_view yes : {"true", "1", "yes"}) {
    if (text == yes) return true;
  }
  for (const std::string_view no : {"false", "0", "no", ""}) {
    if (text == no) return false;
  }
  Wrong("xml.attribute",
        fmt::format("attribute '{}' of <{}> is '{}'; true or false was expected", attribute, name(), text));
  return otherwise;
}

geometry::Cubic Node::Cubic(const char* from, double origin) const {
  return {origin + Number(from), Number("a"), Number("b", 0.0), Number("c", 0.0), Number("d", 0.0)};
}

std::vector<Node> Node::Children(const char* element) const {
  std::vector<Node> children;
  for (const pugi::xml_node child : node_.children(element)) children.emplace_back(source_, child);
  return children;
}

geometry::CubicTable ReadCubics(const std::vector<Node>& records, const char* from, double origin,
                                std::string_view rule) {
  std::vector<geometry::Cubic> cubics;
  for (const Node& record : records) {
    cubics.push_back(record.Cubic(from, origin));
    if (cubics.size() > 1 && cubics.back().from < cubics[cubics.size() - 2].from) {
      Within within(record.source());
      record.source().where.s_m = cubics.back().from;
      record.Wrong(rule,
                   fmt::format("<{}> with {} {:.6g} stands behind one with a larger {}; ascending order was expected",
                               record.name(), from, record.Number(from), from));
    }
  }
  std::stable_sort(cubics.begin(), cubics.end(),
                   [](const geometry::Cubic& a, const geometry::Cubic& b) { return a.from < b.from; });
  return geometry::CubicTable(std::move(cubics));
}

}  // namespace rodeira::opendrive
