// SPDX-License-Identifier: Apache-2.0
// What a window says of the keys held in it, from SDL's events.
#include "nodes/view/run_connection/key_forwarder.hpp"

#include <SDL.h>
#include <gtest/gtest.h>

#include "common/runtime/launch/live_keys.hpp"

namespace rodeira::nodes {
namespace {

SDL_Event KeyEvent(SDL_Scancode scancode, bool down, bool repeat = false) {
  SDL_Event event{};
  event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
  event.key.keysym.scancode = scancode;
  event.key.repeat = repeat ? 1 : 0;
  return event;
}

SDL_Event ButtonEvent(Uint8 button, bool down) {
  SDL_Event event{};
  event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
  event.button.button = button;
  return event;
}

SDL_Event FocusLost() {
  SDL_Event event{};
  event.type = SDL_WINDOWEVENT;
  event.window.event = SDL_WINDOWEVENT_FOCUS_LOST;
  return event;
}

// Counts what is said.
class Ear final : public launch::LiveKeysSender {
 public:
  explicit Ear(std::vector<std::vector<launch::LiveKey>>& said) : said_(said) {}
  void Say(std::vector<launch::LiveKey> keys) override { said_.push_back(std::move(keys)); }

 private:
  std::vector<std::vector<launch::LiveKey>>& said_;
};

class Forwarder : public testing::Test {
 protected:
  std::vector<std::vector<launch::LiveKey>> said_;
  KeyForwarder forwarder_{std::make_unique<Ear>(said_)};
};

TEST_F(Forwarder, SaysEveryChangeAtOnceAndTheSameAgainSomeTimesASecond) {
  forwarder_.Tell(1.0);
  ASSERT_EQ(said_.size(), 1u) << "a window makes itself known";
  forwarder_.Tell(1.01);
  EXPECT_EQ(said_.size(), 1u);
  forwarder_.Take(KeyEvent(SDL_SCANCODE_UP, true));
  forwarder_.Tell(1.02);
  ASSERT_EQ(said_.size(), 2u);
  ASSERT_EQ(said_.back().size(), 1u);
  EXPECT_EQ(said_.back()[0].key, input_devices::KeyOf("up"));
  EXPECT_TRUE(said_.back()[0].held);
  EXPECT_EQ(said_.back()[0].presses, 1u);
  forwarder_.Tell(1.02 + 0.9 * KeyForwarder::kRepeat_s);
  EXPECT_EQ(said_.size(), 2u);
  forwarder_.Tell(1.02 + 1.1 * KeyForwarder::kRepeat_s);
  EXPECT_EQ(said_.size(), 3u);
  EXPECT_TRUE(said_.back()[0].held);
}

TEST_F(Forwarder, CountsPressesAndNotTheRepeatsOfAHeldKey) {
  forwarder_.Take(KeyEvent(SDL_SCANCODE_E, true));
  for (int i = 0; i < 5; ++i) forwarder_.Take(KeyEvent(SDL_SCANCODE_E, true, true));
  forwarder_.Take(KeyEvent(SDL_SCANCODE_E, false));
  forwarder_.Take(KeyEvent(SDL_SCANCODE_E, true));
  forwarder_.Take(KeyEvent(SDL_SCANCODE_E, false));
  forwarder_.Take(KeyEvent(SDL_SCANCODE_W, false));  // pressed elsewhere
  forwarder_.Tell(1.0);
  ASSERT_EQ(said_.back().size(), 1u);
  EXPECT_EQ(said_.back()[0].key, input_devices::KeyOf("e"));
  EXPECT_FALSE(said_.back()[0].held);
  EXPECT_EQ(said_.back()[0].presses, 2u);
}

TEST_F(Forwarder, MouseButtonsAreKeysToo) {
  forwarder_.Take(ButtonEvent(SDL_BUTTON_X2, true));
  forwarder_.Tell(1.0);
  ASSERT_EQ(said_.back().size(), 1u);
  EXPECT_EQ(said_.back()[0].key, input_devices::KeyOf("mouse_forward"));
}

TEST_F(Forwarder, WithoutTheFocusNothingIsHeld) {
  forwarder_.Take(KeyEvent(SDL_SCANCODE_UP, true));
  forwarder_.Take(KeyEvent(SDL_SCANCODE_LEFT, true));
  forwarder_.Take(FocusLost());
  forwarder_.Tell(1.0);
  ASSERT_EQ(said_.back().size(), 2u);
  for (const launch::LiveKey& key : said_.back()) EXPECT_FALSE(key.held) << key.key;
}

}  // namespace
}  // namespace rodeira::nodes
