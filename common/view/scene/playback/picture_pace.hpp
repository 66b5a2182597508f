// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace rodeira::scene {

// What a display says of itself. It holds a window where showing a picture waits for its next refresh.
struct DisplayBeat {
  double rate_Hz = 0.0;  // 0: it does not say
  bool holds = false;
};

// When a window begins its next picture: as often as its display is refreshed, and no oftener. Where the display holds
// the window it has waited by then, and nothing is added; where it does not, the window counts the refreshes itself.
class PicturePace {
 public:
  static constexpr double kUnknown_Hz =
      60.0;  // also in place of less than 20 and more than 1000, which virtual displays say
  // A display that says that it holds and does not (a hidden window, a driver that is told otherwise) is held back
  // here, at so much of its period, which a display that does hold always exceeds.
  static constexpr double kHeldShare = 0.9;

  // The time on the wall from which on the next picture may begin, where this one began at `begin_s`; it may have
  // passed. `begin_s` must not fall from call to call.
  double Next(double begin_s, const DisplayBeat& beat);

 private:
  std::optional<double> due_s_;  // when this picture was to begin; nothing where only the display said so
};

}  // namespace rodeira::scene
