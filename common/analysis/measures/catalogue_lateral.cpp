// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/lane_change.hpp"
#include "common/analysis/measures/lane_departure.hpp"
#include "common/analysis/measures/lane_position.hpp"
#include "common/analysis/measures/time_to_line.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoLanePosition = "no sample with a lane position";

std::span<const std::int8_t> CrossingOf(const DriveCut& cut) {
  return std::span(cut.drive.crossing).subspan(cut.from, cut.to - cut.from);
}

std::vector<LaneChange> ChangesIn(const DriveCut& cut, double onset_mps) {
  return LaneChanges(cut(cut.drive.lane_position_m), CrossingOf(cut), cut.drive.rate_hz, {.onset_mps = onset_mps});
}

// The lane position, without lane changes where that is asked for.
std::vector<double> PositionIn(const DriveCut& cut, const OptionValues& o) {
  const Series y = cut(cut.drive.lane_position_m);
  if (o["cut_lane_changes"] == 0.0) return {y.begin(), y.end()};
  return WithoutLaneChanges(y, ChangesIn(cut, o["onset_mps"]));
}

// What was cut stands beside the other options; the valid share counts what is left.
Measure WithCut(Measure measure, const OptionValues& o) {
  measure.options.push_back(Used({{"cut_lane_changes", static_cast<int>(o["cut_lane_changes"])}}).front());
  measure.options.push_back(Used({{"onset_mps", o["onset_mps"]}}).front());
  measure.options.push_back({"reference_point", "B, midway between the axles"});
  measure.options.push_back({"junctions", "left out"});
  return measure;
}

LanePosition PositionOf(const DriveCut& cut, Series y) {
  return {y, std::span(cut.drive.episode).subspan(cut.from, cut.to - cut.from)};
}

Denominator DenominatorOf(const OptionValues& o) { return o["ddof"] == 0.0 ? Denominator::kN : Denominator::kNMinus1; }

const OptionInfo kCutChanges{"cut_lane_changes", 1, 0, 1, "1: samples of lane changes are left out; 0: they stay"};
const OptionInfo kOnset{"onset_mps", 0.1, 0.001, 10, "a lane change begins and ends below this lateral speed"};
const OptionInfo kDdof{"ddof", 1, 0, 1, "0: the sum of squares is divided by n, 1: by n - 1"};

// Over the lines that count, one after the other.
struct LineDepartures {
  std::vector<Departure> departures;
  std::vector<double> nearer_m;
};

DepartureOptions DepartureOptionsOf(const OptionValues& o) { return {o["hysteresis_m"], o["min_duration_s"]}; }

constexpr std::array kSides{"both", "left", "right"};
std::size_t SideOf(const OptionValues& o) { return static_cast<std::size_t>(std::lround(o["side"])); }

// Distances of the part from the edge that counts, of the left line, the right one or both.
std::vector<std::vector<double>> LinesOf(const DriveCut& cut, const OptionValues& o) {
  std::vector<std::vector<double>> lines;
  for (const Series line : {cut(cut.drive.left_line_m), cut(cut.drive.right_line_m)}) {
    lines.emplace_back(line.begin(), line.end());
    for (double& inside_m : lines.back()) inside_m += o["inset_m"] + o["paint_m"];
  }
  if (SideOf(o) == 1) lines.pop_back();
  if (SideOf(o) == 2) lines.erase(lines.begin());
  return lines;
}

