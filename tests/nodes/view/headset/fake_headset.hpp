// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

// What a test and the OpenXR runtime that is none (fake_openxr.cpp) tell each other: the runtime is a library that
// OpenXR's loader finds by its manifest, and the test opens the same one.
struct FakeHeadset {
  // The test's.
  bool plugged_in = true;
  bool egl = true;  // it offers OpenGL by EGL
  std::array<XrView, 2> views{};
  bool knows_where = true;
  bool takes_off = false;     // at the next question: asks the session to end
  bool loses_frames = false;  // waiting for a frame fails from now on
  // The runtime's.
  bool by_glx = false;          // the session's OpenGL is a window's of X11 …
  std::string refused;          // … or why it was not taken
  std::atomic<int> frames = 0;  // that were ended
  int layers = 0;               // of the last of them
  int width_px = 0, height_px = 0;
  std::array<std::vector<std::uint8_t>, 2> rgba{};  // of the last one with a layer; rows from below
  std::array<XrView, 2> said{};                     // from where the view says that they were drawn
  int living = 0;  // instances, sessions, spaces and swapchains that were not destroyed
  int wrong = 0;   // calls in an order that OpenXR forbids
};
