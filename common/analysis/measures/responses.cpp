// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/responses.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

Response ResponseAt(std::size_t sample, double rate_hz, const ResponseOptions& options) {
  const double time_s = static_cast<double>(sample) / rate_hz;
  return {time_s, time_s < options.anticipation_s ? ResponseFlag::kAnticipation : ResponseFlag::kResponse};
}

// Nothing can be said of a signal with a missing sample before its response.
std::optional<Response> Unknown(Series signal) {
  if (signal.empty() || std::isnan(signal[0])) return Response{std::nullopt, ResponseFlag::kNoSignal};
  return std::nullopt;
}

struct Release {
  std::optional<std::size_t> begins, released;
  ResponseFlag flag = ResponseFlag::kCensored;
};

Release FindRelease(Series throttle, const ResponseOptions& options) {
  if (throttle.empty() || std::isnan(throttle[0])) return {std::nullopt, std::nullopt, ResponseFlag::kNoSignal};
  if (throttle[0] < options.released) return {std::nullopt, std::nullopt, ResponseFlag::kPre};
  Release release;
  const double begun = (1.0 - options.release_share) * throttle[0];
  for (std::size_t i = 1; i < throttle.size(); ++i) {
    if (std::isnan(throttle[i])) return {std::nullopt, std::nullopt, ResponseFlag::kNoSignal};
    if (throttle[i] >= begun) release.begins.reset();  // pressed again: that was no release
    if (throttle[i] < begun && !release.begins) release.begins = i;
    if (throttle[i] >= options.released) continue;
    release.released = i;
    return release;
  }
  return {std::nullopt, std::nullopt, ResponseFlag::kCensored};
}

}  // namespace

const char* NameOf(ResponseFlag flag) {
  switch (flag) {
    case ResponseFlag::kResponse:
      return "response";
    case ResponseFlag::kPre:
      return "pre: already responding at the event";
    case ResponseFlag::kAnticipation:
      return "anticipation";
    case ResponseFlag::kCensored:
      return "censored: no response before the window ends";
    case ResponseFlag::kNoSignal:
      return "a sample is missing";
  }
  return "";
}

Measure AsMeasure(const Response& response, Series signal, double rate_hz, const ResponseOptions& options) {
  const UsedOptions used = Used({{"release_share", options.release_share},
                                 {"released", options.released},
                                 {"brake_onset", options.brake_onset},
                                 {"full_brake_share", options.full_brake_share},
                                 {"steering_deg", options.steering_deg},
                                 {"steering_hold_s", options.steering_hold_s},
                                 {"anticipation_s", options.anticipation_s},
                                 {"sample_period_s", 1.0 / rate_hz},
                                 {"flag", NameOf(response.flag)}});
  return FoundOr(response.time_s, NameOf(response.flag), "s", CountValid(signal), signal.size(), used);
}

Response AcceleratorRelease(Series throttle, double rate_hz, const ResponseOptions& options) {
  const Release release = FindRelease(throttle, options);
  if (!release.begins) return {std::nullopt, release.flag};
  return ResponseAt(*release.begins, rate_hz, options);
}

Response AcceleratorReleased(Series throttle, double rate_hz, const ResponseOptions& options) {
  const Release release = FindRelease(throttle, options);
  if (!release.released) return {std::nullopt, release.flag};
  return ResponseAt(*release.released, rate_hz, options);
}

Response BrakeOnset(Series brake, double rate_hz, const ResponseOptions& options) {
  if (const auto unknown = Unknown(brake)) return *unknown;
  if (brake[0] > options.brake_onset) return {std::nullopt, ResponseFlag::kPre};
  for (std::size_t i = 1; i < brake.size(); ++i) {
    if (std::isnan(brake[i])) return {std::nullopt, ResponseFlag::kNoSignal};
    if (brake[i] > options.brake_onset) return ResponseAt(i, rate_hz, options);
  }
  return {std::nullopt, ResponseFlag::kCensored};
}

Response TimeToFullBrake(Series brake, double rate_hz, const ResponseOptions& options) {
  const Response onset = BrakeOnset(brake, rate_hz, options);
  const auto largest = Maximum(brake);
  if (!onset.time_s || !largest) return {std::nullopt, onset.flag};
  const auto from = static_cast<std::size_t>(std::llround(*onset.time_s * rate_hz));
  std::size_t i = from;
  while (i + 1 < brake.size() && !(brake[i] >= options.full_brake_share * *largest)) ++i;
  return {static_cast<double>(i - from) / rate_hz, onset.flag};
}

Response SteeringOnset(Series wheel_deg, double rate_hz, const ResponseOptions& options) {
  if (const auto unknown = Unknown(wheel_deg)) return *unknown;
  const auto hold =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(options.steering_hold_s * rate_hz - 1e-9)));
  std::size_t held = 0;
  for (std::size_t i = 1; i < wheel_deg.size(); ++i) {
    if (std::isnan(wheel_deg[i])) return {std::nullopt, ResponseFlag::kNoSignal};
    held = std::abs(wheel_deg[i] - wheel_deg[0]) > options.steering_deg ? held + 1 : 0;
    if (held == hold) return ResponseAt(i + 1 - hold, rate_hz, options);
  }
  return {std::nullopt, ResponseFlag::kCensored};
}

Response MovementTime(Series throttle, Series brake, double rate_hz, const ResponseOptions& options) {
  const Response released = AcceleratorReleased(throttle, rate_hz, options);
  const Response onset = BrakeOnset(brake, rate_hz, options);
  if (!released.time_s) return {std::nullopt, released.flag};
  if (!onset.time_s) return {std::nullopt, onset.flag};
  return {*onset.time_s - *released.time_s, released.flag};
}

Response FirstResponse(Series throttle, Series brake, Series wheel_deg, double rate_hz,
                       const ResponseOptions& options) {
  Response first;
  for (const Response& response : {AcceleratorRelease(throttle, rate_hz, options), BrakeOnset(brake, rate_hz, options),
                                   SteeringOnset(wheel_deg, rate_hz, options)}) {
    if (!response.time_s) {
      if (!first.time_s && response.flag == ResponseFlag::kNoSignal) first.flag = response.flag;
      continue;
    }
    if (!first.time_s || *response.time_s < *first.time_s) first = response;
  }
  return first;
}

}  // namespace rodeira::measures