// intended: an indicator is on, or it belongs to a lane change.
LineDepartures DeparturesIn(const DriveCut& cut, const OptionValues& o) {
  const auto lines = LinesOf(cut, o);
  const Series indicator = cut(cut.drive.indicator);
  LineDepartures found;
  for (std::size_t i = 0; i < lines.front().size(); ++i)
    found.nearer_m.push_back(std::fmin(lines.front()[i], lines.back()[i]));
  std::vector<std::uint8_t> intended(indicator.size());
  for (std::size_t i = 0; i < intended.size(); ++i) intended[i] = indicator[i] > 0.0 ? 1 : 0;
  for (const LaneChange& change : ChangesIn(cut, 0.1)) {
    for (std::size_t i = change.begin; i <= change.end && i < intended.size(); ++i) intended[i] = 1;
  }
  for (const Series line : lines) {
    for (const Departure& departure : Departures(line, cut.drive.rate_hz, DepartureOptionsOf(o), intended)) {
      if (!departure.intended) found.departures.push_back(departure);
    }
  }
  return found;
}

// of: DepartureCount and the like.
template <auto of>
Measure OfDepartures(const DriveCut& cut, const OptionValues& o) {
  const LineDepartures found = DeparturesIn(cut, o);
  Measure measure = of(found.departures, found.nearer_m, DepartureOptionsOf(o));
  const char* side = kSides[SideOf(o)];
  for (const UsedOption& option : Used({{"side", side}, {"inset_m", o["inset_m"]}, {"paint_m", o["paint_m"]}}))
    measure.options.push_back(option);
  measure.options.push_back({"intended", "left out: indicator on, or a lane change"});
  return measure;
}

const std::vector<OptionInfo> kDepartureOptions{
    {"hysteresis_m", 0.1, 0, 5, "a departure ends where the part is again so far inside"},
    {"min_duration_s", 0.2, 0, 60, "shorter departures do not count"},
    {"side", 0, 0, 2, "0: both lines, 1: the left one, 2: the right one"},
    {"inset_m", 0, 0, 1, "the part: 0: the body's side; else so far inside it, such as a tyre's outer edge"},
    {"paint_m", 0, -0.5, 0.5, "the edge that counts, outwards from the middle of the paint"}};

// TLC 1 or 2 of the line that is approached: of the footprint, within each time in one lane.
std::vector<double> TlcByDistance(const DriveCut& cut, bool second_order, double horizon_s) {
  std::vector<double> tlc(cut.to - cut.from, kMissing);
  for (const std::vector<double>* line : {&cut.drive.left_line_m, &cut.drive.right_line_m}) {
    const Series distance = cut(*line);
    for (const SampleRun& run : LaneRuns(PositionOf(cut, distance))) {
      const Series part = distance.subspan(run.from, run.size());
      const auto slope = Derivative(part, cut.drive.rate_hz), bend = Derivative(slope, cut.drive.rate_hz);
      for (std::size_t i = 0; i < part.size(); ++i) {
        const double t =
            second_order ? SecondOrderTlc_s(part[i], -slope[i], -bend[i]) : FirstOrderTlc_s(part[i], -slope[i]);
        if (t <= horizon_s) tlc[run.from + i] = std::fmin(tlc[run.from + i], t);
      }
    }
  }
  return tlc;
}

std::vector<double> TlcIn(const DriveCut& cut, const OptionValues& o) {
  const Drive& d = cut.drive;
  const double horizon_s = o["horizon_s"];
  if (o["method"] >= 0.5) return TlcByDistance(cut, o["method"] >= 1.5, horizon_s);
  std::vector<double> tlc;
  for (std::size_t i = cut.from; i < cut.to; ++i) {
    tlc.push_back(TrigonometricTlc_s({d.lane_position_m[i], d.heading_error_rad[i], d.speed_mps[i], d.yaw_radps[i],
                                      d.lane_width_m[i], d.lane_curvature_1pm[i], d.front_m, d.width_m},
                                     horizon_s));
  }
  return tlc;
}

