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

// Manual on Uniform Traffic Control Devices, 2009: R regulatory (2B), W warning (2C), D, E, G, I, M guide (2D to 2M),
// orange where there is work (6F), S schools (7B), RS recreation (2M).
constexpr Coded kUnitedStates[] = {{"R1-1", "stop", true},
                                   {"R1-2", "give_way", true},
                                   {"R2-1", "speed_limit_us", true},
                                   {"R3-1", "prohibition_us", true},
                                   {"R3-2", "prohibition_us", true},
                                   {"R3-4", "prohibition_us", true},
                                   {"R3-18", "prohibition_us", true},
                                   {"R3-27", "prohibition_us", true},
                                   {"R4-7", "keep_right_us", true},
                                   {"R4-8", "keep_left_us", true},
                                   {"R5-1A", "board_red", true},
                                   {"R5-1", "no_entry_us", true},
                                   {"R5-2", "prohibition_us", true},
                                   {"R5-6", "prohibition_us", true},
                                   {"R6-1", "one_way_us", true},
                                   {"R8-3", "prohibition_us", true},
                                   {"R9-3", "prohibition_us", true},
                                   {"RS", "guide_brown"},
                                   {"R", "board"},
                                   {"W1-6", "board_yellow", true},
                                   {"W1-7", "board_yellow", true},
                                   {"W1-8", "chevron_yellow", true},
                                   {"W10-1", "railroad", true},
                                   {"W13-1", "board_yellow", true},
                                   {"W14-3", "pennant", true},
                                   {"W16-", "board_yellow"},
                                   {"W20-", "warning_orange"},
                                   {"W21-", "warning_orange"},
                                   {"W22-", "warning_orange"},
                                   {"W23-", "warning_orange"},
                                   {"W24-", "warning_orange"},
                                   {"W", "warning_diamond"},
                                   {"S1-1", "school", true},
                                   {"S3-", "warning_school"},
                                   {"S4-5", "warning_school", true},
                                   {"S4-", "board_school"},
                                   {"S5-", "board"},
                                   {"D5-", "guide_blue"},
                                   {"D7-", "guide_brown"},
                                   {"D9-", "guide_blue"},
                                   {"D12-", "guide_blue"},
                                   {"D", "guide_green"},
                                   {"E", "guide_green"},
                                   {"G20-", "board_orange"},
                                   {"G", "guide_green"},
                                   {"I", "guide_green"},
                                   {"M4-8", "board_orange", true},
                                   {"M4-9", "board_orange", true},
                                   {"M4-10", "board_orange", true},
                                   {"M", "board"}};
// Traffic Signs Regulations and General Directions 2016, by the diagrams' numbers.
constexpr Coded kUnitedKingdom[] = {
    {"502", "board", true},       {"503", "board", true},         {"511", "board", true},
    {"515", "chevron_black"},     {"525", "board", true},         {"526", "board", true},
    {"527", "board", true},       {"546", "board", true},         {"547", "board"},
    {"572", "board", true},       {"573", "board", true},         {"5", "danger"},
    {"601.1", "stop", true},      {"602", "give_way", true},      {"606", "mandatory", true},
    {"609", "mandatory", true},   {"610", "keep_left", true},     {"611.1", "roundabout", true},
    {"611", "mandatory", true},   {"612", "prohibition", true},   {"613", "prohibition", true},
    {"614", "prohibition", true}, {"615.1", "board", true},       {"615", "restriction", true},
    {"616", "no_entry", true},    {"617", "no_vehicles", true},   {"619", "restriction"},
    {"622", "restriction"},       {"625", "restriction"},         {"627", "restriction"},
    {"629", "restriction"},       {"632", "no_overtaking", true}, {"636", "no_waiting", true},
    {"642", "no_stopping", true}, {"652", "one_way", true},       {"660", "parking"},
    {"661", "parking"},           {"670", "speed_limit", true},   {"671", "end_of_restrictions", true},
    {"672", "mandatory", true},   {"7001", "danger", true},       {"801", "parking", true},
    {"811", "guide_blue", true},  {"816", "guide_blue", true},    {"20", "guide_green"},
    {"29", "guide_blue"}};
