// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/playback/player.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::scene {
namespace {

constexpr std::array kLadder = {Player::kSlowest, 0.2, 0.5, 1.0, 2.0, 5.0, Player::kFastest};

}  // namespace

Player::Player(std::int64_t end_ns, std::int64_t picture_ns) : end_ns_(end_ns), picture_ns_(picture_ns) {
  RODEIRA_ASSERT(end_ns >= 0 && picture_ns > 0);
}

void Player::Advance(double wall_s) {
  if (paused_) return;
  const double most_s = static_cast<double>(end_ns_) * 1e-9 + 1.0;
  const auto passed_ns = std::llround(std::clamp(speed_ * wall_s, 0.0, most_s) * 1e9);
  Seek(backward_ ? now_ns_ - passed_ns : now_ns_ + passed_ns);
  if (now_ns_ == (backward_ ? 0 : end_ns_)) paused_ = true;
}

void Player::Seek(std::int64_t time_ns) { now_ns_ = std::clamp<std::int64_t>(time_ns, 0, end_ns_); }

void Player::StepPicture(int direction) {
  paused_ = true;
  const std::int64_t at_ns = now_ns_ / picture_ns_ * picture_ns_;
  if (direction > 0)
    Seek(at_ns + picture_ns_);
  else
    Seek(at_ns < now_ns_ ? at_ns : at_ns - picture_ns_);
}

void Player::PlayOrPause() {
  paused_ = !paused_;
  if (!paused_ && now_ns_ == (backward_ ? 0 : end_ns_)) Seek(backward_ ? end_ns_ : 0);
}

void Player::set_speed(double speed) { speed_ = std::clamp(speed, kSlowest, kFastest); }

void Player::Faster() {
  set_speed(*std::find_if(kLadder.begin(), kLadder.end() - 1, [this](double rung) { return rung > speed_; }));
}

void Player::Slower() {
  set_speed(*std::find_if(kLadder.rbegin(), kLadder.rend() - 1, [this](double rung) { return rung < speed_; }));
}

}  // namespace rodeira::scene
