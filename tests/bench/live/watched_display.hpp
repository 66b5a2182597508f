// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "tests/system/command.hpp"

namespace rodeira::bench {

// A display of its own (Xvfb) with its pixels in this process's memory as they are shown: watching them costs the run
// nothing but reading.
class WatchedDisplay {
 public:
  // Ends the program with a sentence where Xvfb is missing or does not start.
  WatchedDisplay(int number, int width_px, int height_px);
  ~WatchedDisplay();
  WatchedDisplay(const WatchedDisplay&) = delete;
  WatchedDisplay& operator=(const WatchedDisplay&) = delete;

  // ":99"
  const std::string& name() const { return name_; }
  // Of the pixels of a rectangle, which lies on the display: equal rectangles have equal hashes.
  std::uint64_t HashOf(int left, int top, int width, int height) const;
  // How many different pixels every eighth of them in both directions are.
  std::size_t Colours() const;

 private:
  std::uint32_t Pixel(int x, int y) const;
  void Map();

  std::string name_;
  int width_px_, height_px_;
  std::filesystem::path folder_;
  std::unique_ptr<system_test::Started> server_;
  std::span<const std::byte> file_;     // XWD, mapped
  std::size_t pixels_ = 0, pitch_ = 0;  // in bytes: where they begin, from line to line
};

}  // namespace rodeira::bench
