// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/playback/replay_keys.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/vehicle/input_devices/key_names.hpp"
#include "nodes/view/window/view_window.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// 1 to 9, where the key is one of them.
std::optional<int> DigitOf(int symbol) {
  if (symbol >= SDLK_1 && symbol <= SDLK_9) return symbol - SDLK_1 + 1;
  if (symbol >= SDLK_KP_1 && symbol <= SDLK_KP_9) return symbol - SDLK_KP_1 + 1;
  return std::nullopt;
}

void Move(scene::Player& player, int direction, int modifiers) {
  if ((modifiers & KMOD_CTRL) != 0) return player.Seek(player.now_ns() + 10 * direction * kSecond_ns);
  if ((modifiers & KMOD_SHIFT) != 0) return player.Seek(player.now_ns() + direction * kSecond_ns);
  player.StepPicture(direction);
}

void GoToMark(scene::Player& player, const std::vector<std::int64_t>& marks_ns, int direction) {
  if (direction > 0) {
    const auto next = std::upper_bound(marks_ns.begin(), marks_ns.end(), player.now_ns());
    if (next != marks_ns.end()) player.Seek(*next);
  } else {
    const auto here = std::lower_bound(marks_ns.begin(), marks_ns.end(), player.now_ns());
    if (here != marks_ns.begin()) player.Seek(*std::prev(here));
  }
}

}  // namespace

bool TakeReplayKey(scene::Player& player, const std::vector<std::int64_t>& marks_ns, int symbol, int modifiers) {
  if (const auto digit = DigitOf(symbol)) {
    player.Seek(player.end_ns() / 10 * *digit);
    return true;
  }
  switch (symbol) {
    case SDLK_SPACE:
      player.PlayOrPause();
      return true;
    case SDLK_RIGHT:
      Move(player, 1, modifiers);
      return true;
    case SDLK_LEFT:
      Move(player, -1, modifiers);
      return true;
    case SDLK_HOME:
      player.Seek(0);
      return true;
    case SDLK_END:
      player.Seek(player.end_ns());
      return true;
    case SDLK_PAGEDOWN:
      GoToMark(player, marks_ns, 1);
      return true;
    case SDLK_PAGEUP:
      GoToMark(player, marks_ns, -1);
      return true;
    case SDLK_PLUS:
    case SDLK_EQUALS:
    case SDLK_KP_PLUS:
      player.Faster();
      return true;
    case SDLK_MINUS:
    case SDLK_KP_MINUS:
      player.Slower();
      return true;
    case SDLK_r:
      player.Reverse();
      return true;
    default:
      return false;
  }
}

std::string ReplayHelp() {
  std::string text =
      "space  play, pause\n"
      "left right  one picture; with shift 1 s, with ctrl 10 s\n"
      "home end  beginning, end\n"
      "1 to 9  a tenth to nine tenths\n"
      "page up, page down  mark before, behind\n"
      "+ -  faster, slower: 0.1 to 10 x\n"
      "r  the other way\n"
      "mouse on the bar  there\n";
  const auto is_a_recordings = [](const input_devices::WindowKey& key) {
    const bool own = key.name == "space" || key.name == "return" || key.name == "escape",
               asks = key.name == "f2" || key.name == "f6" || key.name == "f7";  // of a run that goes on
    return !own && !asks;
  };
  text += "\n" + input_devices::WindowKeysText(is_a_recordings);
  return text + MouseHelp(kLeftButton) + "\nescape  end";
}

std::string ReplayKeysInShort() { return "space  left right  + -  r  h: keys"; }

}  // namespace rodeira::nodes