Measure TlcMeasure(const DriveCut& cut, const OptionValues& o, const Measure& of, const char* unit) {
  UsedOptions used = Used({{"horizon_s", o["horizon_s"]}});
  if (o["method"] >= 0.5)
    used.push_back({"method", o["method"] >= 1.5 ? "TLC 2, of the footprint" : "TLC 1, of the footprint"});
  else
    for (const UsedOption& option :
         Used({{"method", "trigonometric"}, {"corner", "front"}, {"lane_ahead", "circle of its curvature here"}}))
      used.push_back(option);
  const std::size_t valid = CountValid(cut(cut.drive.lane_position_m)), all = cut.to - cut.from;
  if (valid == 0) return NotFound(kNoLanePosition, unit, 0, all, used);
  if (!of.value) return NotFound("no line is reached within the horizon", unit, valid, all, used);
  Measure found = Found(*of.value, unit, valid, all, used);
  found.options.insert(found.options.end(), of.options.begin(), of.options.end());
  return found;
}

const OptionInfo kHorizon{"horizon_s", 20, 0.1, 60, "a line that is reached later is not reached"};
const OptionInfo kMethod{"method", 0, 0, 2,
                         "0: trigonometric; 1: d / d'; 2: d / (d' + d'' 1 s), d the line's distance"};
constexpr const char* kTlcEquation =
    "first t >= 0 at which a front corner, going on with v and yaw rate, is on a line of the lane";
constexpr const char* kTlcTraps =
    "missing where no line is reached; in tight bends the rear corners may cross first; TLC 1 has poor minima";

}  // namespace

