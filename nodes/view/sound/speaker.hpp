// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/view/sound/synth.hpp"

namespace rodeira::nodes {

// The PC's sound, through SDL.
class Speaker {
 public:
  // A failure, in a sentence, where there is none.
  static base::Result<std::unique_ptr<Speaker>> Open();
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  // Goes on with this until it is called again; pictures come every `interval_s`. Never waits. Where it is not called
  // in time there is silence.
  void Play(const sound::Heard& heard, double interval_s);
  // How much is still to be heard.
  double queued_s() const;

 private:
  Speaker() = default;

  std::uint32_t device_ = 0;
  sound::Synth synth_;
  std::vector<float> samples_;
};

}  // namespace rodeira::nodes
