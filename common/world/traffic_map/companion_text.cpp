// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/companion_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace rodeira::traffic_map {
namespace {

constexpr std::string_view kFirst = "rodeira: motors/1\n";
constexpr std::size_t kRule = 0, kHeights = 1;  // of the parts
constexpr std::array<std::string_view, 5> kParts = {"rule", "heights_m", "lights", "signs", "flows_vehph"};

std::string HeightLine(const CurveHeights& one) {
  return fmt::format("  {}: [{}]\n", one.curve, fmt::join(one.z_m, ", "));
}

// A name as a YAML scalar that reads as that text.
std::string Scalar(const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  });
  if (plain) return name;
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? std::string("''") : std::string(1, c);
  return text + "'";
}

std::string LightText(const lights::LightPlan& plan) {
  std::string text =
      fmt::format("  - offset_s: {}\n    amber_s: {}\n    all_red_s: {}\n    red_amber_s: {}\n    phases:\n",
                  plan.offset_s, plan.amber_s, plan.all_red_s, plan.red_amber_s);
  for (const lights::Phase& phase : plan.phases) {
    std::vector<std::string> green;
    for (const std::string& name : phase.green) green.push_back(Scalar(name));
    text += fmt::format("      - {{green: [{}], for_s: {}}}\n", fmt::join(green, ", "), phase.green_s);
  }
  return text;
}

std::string SignText(const LaneSign& sign) {
  std::string text = fmt::format("  - {{lane: {}, kind: {}", sign.lane, NameOf(sign.kind));
  if (sign.kind == SignKind::kSpeedLimit) text += fmt::format(", limit_kmh: {}", sign.limit_kmh);
  if (sign.before_end_m != 0.0) text += fmt::format(", before_end_m: {}", sign.before_end_m);
  return text + "}\n";
}

// One part, its key first; empty where there is nothing to say.
std::string PartText(const Heights& heights, std::size_t part) {
  if (part == kRule) return heights.left_hand ? "rule: left\n" : "";
  std::string text;
  if (part == kHeights) {
    for (const CurveHeights& one : heights.curves) text += HeightLine(one);
  } else if (part == 2) {
    for (const lights::LightPlan& plan : heights.lights) text += LightText(plan);
  } else if (part == 3) {
    for (const LaneSign& sign : heights.signs) text += SignText(sign);
  } else {
    for (const LaneFlow& flow : heights.flows) text += fmt::format("  {}: {}\n", flow.lane, flow.vehph);
  }
  return text.empty() ? text : fmt::format("{}:\n{}", kParts[part], text);
}

std::vector<std::string_view> LinesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    lines.push_back(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
  }
  return lines;
}

// A comment, from its '#' on; empty where the line has none. A '#' begins one at a line's beginning or behind a space.
std::string_view CommentOf(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(i);
  }
  return {};
}

// The text from one key at the margin up to the next one, with the comments at the margin above it.
struct Block {
  std::string key;
  std::vector<std::string_view> lines;
};

// Empty where a line at the margin is neither a key nor a comment.
std::vector<Block> BlocksOf(std::string_view text) {
  std::vector<Block> blocks;
  std::vector<std::string_view> above;  // comments and empty lines that belong to whatever comes next
  for (const std::string_view line : LinesOf(text)) {
    const char first = line.front();
    if (first == '#' || first == '\n' || first == '\r') {
      above.push_back(line);
      continue;
    }
    if (first != ' ' && first != '\t') {
      const std::size_t colon = line.find(':');
      if (colon == std::string_view::npos || first == '{' || first == '-' || first == '"' || first == '\'') return {};
      blocks.push_back({std::string(line.substr(0, colon)), {}});
    }
    if (blocks.empty()) return {};
    auto& lines = blocks.back().lines;
    lines.insert(lines.end(), above.begin(), above.end());
    lines.push_back(line);
    above.clear();
  }
  if (!blocks.empty()) blocks.back().lines.insert(blocks.back().lines.end(), above.begin(), above.end());
  return blocks;
}

