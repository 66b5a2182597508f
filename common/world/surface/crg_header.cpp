// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/core/base/printable.hpp"
#include "common/core/base/suggest.hpp"
#include "common/world/surface/crg_keys.hpp"

namespace rodeira::surface {
namespace {

constexpr std::size_t kMaxChannels = 100'000;
constexpr std::size_t kMaxWarnings = 50;
constexpr std::size_t kLongestLine = 4096;  // the format's own limit is 72

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::string_view Trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> Number(std::string_view text) {
  text = Trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// A number with an exponent that is misspelt and nothing, as ASAM's own library reads it: "2.0+e00" is 2. Others may be
// meant in more than one way.
std::optional<double> LeadingNumber(std::string_view text, std::size_t& length) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  length = static_cast<std::size_t>(end - text.data());
  if (problem != std::errc() || length == sign || !std::isfinite(value)) return std::nullopt;
  if (text.substr(length).find_first_not_of("+-eEdD0") != std::string_view::npos) return std::nullopt;
  return value;
}

class HeaderReader {
 public:
  HeaderReader(std::span<const std::byte> bytes, std::string_view name)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name) {}

  base::Result<CrgHeader> Read() {
    std::size_t at = 0;
    while (at < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      if (end - at > kLongestLine)
        return Wrong("the line is too long for a header; no line that begins with '$$$$' ended it");
      const std::string_view line = text_.substr(at, end - at);
      at = std::min(end + 1, text_.size());
      if (line.starts_with("$$$$")) {
        header_.data_offset = at;
        header_.data_line = line_ + 1;
        break;
      }
      now_ = line;
      if (const auto status = Line(line); !status) return status.error();
    }
    if (header_.data_offset == 0 && header_.other_file.empty()) {
      return Wrong(
          "this is no OpenCRG file: neither numbers after a line that begins with '$$$$' nor a $ROAD_CRG_FILE were "
          "found");
    }
    return std::move(header_);
  }

 private:
  enum class Section { kNone, kUnknown, kComment, kRoad, kOptions, kModifiers, kFile, kChannels };

  base::Error Wrong(std::string_view message) const {
    return base::WrongInput("surface.wrong_header", message, fmt::format("{}:{}", name_, line_));
  }

  // In the line that is read, from 1 on.
  std::size_t ColumnOf(std::string_view part) const { return static_cast<std::size_t>(part.data() - now_.data()) + 1; }

  void Warn(std::string_view what) {
    if (header_.warnings.size() < kMaxWarnings) {
      header_.warnings.push_back(fmt::format("line {}: {}", line_, base::Printable(what)));
    }
  }

  base::Status Line(std::string_view line) {
    if (line.starts_with('$')) {
      Open(Lower(Trim(line.substr(0, line.find('!')))));
      return {};
    }
    if (section_ == Section::kComment) {
      header_.comment += fmt::format("{}\n", Trim(line));
      return {};
    }
    if (line.starts_with('*')) return {};
    line = Trim(line.substr(0, line.find('!')));
    if (line.empty()) return {};
    switch (section_) {
      case Section::kRoad:
        return Key(line, CrgRoadKeyTable());
      case Section::kOptions:
        return Key(line, CrgOptionTable());
      case Section::kModifiers:
        return Key(line, CrgModifierTable());
      case Section::kFile:
        return FileName(line);
      case Section::kChannels:
        return Channel(line);
      default:
        return {};
    }
  }

  void Open(const std::string& name) {
    section_ = Section::kUnknown;
    if (name == "$")
      section_ = Section::kNone;
    else if (name == "$ct")
      section_ = Section::kComment;
    else if (name == "$road_crg")
      section_ = Section::kRoad;
    else if (name == "$road_crg_file")
      section_ = Section::kFile;
    else if (name == "$kd_definition")
      section_ = Section::kChannels;
    else if (name == "$road_crg_opts") {
      section_ = Section::kOptions;
      header_.options.emplace();
    } else if (name == "$road_crg_mods") {
      section_ = Section::kModifiers;
      header_.modifiers.emplace().missing = 0;  // a section of its own takes the usual modifiers away
    } else if (name != "$road_crg_mpro") {
      Warn(fmt::format("section '{}' is unknown and passed over", name.substr(0, 40)));
    }
  }

