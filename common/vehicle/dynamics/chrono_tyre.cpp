// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/chrono_tyre.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/fiala_file.hpp"
#include "common/vehicle/dynamics/fiala_tyre.hpp"
#include "common/vehicle/dynamics/tmeasy_tyre.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;
using config::Range;

constexpr double kLoadGravity_mps2 = 9.81;
constexpr double kTmeasyLargest = 3.5;  // loads above this many nominal ones count as this one

// Comments become blanks, so that lines stay where they are, and so do tabs, which YAML does not allow.
std::string WithoutComments(std::string_view text) {
  std::string plain(text);
  bool quoted = false;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] == '\t') plain[i] = ' ';
    if (plain[i] == '"' && (i == 0 || plain[i - 1] != '\\')) quoted = !quoted;
    if (quoted || plain[i] != '/' || i + 1 >= plain.size()) continue;
    if (plain[i + 1] == '/') {
      while (i < plain.size() && plain[i] != '\n') plain[i++] = ' ';
    } else if (plain[i + 1] == '*') {
      const std::size_t end = std::min(plain.find("*/", i + 2), plain.size() - 2) + 2;
      for (; i < end; ++i) {
        if (plain[i] != '\n') plain[i] = ' ';
      }
    }
  }
  return plain;
}

// Load index to payload (ETRTO): steps of a fortieth of a decade, rounded as the standard rounds them.
constexpr auto kPayload_kg = std::to_array<double>(
    {45,   46.5, 47.5, 48.7, 50,   51.5, 53,   54.5, 56,   58,   60,   61.5, 63,   65,   67,   69,   71,   73,   75,
     77.5, 80,   82.5, 85,   87.5, 90,   92.5, 95,   97.5, 100,  103,  106,  109,  112,  115,  118,  121,  125,  128,
     132,  136,  140,  145,  150,  155,  160,  165,  170,  175,  180,  185,  190,  195,  200,  206,  212,  218,  224,
     230,  236,  243,  250,  257,  265,  272,  280,  290,  300,  307,  315,  325,  335,  345,  355,  365,  375,  387,
     400,  412,  425,  437,  450,  462,  475,  487,  500,  515,  530,  545,  560,  580,  600,  615,  630,  650,  670,
     690,  710,  730,  750,  775,  800,  825,  850,  875,  900,  925,  950,  975,  1000, 1030, 1060, 1090, 1120, 1150,
     1180, 1215, 1250, 1285, 1320, 1360, 1400, 1450, 1500, 1550, 1600, 1650, 1700, 1750, 1800, 1850, 1900, 1950, 2000,
     2060, 2120, 2180, 2240, 2300, 2360, 2430, 2500, 2575, 2650, 2725, 2800, 2900, 3000, 3075, 3150, 3250, 3350, 3450,
     3550, 3650, 3750, 3875, 4000, 4125, 4250, 4375, 4500, 4625, 4750, 4875, 5000, 5150, 5300, 5450, 5600, 5850, 6000,
     6150, 6300, 6500, 6700, 6900, 7100, 7300, 7500, 7750, 8000});

// The author's parameters over the load of a truck's and a passenger car's tyre.
TmeasySettings Guessed(double payload_N, double pressure_share, bool truck) {
  TmeasySettings tyre;
  const double n = 0.5 * payload_N * std::pow(pressure_share, 0.8);
  tyre.nominal_N = n;
  tyre.largest_N = kTmeasyLargest * n;
  const auto forces = [n](double once, double twice) { return std::array{once * n, twice * 2.0 * n}; };
  if (truck) {
    tyre.longitudinal = {forces(17.7764, 14.5301),
                         forces(0.89965, 0.77751),
                         forces(0.46183, 0.42349),
                         {0.10811, 0.12389},
                         {0.66667, 0.66667}};
    tyre.lateral = {forces(7.4013, 6.8505),
                    forces(0.75876, 0.72628),
                    forces(0.68276, 0.65319),
                    {0.33167, 0.33216},
                    {1.0296, 1.0296}};
  } else {
    tyre.longitudinal = {forces(18.3741, 19.4669),
                         forces(1.1292, 1.0896),
                         forces(0.80149, 0.76917),
                         {0.13913, 0.13913},
                         {0.66667, 0.66667}};
    tyre.lateral = {forces(15.9826, 12.8509),
                    forces(1.0009, 0.91367),
                    forces(0.8336, 0.77336),
                    {0.14852, 0.18504},
                    {0.96524, 1.0714}};
  }
  return tyre;
}

std::array<double, 2> NumberPair(const Map& map, const char* key, Range range) {
  const std::vector<double> values = map.Numbers(key, range);
  if (values.size() == 2) return {values[0], values[1]};
  if (map.Has(key))
    map.Problem(key, "config.wrong_length", fmt::format("'{}' holds {} numbers; 2 were expected", key, values.size()));
  return {range.low, range.low};
}