// GB 5768.2-2009: 警 warning, 禁 prohibition, 示 (or 指示) mandatory, 路 (or 指路) guide.
constexpr Coded kChina[] = {{"禁1", "stop", true},
                            {"禁2", "give_way", true},
                            {"禁3", "restriction", true},
                            {"禁4", "no_vehicles", true},
                            {"禁5", "no_entry", true},
                            {"禁29", "no_overtaking", true},
                            {"禁30", "end_of_no_overtaking", true},
                            {"禁31", "no_stopping", true},
                            {"禁32", "no_waiting", true},
                            {"禁34", "restriction", true},
                            {"禁35", "restriction", true},
                            {"禁36", "restriction", true},
                            {"禁37", "restriction", true},
                            {"禁38", "speed_limit", true},
                            {"禁39", "end_of_speed_limit", true},
                            {"禁40", "restriction", true},
                            {"禁42", "restriction", true},
                            {"禁43", "board", true},
                            {"禁44", "board", true},
                            {"禁45", "board", true},
                            {"禁46", "board", true},
                            {"禁47", "board", true},
                            {"禁48", "board", true},
                            {"禁", "prohibition"},
                            {"警39", "board_yellow", true},
                            {"警45", "board_yellow", true},
                            {"警", "warning_yellow"},
                            {"示7", "keep_right", true},
                            {"示8", "keep_left", true},
                            {"示11", "roundabout", true},
                            {"示12", "one_way", true},
                            {"示13", "guide_blue", true},
                            {"示17", "guide_blue", true},
                            {"示18", "guide_blue", true},
                            {"示19", "crossing", true},
                            {"示20", "guide_blue", true},
                            {"示21", "guide_blue", true},
                            {"示22", "guide_blue", true},
                            {"示23", "guide_blue", true},
                            {"示24", "guide_blue", true},
                            {"示25", "guide_blue", true},
                            {"示26", "guide_blue", true},
                            {"示28", "guide_blue", true},
                            {"示30", "guide_blue", true},
                            {"示32", "guide_blue", true},
                            {"示33", "guide_blue", true},
                            {"示34", "guide_blue", true},
                            {"示35", "parking", true},
                            {"示36", "guide_blue", true},
                            {"示", "mandatory"},
                            {"路36", "chevron_blue", true},
                            {"路37", "chevron_blue", true},
                            {"路4", "guide_blue", true},
                            {"路5", "guide_blue", true},
                            {"路6", "guide_blue", true},
                            {"路7", "guide_blue", true},
                            {"路4", "guide_green"},
                            {"路5", "guide_green"},
                            {"路6", "guide_green"},
                            {"路7", "guide_green"},
                            {"路", "guide_blue"}};

// Names of RoadRunner's models, in lower case and without '_', as far as they begin.
constexpr Coded kRoadRunner[] = {
    {"speedlimit", "speed_limit_us"}, {"stop", "stop"},           {"yield", "give_way"},
    {"giveway", "give_way"},          {"donotenter", "no_entry"}, {"noentry", "no_entry"},
    {"keepright", "keep_right"},      {"keepleft", "keep_left"},  {"roundabout", "roundabout"}};

std::optional<std::string_view> OfRoadRunner(const Signal& signal) {
  std::string name = Lower(signal.name);
  if (!name.starts_with("sign_")) return std::nullopt;
  name.erase(0, 5);
  std::erase(name, '_');
  return Find(name, kRoadRunner);
}

// "r1" with the subtype "1" is "R1-1".
std::string AmericanCode(const Signal& signal) {
  std::string code = signal.type;
  if (code.find('-') == std::string::npos && IsDigits(signal.subtype)) code += "-" + signal.subtype;
  for (char& c : code) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return code;
}

// "指示7" and "指7" are "示7", "指路3" is "路3".
std::string ChineseCode(const Signal& signal) {
  std::string code = signal.type;
  constexpr std::string_view kPoint = "指";
  if (!code.starts_with(kPoint)) return code;
  code.erase(0, kPoint.size());
  return code.starts_with("示") || code.starts_with("路") ? code : "示" + code;
}

}  // namespace

std::vector<CatalogueRow> CataloguesAbroad() {
  std::vector<CatalogueRow> rows;
  for (const Coded& row : kUnitedStates) rows.push_back({"US", row.begin, row.kind});
  for (const Coded& row : kUnitedKingdom) rows.push_back({"GB", row.begin, row.kind});
  for (const Coded& row : kChina) rows.push_back({"CN", row.begin, row.kind});
  return rows;
}

std::optional<std::string_view> SignKindAbroad(const Signal& signal) {
  const std::string country = Lower(signal.country);
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), country) != names.end();
  };
  if (signal.type == "-1" || signal.type.empty() || signal.type == "none") return OfRoadRunner(signal);
  if (is({"us", "usa", "united states"})) return Find(AmericanCode(signal), kUnitedStates);
  if (is({"gb", "gbr", "uk", "united kingdom"})) return Find(signal.type, kUnitedKingdom);
  if (is({"cn", "chn", "china"})) return Find(ChineseCode(signal), kChina);
  return std::nullopt;
}

std::string NumberInName(const Signal& signal) {
  if (!Lower(signal.name).starts_with("sign_")) return "";
  const std::string_view name = signal.name;
  const std::string_view number = name.substr(name.rfind('_') + 1);
  return IsDigits(number) && number.size() <= 3 ? std::string(number) : "";
}

}  // namespace rodeira::network