  base::Status Key(std::string_view line, std::span<const CrgKey> table) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      return Wrong(fmt::format("'{}' was found; KEY = NUMBER was expected", line.substr(0, 60)));
    }
    const std::string name = Lower(Trim(line.substr(0, equals)));
    const auto key = std::find_if(table.begin(), table.end(), [&](const CrgKey& known) { return known.name == name; });
    if (key == table.end()) {
      std::vector<std::string> names;
      for (const CrgKey& known : table) names.emplace_back(known.name);
      Warn(fmt::format("key '{}' is unknown and passed over{}", name.substr(0, 40), base::DidYouMean(name, names)));
      return {};
    }
    if (key->put == nullptr) return {};
    const std::string_view text = Trim(line.substr(equals + 1));
    auto value = Number(text);
    if (!value) {
      std::size_t length = 0;
      value = LeadingNumber(text, length);
      const std::string what = fmt::format("'{}' is '{}'; a number was expected", name, text.substr(0, 40));
      const std::size_t column = ColumnOf(text) + length;  // of what is wrong
      if (!value) return base::WrongInput("surface.wrong_header", what, fmt::format("{}:{}:{}", name_, line_, column));
      Warn(fmt::format("column {}: {}; it is read as {}", column, what, *value));
    }
    if (*value < key->low || *value > key->high || (key->whole && *value != std::floor(*value))) {
      return Wrong(fmt::format("'{}' is {}; a {} from {} to {} was expected", name, *value,
                               key->whole ? "whole number" : "number", key->low, key->high));
    }
    key->put(header_, *value);
    return {};
  }

  base::Status FileName(std::string_view line) {
    if (header_.other_file.empty() && line.starts_with('$')) {
      return Wrong(
          fmt::format("the file name '{}' begins with an environment variable; a path was expected, so that a world is "
                      "the same everywhere",
                      line.substr(0, 60)));
    }
    header_.other_file += line;  // a long name goes on in the next line
    return {};
  }

  base::Status Channel(std::string_view line) {
    const std::string text = Lower(line);
    if (text.starts_with("#:")) return Format(std::string(Trim(text.substr(2))));
    if (text.starts_with("u:")) return {};  // for programs that draw the numbers
    if (!text.starts_with("d:")) {
      Warn(fmt::format("'{}' is unknown and passed over", text.substr(0, 40)));
      return {};
    }
    const std::size_t comma = text.find(',');
    const std::string_view name =
        Trim(std::string_view(text).substr(2, comma == std::string::npos ? comma : comma - 2));
    const std::string_view unit = comma == std::string::npos ? "" : Trim(std::string_view(text).substr(comma + 1));
    CrgChannel channel;
    std::string_view expected = "m";
    if (name.starts_with("long section")) {
      if (const auto placed = Place(Trim(name.substr(12)), channel); !placed) return placed;
    } else if (name == "reference line phi") {
      channel.column = CrgColumn::kHeading, expected = "rad";
    } else if (name == "reference line slope") {
      channel.column = CrgColumn::kSlope, expected = "m/m";
    } else if (name == "reference line banking") {
      channel.column = CrgColumn::kBanking, expected = "m/m";
    } else if (name == "reference line x") {
      channel.column = CrgColumn::kX;
    } else if (name == "reference line y") {
      channel.column = CrgColumn::kY;
    } else if (name != "reference line u") {
      return Wrong(fmt::format(
          "column '{}' is unknown; 'reference line phi', 'slope', 'banking', 'x', 'y' or 'long section …' was expected",
          name.substr(0, 60)));
    }
    if (unit != expected) {
      return Wrong(
          fmt::format("column '{}' is in '{}'; '{}' was expected", name.substr(0, 60), unit.substr(0, 20), expected));
    }
    if (header_.channels.size() >= kMaxChannels)
      return Wrong(fmt::format("the file has more than {} columns", kMaxChannels));
    header_.channels.push_back(channel);
    return {};
  }

  // "at v = -1.25" or "3".
  base::Status Place(std::string_view text, CrgChannel& channel) const {
    channel.column = CrgColumn::kHeight;
    const std::size_t equals = text.find('=');
    const bool at = text.starts_with("at v") && equals != std::string_view::npos;
    const auto value = Number(at ? text.substr(equals + 1) : text);
    const bool fine =
        value && (at ? std::fabs(*value) <= 1e6 : *value >= 1.0 && *value <= 1e6 && *value == std::floor(*value));
    if (!fine) {
      return Wrong(
          fmt::format("'long section {}' was found; 'long section at v = METRES' or 'long section NUMBER' was expected",
                      text.substr(0, 40)));
    }
    if (at)
      channel.v_m = value;
    else
      channel.number = static_cast<int>(*value);
    return {};
  }

  base::Status Format(const std::string& name) {
    if (name == "lrfi")
      header_.format = CrgFormat::kText10;
    else if (name == "ldfi")
      header_.format = CrgFormat::kText20;
    else if (name == "krbi")
      header_.format = CrgFormat::kFloat;
    else if (name == "kdbi")
      header_.format = CrgFormat::kDouble;
    else
      return Wrong(
          fmt::format("the numbers' format is '{}'; LRFI, LDFI, KRBI or KDBI was expected", name.substr(0, 20)));
    return {};
  }

  std::string_view text_;
  std::string_view name_;
  std::string_view now_;  // the line that is read
  int line_ = 0;
  Section section_ = Section::kNone;
  CrgHeader header_;
};

}  // namespace

base::Result<CrgHeader> ReadCrgHeader(std::span<const std::byte> bytes, std::string_view name) {
  return HeaderReader(bytes, name).Read();
}

}  // namespace rodeira::surface