TmeasyDirection ReadDirection(const Map& map, char axis) {
  const auto key = [axis](const char* text) {
    std::string name(text);
    std::replace(name.begin(), name.end(), '?', axis);
    return name;
  };
  constexpr Range kForce{1.0, 1e8}, kSlip{1e-3, 100.0};
  TmeasyDirection d;
  d.slope_N = NumberPair(map, key("Initial Slopes dF?/ds? [N]").c_str(), kForce);
  d.maximum_N = NumberPair(map, key("Maximum F? Load [N]").c_str(), kForce);
  d.sliding_N = NumberPair(map, key("Sliding F? Load [N]").c_str(), kForce);
  d.slip_max = NumberPair(map, key("Slip s? at Maximum F?").c_str(), kSlip);
  const std::string slide = key("Slip s? where sliding begins");
  d.slip_slide = NumberPair(map, slide.c_str(), kSlip);
  for (std::size_t i = 0; i < 2; ++i) {
    if (d.slip_slide[i] <= d.slip_max[i] && map.Has(slide))
      map.Problem(slide, "config.wrong_order", fmt::format("'{}' is not above the slip at the maximum", slide));
    if (d.sliding_N[i] > d.maximum_N[i])
      map.Problem(key("Sliding F? Load [N]"), "config.wrong_order", "the sliding force is above the maximum");
  }
  return d;
}

// Keys of mass, looks and vertical stiffness are not asked for: the vehicle file has its own.
Map WithOtherKeys(Map map) {
  (void)map.Keys();
  return map;
}

double Payload_N(const Map& root) {
  if (!root.Has("Load Index")) return root.Number("Maximum Bearing Capacity [N]", {100.0, 1e7});
  const auto index = root.Integer("Load Index", 0, kPayload_kg.size() - 1);
  return kPayload_kg[static_cast<std::size_t>(index)] * kLoadGravity_mps2;
}

ChronoTyre ReadTmeasy(const Map& root) {
  ChronoTyre tyre;
  tyre.kind = "TMeasy";
  TmeasySettings settings;
  if (root.Has("Parameters")) {
    const Map parameters = WithOtherKeys(root.Child("Parameters"));
    const Map vertical = WithOtherKeys(parameters.Child("Vertical"));
    settings.nominal_N = vertical.Number("Nominal Vertical Force [N]", {10.0, 1e7});
    settings.largest_N =
        vertical.Number("Maximum Vertical Force [N]", {10.0, 1e8}, kTmeasyLargest * settings.nominal_N);
    settings.longitudinal = ReadDirection(WithOtherKeys(parameters.Child("Longitudinal")), 'x');
    settings.lateral = ReadDirection(WithOtherKeys(parameters.Child("Lateral")), 'y');
  } else {
    const bool truck = root.Choice("Vehicle Type", {"Passenger", "Truck"}, "Passenger") == "Truck";
    const double payload_N = Payload_N(root);
    const double design = root.Number("Inflation Pressure Design [Pa]", {1e-3, 1e7}, 1.0);
    const double use = root.Number("Inflation Pressure Use [Pa]", {1e-3, 1e7}, design);
    settings = Guessed(payload_N, use / design, truck);
    tyre.warnings.push_back(
        fmt::format("there are no \"Parameters\": those of a usual {} tyre that bears {:.0f} N were taken",
                    truck ? "truck" : "passenger car", payload_N));
  }
  tyre.nominal_N = settings.nominal_N;
  tyre.model = std::make_shared<TmeasyTyre>(settings);
  return tyre;
}

ChronoTyre ReadFiala(const Map& root) {
  const Map map = WithOtherKeys(root.Child("Fiala Parameters"));
  FialaSettings fiala;
  fiala.cslip_N = map.Number("CSLIP", {1.0, 1e9});
  fiala.calpha_N = map.Number("CALPHA", {1.0, 1e9});
  fiala.umin = map.Number("UMIN", {1e-3, 5.0});
  fiala.umax = map.Number("UMAX", {1e-3, 5.0});
  if (const std::string problem = FialaProblem(fiala); !problem.empty()) map.Problem("UMIN", problem);
  constexpr double kUsual_N = 4000.0;
  return {std::make_shared<FialaTyre>(fiala), "Fiala", kUsual_N, {}};
}

}  // namespace

base::Result<ChronoTyre> ReadChronoTyre(std::string_view text, std::string_view name) {
  const auto file = config::File::Parse(WithoutComments(text), name);
  if (!file) return file.error();
  const Map root = WithOtherKeys(file.value().root());
  const std::string kind = root.Text("Template", "");
  if (kind != "FialaTire" && kind != "TMeasyTire") {
    return base::WrongInput(
        "tyre.wrong_model",
        fmt::format("\"Template\" is '{}'; 'FialaTire' or 'TMeasyTire' was expected, or a tyre property file (.tir)",
                    kind),
        root.Has("Template") ? root.Place("Template") : std::string(name));
  }
  ChronoTyre tyre = kind == "FialaTire" ? ReadFiala(root) : ReadTmeasy(root);
  if (const base::Status status = file.value().Finish(); !status) return status.error();
  return tyre;
}

}  // namespace rodeira::dynamics
