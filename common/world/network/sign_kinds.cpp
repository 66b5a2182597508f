// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/sign_kinds.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "common/world/network/sign_catalogues.hpp"

namespace rodeira::network {
namespace {

struct Catalogued {
  const char* type;
  const char* subtype;  // "": any
  const char* kind;
};
// More particular ones first.
constexpr Catalogued kCatalogue[] = {
    {"101", "", "danger"},
    {"102", "", "priority_to_the_right"},
    {"103", "10", "bend_left"},
    {"103", "20", "bend_right"},
    {"105", "10", "bends_left_first"},
    {"105", "20", "bends_right_first"},
    {"103", "-1", "bend_right"},  // which way is not said
    {"105", "-1", "bends_right_first"},
    {"108", "", "downhill"},
    {"110", "", "uphill"},
    {"112", "", "uneven_road"},
    {"114", "", "slippery_road"},
    {"205", "", "give_way"},
    {"206", "", "stop"},
    {"209", "", "mandatory"},
    {"211", "", "mandatory"},
    {"214", "", "mandatory"},
    {"215", "", "roundabout"},
    {"220", "", "one_way"},
    {"222", "10", "keep_left"},
    {"222", "", "keep_right"},
    {"250", "", "no_vehicles"},
    {"267", "", "no_entry"},
    {"274", "", "speed_limit"},
    {"276", "", "no_overtaking"},
    {"278", "", "end_of_speed_limit"},
    {"280", "", "end_of_no_overtaking"},
    {"282", "", "end_of_restrictions"},
    {"283", "", "no_stopping"},
    {"286", "", "no_waiting"},
    {"301", "", "priority"},
    {"306", "", "priority_road"},
    {"307", "", "end_of_priority_road"},
    {"310", "", "town"},
    {"311", "", "end_of_town"},
    {"314", "", "parking"},
    {"330", "", "motorway"},
    {"332", "", "guide_blue"},
    {"333", "", "guide_blue"},
    {"334", "", "end_of_motorway"},
    {"350", "", "crossing"},
    {"406", "", "guide_blue"},
    {"430", "", "guide_blue"},
    {"434", "", "guide_yellow"},  // direction signs at a junction; 435 and 436: other shapes within towns, until 2013
    {"435", "", "guide_yellow"},
    {"436", "", "guide_yellow"},
    {"440", "", "guide_blue"},
    {"449", "", "guide_blue"},
    {"450", "", "exit_beacon"},
    {"451", "", "exit_beacon_two"},
    {"452", "", "exit_beacon_one"},
    {"605", "", "beacon"},
    {"625", "", "chevron"},
};
// Lines and crossings that are painted on the road: they have numbers, but nothing stands there.
constexpr std::array<std::string_view, 9> kPaint = {"293", "294", "295", "296", "297", "298", "299", "340", "341"};

bool KnowsCatalogue(std::string country) {
  std::transform(country.begin(), country.end(), country.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return country.empty() || country == "de" || country == "deu" || country == "ger" || country == "germany" ||
         country == "opendrive";
}

}  // namespace

std::optional<std::string_view> SignKindOf(const Signal& signal) {
  if (const auto abroad = SignKindAbroad(signal)) return abroad;
  if (!KnowsCatalogue(signal.country)) return std::nullopt;
  if (std::find(kPaint.begin(), kPaint.end(), signal.type) != kPaint.end()) return "";
  for (const Catalogued& sign : kCatalogue) {
    if (signal.type == sign.type && (*sign.subtype == '\0' || signal.subtype == sign.subtype)) return sign.kind;
  }
  return std::nullopt;
}

std::vector<std::string_view> SignKindNames() {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view kind) {
    if (std::find(names.begin(), names.end(), kind) == names.end()) names.push_back(kind);
  };
  for (const Catalogued& sign : kCatalogue) add(sign.kind);
  for (const CatalogueRow& row : CataloguesAbroad()) add(row.kind);
  return names;
}

std::string SignNumberOf(const Signal& signal) {
  if (signal.value && std::isfinite(*signal.value) && *signal.value > 0.0) {
    double value = *signal.value;
    if (signal.unit == "m/s") value *= 3.6;
    return std::to_string(std::lround(value));
  }
  if (signal.type == "274" && signal.subtype.size() == 2 && signal.subtype[0] >= '5' && signal.subtype[0] <= '6' &&
      signal.subtype[1] >= '0' && signal.subtype[1] <= '9') {
    const int number = std::stoi(signal.subtype);
    if (number >= 51 && number <= 63) return std::to_string(10 * (number - 50));
  }
  return NumberInName(signal);
}

}  // namespace rodeira::network
