// SPDX-License-Identifier: Apache-2.0
#include "tests/common/data/record/probe.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "common/core/base/random.hpp"

namespace rodeira::record::probe {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

void Put(Cdr& cdr, const Header& header) { cdr << header.step << header.time_ns << header.source; }

void Put(Cdr& cdr, const Wheel& wheel) { cdr << wheel.angle_rad << wheel.slip << wheel.flag; }

void Put(Cdr& cdr, const Sample& s) {
  Put(cdr, s.header);
  cdr << s.small << s.x_m << s.on << s.big << s.little << s.odd << s.values << s.after;
  cdr << static_cast<std::uint32_t>(s.wheels.size());
  for (const Wheel& wheel : s.wheels) Put(cdr, wheel);
  cdr << s.names << s.text << static_cast<std::uint32_t>(s.gear) << static_cast<std::uint32_t>(s.gears.size());
  for (const Gear gear : s.gears) cdr << static_cast<std::uint32_t>(gear);
  cdr << s.triple << s.grid << s.raw << s.longs << s.last;
}

void Put(Cdr& cdr, const Tick& tick) {
  Put(cdr, tick.header);
  cdr << tick.digest;
}

template <class T>
base::Bytes EncodeAny(const T& value) {
  base::Bytes bytes(16'384);  // zeros: Fast-CDR passes over padding without writing it
  FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  Put(cdr, value);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

std::string Json(const Header& header) {
  return fmt::format(R"({{"step":"{}","time_ns":"{}","source":{}}})", header.step, header.time_ns, header.source);
}

// Exactly what the wire carries: the float's value as the double that it is.
std::string Json(const Wheel& wheel) {
  return fmt::format(R"({{"angle_rad":{},"slip":{},"flag":{}}})", wheel.angle_rad, static_cast<double>(wheel.slip),
                     wheel.flag);
}

template <class List, class Format>
std::string JsonList(const List& list, Format format) {
  std::vector<std::string> texts;
  for (const auto& one : list) texts.push_back(format(one));
  return fmt::format("[{}]", fmt::join(texts, ","));
}

template <class T>
std::string Number(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(value)) return "null";  // as JSON.stringify says
  }
  return fmt::format("{}", value);
}

std::string Numbers(const auto& list) {
  return JsonList(list, [](auto value) { return Number(value); });
}

double AnyDouble(std::uint64_t n, std::uint64_t which) {
  if (n % 11 == 5 && which == 400) return -std::numeric_limits<double>::quiet_NaN();
  return (base::RandomUniform({n, which}) - 0.5) * (which % 3 == 0 ? 1e-200 : 1e6);
}

}  // namespace

const char* const kIdl = R"(// Everything that a recording's IDL may use: × is not ASCII.
module probe {
  enum Gear { REVERSE, NEUTRAL, FIRST };
  module inner {
    @final
    struct Header {
      long long step;      // base steps
      long long time_ns;
      unsigned long source;
    };
  };
  const unsigned long kCorners = 4;
  /* A wheel
     and its slip. */
  @final
  struct Wheel { double angle_rad; float slip; octet flag; };
  @final
  struct Sample {
    inner::Header header;
    octet small;
    double x_m;
    boolean on;
    unsigned long long big;
    short little;
    octet odd;
    sequence<double> values;
    octet after;
    sequence<Wheel> wheels;
    sequence<string> names;
    string text;
    Gear gear;
    sequence<Gear> gears;
    double triple[3];
    double grid[2][3];
    sequence<octet> raw;
    sequence<long long> longs;
    unsigned long last;
  };
  @final
  struct Tick {
    inner::Header header;
    unsigned long long digest;
  };
};
)";

Sample MakeSample(std::uint64_t n) {
  const auto bits = [n](std::uint64_t which) { return base::RandomBits({n, which}); };
  Sample s;
  s.header = {static_cast<std::int64_t>(n), static_cast<std::int64_t>(9007199254740993 + n),
              static_cast<std::uint32_t>(bits(1))};
  s.small = static_cast<std::uint8_t>(bits(2));
  s.x_m = AnyDouble(n, 3);
  s.on = bits(4) % 2 == 0;
  s.big = bits(5);
  s.little = static_cast<std::int16_t>(bits(6));
  s.odd = static_cast<std::uint8_t>(bits(7));
  for (std::uint64_t i = 0; i < n % 4; ++i) s.values.push_back(AnyDouble(n, 100 + i));
  s.after = static_cast<std::uint8_t>(bits(8));
  for (std::uint64_t i = 0; i < n % 3; ++i) {
    s.wheels.push_back(
        {AnyDouble(n, 200 + i), static_cast<float>(AnyDouble(n, 301 + 3 * i)), static_cast<std::uint8_t>(i)});
  }
  for (std::uint64_t i = 0; i < n % 5; ++i) s.names.push_back(std::string(i, 'a' + static_cast<char>(i)));
  s.text = n % 7 == 0 ? "" : "ángulo ✓ " + std::to_string(n);
  s.gear = static_cast<Gear>(n % 3);
  s.gears.assign(n % 2, Gear::kFirst);
  for (std::size_t i = 0; i < 3; ++i) {
    s.triple[i] = AnyDouble(n, 400 + i);
    s.grid[0][i] = AnyDouble(n, 500 + i);
    s.grid[1][i] = -static_cast<double>(i);
  }
  for (std::uint64_t i = 0; i < n % 6; ++i) s.raw.push_back(static_cast<std::uint8_t>(bits(600 + i)));
  for (std::uint64_t i = 0; i < n % 3; ++i) s.longs.push_back(static_cast<std::int64_t>(bits(700 + i)));
  s.last = static_cast<std::uint32_t>(bits(9));
  return s;
}

Tick MakeTick(std::uint64_t n) {
  return {{static_cast<std::int64_t>(n), -static_cast<std::int64_t>(n), 3}, base::RandomBits({n, 77})};
}

base::Bytes Encode(const Sample& sample) { return EncodeAny(sample); }
base::Bytes Encode(const Tick& tick) { return EncodeAny(tick); }

std::string Json(const Sample& s) {
  std::string json = fmt::format(R"({{"header":{},"small":{},"x_m":{},"on":{},"big":"{}","little":{},"odd":{})",
                                 Json(s.header), s.small, s.x_m, s.on, s.big, s.little, s.odd);
  json += fmt::format(R"(,"values":{},"after":{})", Numbers(s.values), s.after);
  json += fmt::format(R"(,"wheels":{})", JsonList(s.wheels, [](const Wheel& wheel) { return Json(wheel); }));
  json += fmt::format(R"(,"names":{})", JsonList(s.names, [](const std::string& name) { return '"' + name + '"'; }));
  json += fmt::format(R"(,"text":"{}","gear":{})", s.text, static_cast<int>(s.gear));
  json += fmt::format(R"(,"gears":{})",
                      JsonList(s.gears, [](Gear gear) { return fmt::format("{}", static_cast<int>(gear)); }));
  json += fmt::format(R"(,"triple":{},"grid":[{},{}],"raw":{})", Numbers(s.triple), Numbers(s.grid[0]),
                      Numbers(s.grid[1]), Numbers(s.raw));
  json += fmt::format(R"(,"longs":{},"last":{}}})",
                      JsonList(s.longs, [](std::int64_t value) { return fmt::format("\"{}\"", value); }), s.last);
  return json;
}

std::string Json(const Tick& tick) {
  return fmt::format(R"({{"header":{},"digest":"{}"}})", Json(tick.header), tick.digest);
}

}  // namespace rodeira::record::probe
