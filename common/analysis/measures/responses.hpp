// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Responses of the driver to an event at the first sample of the series, which go on to the end of the window.
struct ResponseOptions {
  double release_share = 0.10;     // the accelerator begins to be released: below (1 - this) of its value at the event
  double released = 0.01;          // and is released below this travel
  double brake_onset = 0.01;       // of the brake's travel
  double full_brake_share = 0.95;  // full brake: this share of the largest travel in the window
  double steering_deg = 2.0;       // of the steering wheel, from its angle at the event
  double steering_hold_s = 0.1;    // so long
  double anticipation_s = 0.15;    // a response that is earlier is flagged
};

// Why there is no time, or what is to be known of it.
enum class ResponseFlag {
  kResponse,
  kPre,           // already braking, or released, at the event: no response
  kAnticipation,  // a time that is shorter than anticipation_s
  kCensored,      // none before the window ends: missing, never the window's length
  kNoSignal,      // a sample is missing
};
// In a few words, as the reason of a missing time.
const char* NameOf(ResponseFlag flag);

// Seconds after the event, which is the series' beginning; nothing where the flag says so.
struct Response {
  std::optional<double> time_s;
  ResponseFlag flag = ResponseFlag::kCensored;
};
// As a measure: the reason of a missing time is the flag's; an anticipation stands in the options.
Measure AsMeasure(const Response& response, Series signal, double rate_hz, const ResponseOptions& options);

// The time at which the throttle begins to fall by release_share, where it comes to `released` afterwards.
Response AcceleratorRelease(Series throttle, double rate_hz, const ResponseOptions& options);
// The time at which it is released.
Response AcceleratorReleased(Series throttle, double rate_hz, const ResponseOptions& options);
// The time at which the brake is pressed.
Response BrakeOnset(Series brake, double rate_hz, const ResponseOptions& options);
// The time from the brake's onset to full_brake_share of its largest travel.
Response TimeToFullBrake(Series brake, double rate_hz, const ResponseOptions& options);
// The time at which the steering wheel begins to turn.
Response SteeringOnset(Series wheel_deg, double rate_hz, const ResponseOptions& options);
// From released accelerator to brake onset. Missing where one of them is.
Response MovementTime(Series throttle, Series brake, double rate_hz, const ResponseOptions& options);
// The earliest of release, brake and steering that is a response.
Response FirstResponse(Series throttle, Series brake, Series wheel_deg, double rate_hz, const ResponseOptions& options);

}  // namespace rodeira::measures
