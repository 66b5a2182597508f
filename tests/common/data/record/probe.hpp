// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/core/base/bytes.hpp"

// A type with everything that the project's IDL may use, encoded by Fast-CDR as Fast DDS does.
namespace rodeira::record::probe {

extern const char* const kIdl;  // of Sample and Tick

enum class Gear : std::uint32_t { kReverse, kNeutral, kFirst };

struct Header {
  std::int64_t step = 0;
  std::int64_t time_ns = 0;
  std::uint32_t source = 0;
};

struct Wheel {
  double angle_rad = 0;
  float slip = 0;
  std::uint8_t flag = 0;
};

struct Sample {
  Header header;
  std::uint8_t small = 0;
  double x_m = 0;
  bool on = false;
  std::uint64_t big = 0;
  std::int16_t little = 0;
  std::uint8_t odd = 0;
  std::vector<double> values;
  std::uint8_t after = 0;
  std::vector<Wheel> wheels;
  std::vector<std::string> names;
  std::string text;
  Gear gear = Gear::kReverse;
  std::vector<Gear> gears;
  std::array<double, 3> triple{};
  std::array<std::array<double, 3>, 2> grid{};
  std::vector<std::uint8_t> raw;
  std::vector<std::int64_t> longs;
  std::uint32_t last = 0;
};

struct Tick {
  Header header;
  std::uint64_t digest = 0;
};

Sample MakeSample(std::uint64_t n);  // values by counter-based random numbers; containers may be empty
Tick MakeTick(std::uint64_t n);

// The serialised payload with its encapsulation header; padding is zero.
base::Bytes Encode(const Sample& sample);
base::Bytes Encode(const Tick& tick);

// JSON text as tests/record-npm/check.mjs expects it.
std::string Json(const Sample& sample);
std::string Json(const Tick& tick);

}  // namespace rodeira::record::probe
