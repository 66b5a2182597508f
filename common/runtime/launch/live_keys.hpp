// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

// The border over which a window's keys reach the node that drives by them. No part of the lockstep: what an input node
// takes at an activation becomes its sample, and that is what a run remembers (law L5).
namespace rodeira::launch {

// A key of a window; the numbers are those of common/vehicle/input_devices/keys.hpp.
struct LiveKey {
  std::uint32_t key = 0;
  bool held = false;
  std::uint32_t presses = 0;  // so often since the window opened
};

// One message of a window: its whole state. A lost one does not matter, the next says the same.
struct LiveKeysSaid {
  std::uint64_t window = 0;  // random
  std::uint64_t number = 0;  // grows with every message of the window
  std::vector<LiveKey> keys;
};

// For the node that drives: all windows of the run together.
struct KeysNow {
  std::map<std::uint32_t, std::uint32_t> presses;  // of each key: how often since the last time that it was asked
  std::vector<std::uint32_t> held;                 // ascending

  // Whether the key is down in any window.
  bool Holds(std::uint32_t key) const;
  // 0 where it was not pressed.
  std::uint32_t PressesOf(std::uint32_t key) const;
};

// A window's side: publishes its keys.
class LiveKeysSender {
 public:
  virtual ~LiveKeysSender() = default;
  // All keys that have ever been down in this window. Never waits.
  virtual void Say(std::vector<LiveKey> keys) = 0;
};

// The input node's side: keys of all windows, merged.
class LiveKeysReceiver {
 public:
  virtual ~LiveKeysReceiver() = default;
  // What is held now, and pressed since the last call. Never waits.
  virtual KeysNow Take() = 0;
};

// What the windows have said, merged. A window that says nothing for kSilence_s has let go of everything: it was
// closed, was killed, hangs, or lost its network. Any thread may call; the caller says what time it is.
class LiveKeysMemory {
 public:
  static constexpr double kSilence_s = 0.5;
  static constexpr double kForget_s = 60.0;

  // A message that is not newer than another one of its window changes nothing. Presses before a window's first message
  // do not count.
  void Hear(const LiveKeysSaid& said, double now_s);
  // As LiveKeysReceiver::Take. now_s: of one clock that never jumps.
  KeysNow Take(double now_s);

 private:
  struct Window {
    std::uint64_t number = 0;
    double heard_s = 0.0;
    std::vector<LiveKey> keys;
  };
  std::mutex mutex_;
  std::map<std::uint64_t, Window> windows_;
  std::map<std::uint32_t, std::uint32_t> presses_;  // not taken yet
};

// Seconds of a clock on the wall that never jumps.
double WallSeconds();
// A number for a window that no other has.
std::uint64_t DrawWindow();

// The border within one process. It outlives what it makes.
class LiveKeysBoard {
 public:
  // Any thread may call.
  std::unique_ptr<LiveKeysSender> MakeSender();
  std::unique_ptr<LiveKeysReceiver> MakeReceiver();

 private:
  class Sender;
  class Receiver;
  void Say(const LiveKeysSaid& said);
  std::mutex mutex_;
  std::vector<std::shared_ptr<LiveKeysMemory>> memories_;  // one for each receiver
};

}  // namespace rodeira::launch