std::vector<MeasureInfo> LateralMeasures() {
  const char* family = "lane";
  return {
      {"lane_position_mean_m",
       family,
       "mean position in the lane, positive to the left",
       "mean of y",
       "missing in junctions and beside the road; the reference point is B, midway between the axles",
       "SAE J2944",
       {kCutChanges, kOnset},
       [](const DriveCut& cut, const OptionValues& o) { return WithCut(MeanOf(PositionIn(cut, o), "m"), o); }},
      {"sdlp_m",
       family,
       "standard deviation of lateral position, pooled over lanes",
       "sqrt(sum((n_i - 1) s_i^2) / sum(n_i - 1)) over the times i in one lane",
       "a lane change makes metres of centimetres; longer drives have larger values",
       "SAE J2944 10.1.3",
       {kDdof, kCutChanges, kOnset, {"min_valid_share", 0.85, 0, 1, "below, the value is missing"}},
       [](const DriveCut& cut, const OptionValues& o) {
         const auto y = PositionIn(cut, o);
         return WithCut(Sdlp(PositionOf(cut, y), {DenominatorOf(o), o["min_valid_share"]}), o);
       }},
      {"modified_sdlp_m",
       family,
       "the same behind a high-pass of 0.1 Hz",
       "SD of y behind a Butterworth high-pass of order 2, pooled",
       "two passes halve a wave at the cut-off and reflect 0.09 s at each end, at every sample rate; needs 30 s",
       "Oestlund et al. 2005",
       {kDdof,
        kCutChanges,
        kOnset,
        {"cutoff_hz", 0.1, 0.001, 5, "of the high-pass"},
        {"passes", 2, 1, 2, "2: forward and backward; 1: forward"},
        {"min_duration_s", 30, 1, 3600, "shorter times in one lane are left out"}},
       [](const DriveCut& cut, const OptionValues& o) {
         const auto y = PositionIn(cut, o);
         return WithCut(ModifiedSdlp(PositionOf(cut, y), cut.drive.rate_hz,
                                     {DenominatorOf(o), o["cutoff_hz"], o["passes"] == 2.0, o["min_duration_s"]}),
                        o);
       }},
      {"lane_changes_n",
       family,
       "number of lane changes",
       "crossings of the reference point into the next lane of the same road",
       "an aborted change is a departure",
       "SAE J2944",
       {kOnset},
       [](const DriveCut& cut, const OptionValues& o) {
         const Series y = cut(cut.drive.lane_position_m);
         if (CountValid(y) == 0) return NotFound(kNoLanePosition, "1", 0, y.size());
         return Found(static_cast<double>(ChangesIn(cut, o["onset_mps"]).size()), "1", CountValid(y), y.size());
       }},
      {"lane_departures_n", family, "number of unintended departures over a line",
       "runs in which the part is beyond the edge of a line", "without hysteresis one excursion is ten",
       "SAE J2944 10.2.4", kDepartureOptions, OfDepartures<DepartureCount>},
      {"lane_departures_share", family, "share of time in them", "time in departures / time with a lane",
       "of the time with a lane, not of the interval", "SAE J2944 10.2.4", kDepartureOptions,
       OfDepartures<DepartureShare>},
      {"lane_departure_greatest_m", family, "greatest distance beyond a line", "max of the distance beyond the line",
       "missing, not 0, without a departure", "SAE J2944 10.2.4", kDepartureOptions, OfDepartures<DepartureGreatest>},
      {"lane_departure_area_ms", family, "integral of the distance beyond a line", "sum of distance dt",
       "0 without a departure", "SAE J2944 10.2.4", kDepartureOptions, OfDepartures<DepartureArea>},
      {"heading_error_mean_deg",
       family,
       "mean heading against the lane, positive to the left",
       "atan2(sum sin e, sum cos e) of the wrapped difference e",
       "lane changes are in it; missing in junctions",
       "SAE J2944",
       {},
       [](const DriveCut& cut, const OptionValues&) {
         const Series error = cut(cut.drive.heading_error_rad);
         const auto mean_rad = CircularMean(error);
         return FoundOr(mean_rad ? std::optional(*mean_rad * 180.0 / std::numbers::pi) : std::nullopt, kNoLanePosition,
                        "deg", CountValid(error), error.size());
       }},
      {"heading_error_sd_deg",
       family,
       "standard deviation of the heading against the lane",
       "SD of the wrapped difference",
       "lane changes are in it; missing in junctions",
       "SAE J2944",
       {kDdof},
       [](const DriveCut& cut, const OptionValues& o) {
         const Series error = cut(cut.drive.heading_error_rad);
         std::vector<double> deg(error.begin(), error.end());
         for (double& e : deg) e *= 180.0 / std::numbers::pi;
         return DeviationOf(deg, "deg", DenominatorOf(o));
       }},
      {"tlc_min_s",
       family,
       "least time to line crossing (trigonometric)",
       kTlcEquation,
       kTlcTraps,
       "van Winsum et al. 2000",
       {kHorizon, kMethod},
       [](const DriveCut& cut, const OptionValues& o) {
         return TlcMeasure(cut, o, MinimumOf(TlcIn(cut, o), "s"), "s");
       }},
      {"tlc_p15_s",
       family,
       "15th percentile of the minima of all approaches",
       kTlcEquation,
       kTlcTraps,
       "van Winsum et al. 2000",
       {kHorizon, kMethod},
       [](const DriveCut& cut, const OptionValues& o) {
         return TlcMeasure(cut, o, QuantileOf(ApproachMinima(TlcIn(cut, o)), "s", 0.15), "s");
       }},
      {"tlc_below_share",
       family,
       "share of time with a time to line crossing below a threshold",
       kTlcEquation,
       kTlcTraps,
       "van Winsum et al. 2000",
       {kHorizon, kMethod, {"threshold_s", 1, 0.01, 60, "of the time to line crossing"}},
       [](const DriveCut& cut, const OptionValues& o) {
         std::vector<double> tlc = TlcIn(cut, o);
         const Series y = cut(cut.drive.lane_position_m);
         // A line that is not reached in time counts as far away.
         for (std::size_t i = 0; i < tlc.size(); ++i) {
           if (std::isnan(tlc[i]) && !std::isnan(y[i])) tlc[i] = o["horizon_s"];
         }
         return TlcMeasure(cut, o, ShareBelow(tlc, o["threshold_s"]), "1");
       }},
  };
}

}  // namespace rodeira::measures
