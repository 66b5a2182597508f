// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/live/watched_display.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <thread>

#include "common/core/base/hash.hpp"

namespace rodeira::bench {
namespace {

// XWDFileHeader: big-endian words.
enum Word : std::size_t { kHeaderSize = 0, kBitsPerPixel = 11, kBytesPerLine = 12, kColours = 19, kWords = 25 };

std::size_t WordOf(std::span<const std::byte> file, Word word) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::size_t>(file[4 * word + i]);
  return value;
}

[[noreturn]] void Give(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::exit(1);
}

}  // namespace

WatchedDisplay::WatchedDisplay(int number, int width_px, int height_px)
    : name_(fmt::format(":{}", number)),
      width_px_(width_px),
      height_px_(height_px),
      folder_(std::filesystem::temp_directory_path() / fmt::format("rodeira-display-{}", ::getpid())) {
  std::filesystem::create_directories(folder_);
  server_ = std::make_unique<system_test::Started>(
      std::vector<std::string>{"/usr/bin/Xvfb", name_, "-screen", "0", fmt::format("{}x{}x24", width_px, height_px),
                               "-fbdir", folder_.string(), "-nolisten", "tcp"});
  const auto socket = fmt::format("/tmp/.X11-unix/X{}", number);
  const auto file = folder_ / "Xvfb_screen0";
  for (int tries = 0; tries < 100 && !(std::filesystem::exists(socket) && std::filesystem::exists(file)); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  if (!std::filesystem::exists(file))
    Give("Xvfb did not start: the package xvfb was expected, and no other server of display " + name_);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  Map();
}

WatchedDisplay::~WatchedDisplay() {
  ::munmap(const_cast<std::byte*>(file_.data()), file_.size());
  server_.reset();
  std::filesystem::remove_all(folder_);
}

void WatchedDisplay::Map() {
  const auto file = folder_ / "Xvfb_screen0";
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const std::size_t size = std::filesystem::file_size(file);
  void* memory = descriptor < 0 ? MAP_FAILED : ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
  if (descriptor >= 0) ::close(descriptor);
  if (memory == MAP_FAILED) Give("the display's memory cannot be read");
  file_ = {static_cast<const std::byte*>(memory), size};
  if (size < 4 * kWords || WordOf(file_, kBitsPerPixel) != 32)
    Give("the display's memory is no picture of 32 bits a pixel");
  pixels_ = WordOf(file_, kHeaderSize) + 12 * WordOf(file_, kColours);
  pitch_ = WordOf(file_, kBytesPerLine);
}

std::uint64_t WatchedDisplay::HashOf(int left, int top, int width, int height) const {
  base::Digest digest = 0;
  for (int y = top; y < top + height; ++y) {
    digest = base::Combine(digest, base::Hash(file_.subspan(pixels_ + static_cast<std::size_t>(y) * pitch_ +
                                                                4 * static_cast<std::size_t>(left),
                                                            4 * static_cast<std::size_t>(width))));
  }
  return digest;
}

std::uint32_t WatchedDisplay::Pixel(int x, int y) const {
  std::uint32_t pixel = 0;
  std::memcpy(&pixel, file_.data() + pixels_ + static_cast<std::size_t>(y) * pitch_ + 4 * static_cast<std::size_t>(x),
              sizeof pixel);
  return pixel;
}

std::size_t WatchedDisplay::Colours() const {
  std::set<std::uint32_t> colours;
  for (int y = 0; y < height_px_; y += 8) {
    for (int x = 0; x < width_px_; x += 8) colours.insert(Pixel(x, y));
  }
  return colours.size();
}

}  // namespace rodeira::bench
