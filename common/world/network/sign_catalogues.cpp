// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/sign_catalogues.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

namespace rodeira::network {
namespace {

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool IsDigits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// What a code begins with, and the kind; more particular ones first. `whole`: nothing but letters may follow.
struct Coded {
  std::string_view begin, kind;
  bool whole = false;
};

std::optional<std::string_view> Find(std::string_view code, std::span<const Coded> table) {
  for (const Coded& row : table) {
    if (!code.starts_with(row.begin)) continue;
    const std::string_view rest = code.substr(row.begin.size());
    const bool more = !rest.empty() && ((rest[0] >= '0' && rest[0] <= '9') || rest[0] == '.' || rest[0] == '-');
    if (!row.whole || !more) return row.kind;
  }
  return std::nullopt;
}

// Manual on Uniform Traffic Control Devices, 2009: R regulatory (2B), W warning (2C), D, E, G, I, M guide (2D to 2M).
constexpr Coded kUnitedStates[] = {
    {"R1-1", "stop", true},       {"R1-2", "give_way", true}, {"R2-1", "speed_limit_us", true},
    {"R4-7", "keep_right", true}, {"R5-1", "no_entry", true}, {"R", "board"},
    {"W", "warning_diamond"},     {"D", "guide_green"},       {"E", "guide_green"},
    {"G", "guide_green"},         {"I", "guide_green"},       {"M", "board"}};
// Traffic Signs Regulations and General Directions 2016, by the diagrams' numbers.
constexpr Coded kUnitedKingdom[] = {{"601.1", "stop", true},
                                    {"602", "give_way", true},
                                    {"606", "mandatory", true},
                                    {"609", "mandatory", true},
                                    {"610", "keep_right", true},
                                    {"611.1", "roundabout", true},
                                    {"616", "no_entry", true},
                                    {"617", "no_vehicles", true},
                                    {"632", "no_overtaking", true},
                                    {"670", "speed_limit", true},
                                    {"671", "end_of_restrictions", true},
                                    {"612", "prohibition"},
                                    {"613", "prohibition"},
                                    {"614", "prohibition"},
                                    {"615", "prohibition"},
                                    {"62", "prohibition"},
                                    {"501", "danger", true},
                                    {"5", "danger"},
                                    {"20", "guide_green"},
                                    {"29", "guide_blue"}};
// GB 5768.2-2009: 警 warning, 禁 prohibition, 指 mandatory, 路 guide.
constexpr Coded kChina[] = {{"禁1", "stop", true},
                            {"禁2", "give_way", true},
                            {"禁5", "no_entry", true},
                            {"禁38", "speed_limit", true},
                            {"禁39", "end_of_speed_limit", true},
                            {"禁", "prohibition"},
                            {"警", "warning_yellow"},
                            {"指", "mandatory"},
                            {"路", "guide_blue"}};

// Names of RoadRunner's models, in lower case and without '_', as far as they begin.
constexpr Coded kRoadRunner[] = {{"speedlimit", "speed_limit_us"},
                                 {"stop", "stop"},
                                 {"yield", "give_way"},
                                 {"giveway", "give_way"},
                                 {"donotenter", "no_entry"},
                                 {"noentry", "no_entry"},
                                 {"keepright", "keep_right"},
                                 {"roundabout", "roundabout"}};

std::optional<std::string_view> OfRoadRunner(const Signal& signal) {
  std::string name = Lower(signal.name);
  if (!name.starts_with("sign_")) return std::nullopt;
  name.erase(0, 5);
  std::erase(name, '_');
  return Find(name, kRoadRunner);
}

// "R1" with the subtype "1" is "R1-1".
std::string CodeOf(const Signal& signal) {
  if (signal.type.find('-') != std::string::npos || !IsDigits(signal.subtype)) return signal.type;
  return signal.type + "-" + signal.subtype;
}

}  // namespace

std::optional<std::string_view> SignKindAbroad(const Signal& signal) {
  const std::string country = Lower(signal.country);
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), country) != names.end();
  };
  if (signal.type == "-1" || signal.type.empty() || signal.type == "none") return OfRoadRunner(signal);
  if (is({"us", "usa", "united states"})) return Find(CodeOf(signal), kUnitedStates);
  if (is({"gb", "gbr", "uk", "united kingdom"})) return Find(signal.type, kUnitedKingdom);
  if (is({"cn", "chn", "china"})) return Find(signal.type, kChina);
  return std::nullopt;
}

std::string NumberInName(const Signal& signal) {
  if (!Lower(signal.name).starts_with("sign_")) return "";
  const std::string_view name = signal.name;
  const std::string_view number = name.substr(name.rfind('_') + 1);
  return IsDigits(number) && number.size() <= 3 ? std::string(number) : "";
}

}  // namespace rodeira::network