std::string WithLineEnd(std::string_view text) {
  std::string line(text);
  while (line.ends_with('\n') || line.ends_with('\r')) line.pop_back();
  return line + "\n";
}

// A part anew below the comments of the old one; heights that stay keep their line.
std::string Renewed(const Block& block, const Heights& heights, const Heights& loaded, std::size_t part) {
  std::vector<std::string> kept_lines;
  std::vector<CurveHeights> kept;
  if (part == kHeights) {
    for (const CurveHeights& one : loaded.curves) {
      for (const std::string_view line : block.lines) {
        const std::string start = fmt::format("{}:", one.curve);
        const std::size_t at = line.find_first_not_of(' ');
        if (at == std::string_view::npos || at == 0 || line.substr(at, start.size()) != start ||
            line.find(']') == std::string_view::npos)
          continue;
        kept.push_back(one);
        kept_lines.push_back(WithLineEnd(line));
      }
    }
  }
  const auto kept_line = [&](const CurveHeights& one) -> const std::string* {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i].curve == one.curve && kept[i].z_m == one.z_m) return &kept_lines[i];
    }
    return nullptr;
  };
  std::string below;
  std::vector<std::string_view> used;
  if (part == kHeights && !heights.curves.empty()) {
    below = "heights_m:\n";
    for (const CurveHeights& one : heights.curves) {
      const std::string* line = kept_line(one);
      below += line != nullptr ? *line : HeightLine(one);
      if (line != nullptr) used.push_back(*line);
    }
  } else {
    below = PartText(heights, part);
  }
  std::string comments;
  for (const std::string_view line : block.lines) {
    const std::string_view comment = CommentOf(line);
    const std::string whole = WithLineEnd(line);
    if (comment.empty() || std::find(used.begin(), used.end(), whole) != used.end()) continue;
    comments += WithLineEnd(comment);
  }
  return comments + below;
}

// The text with the parts that were edited written anew.
std::string Edited(const Heights& heights, const Heights& loaded, const std::vector<Block>& blocks,
                   const std::array<bool, kParts.size()>& edited) {
  std::string result;
  std::array<bool, kParts.size()> written{};
  for (const Block& block : blocks) {
    const auto part = static_cast<std::size_t>(std::find(kParts.begin(), kParts.end(), block.key) - kParts.begin());
    if (part < kParts.size()) written[part] = true;
    if (part < kParts.size() && edited[part]) {
      result += Renewed(block, heights, loaded, part);
      continue;
    }
    for (const std::string_view line : block.lines) result += line;
    if (!result.ends_with('\n')) result += '\n';
  }
  for (std::size_t part = 0; part < kParts.size(); ++part) {
    if (!written[part]) result += PartText(heights, part);
  }
  return result;
}

}  // namespace

std::string CompanionText(const Heights& heights) {
  std::string text;
  for (std::size_t part = 0; part < kParts.size(); ++part) text += PartText(heights, part);
  return text.empty() ? text : std::string(kFirst) + text;
}

std::string CompanionText(const Heights& heights, const Heights& loaded, const std::string& text) {
  std::array<bool, kParts.size()> edited{};
  for (std::size_t part = 0; part < kParts.size(); ++part)
    edited[part] = PartText(heights, part) != PartText(loaded, part);
  if (std::find(edited.begin(), edited.end(), true) == edited.end()) return text;
  const std::string anew = CompanionText(heights);
  const std::string edited_text = Edited(heights, loaded, BlocksOf(text), edited);
  const auto again = ParseHeights(edited_text, "edited");
  if (again && CompanionText(again.value()) == anew) return edited_text;
  // Written in a way that is not seen through here.
  std::string comments;
  for (const std::string_view line : LinesOf(text)) {
    if (const std::string_view comment = CommentOf(line); !comment.empty()) comments += WithLineEnd(comment);
  }
  return comments + (anew.empty() ? std::string(kFirst) : anew);
}

}  // namespace rodeira::traffic_map
