// SPDX-License-Identifier: Apache-2.0
// OpenDRIVE as it is drawn: what is taken is lines, paint and things, and ground of finite places.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "tests/property/drawn_ground.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("rodeira-fuzz-" + std::to_string(::getpid()) + ".xodr");
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto world = rodeira::road::World::Load(file);
  std::filesystem::remove(file);
  if (!world) return 0;
  if (const std::string wrong = rodeira::property::DrawnWrongly(*world.value()); !wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    std::abort();
  }
  return 0;
}
