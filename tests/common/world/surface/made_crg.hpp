// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/world/surface/crg_file.hpp"

namespace rodeira::surface {

// An OpenCRG file put together from the format's description, with heights from a function of u and v.
struct MadeCrg {
  std::string format = "LDFI";
  int rows = 21;
  double begin_u = 0.0, step = 0.5;
  std::vector<double> v = {-2.0, -1.0, 0.0, 1.0, 2.0};
  std::function<double(double, double)> z = [](double, double) { return 0.0; };
  std::function<double(double)> heading, slope, banking;  // where set: a column
  std::string road_keys, sections;                        // more text
  bool counted = false;
  bool says_end = true;

  std::string Head() const {
    std::string text = "$CT\nmade by a test\n$\n$ROAD_CRG\n";
    text += fmt::format("REFERENCE_LINE_INCREMENT = {}\nREFERENCE_LINE_START_U = {}\n", step, begin_u);
    if (says_end) text += fmt::format("reference_line_end_u = {} ! in lower case\n", begin_u + step * (rows - 1));
    text += road_keys + "$\n" + sections + fmt::format("$KD_Definition\n#:{}\nU:reference line u,m,0,1\n", format);
    if (heading) text += "D:reference line phi,rad\n";
    if (slope) text += "D:reference line slope,m/m\n";
    if (banking) text += "D:reference line banking,m/m\n";
    for (std::size_t i = 0; i < v.size(); ++i) {
      text += counted ? fmt::format("D:long section {},m\n", i + 1) : fmt::format("D:long section at v = {},m\n", v[i]);
    }
    return text + "$\n" + std::string(80, '$') + "\n";
  }

  std::string Text() const {
    std::string text = Head();
    std::size_t in_binary = 0;
    for (int row = 0; row < rows; ++row) {
      const double u = begin_u + step * row;
      std::vector<double> numbers;
      if (heading) numbers.push_back(row == 0 ? std::nan("") : heading(u - 0.5 * step));
      if (slope) numbers.push_back(row == 0 ? std::nan("") : slope(u - 0.5 * step));
      if (banking) numbers.push_back(banking(u));
      for (const double at : v) numbers.push_back(z(u, at));
      for (std::size_t i = 0; i < numbers.size(); ++i) text += Number(numbers[i], i, numbers.size());
      in_binary += numbers.size();
    }
    const std::size_t size = format == "KRBI" ? 4 : 8;
    if (format[0] == 'K') {
      for (; in_binary * size % 80 != 0; ++in_binary) text += Number(std::nan(""), 0, 0);
    }
    return text;
  }

  base::Result<CrgFile> Parse() const {
    const std::string text = Text();
    return ParseCrg(std::as_bytes(std::span(text)), "made.crg");
  }

 private:
  template <class Bits>
  static std::string BigEndian(Bits bits) {
    std::string bytes;
    for (int shift = 8 * (static_cast<int>(sizeof(Bits)) - 1); shift >= 0; shift -= 8) {
      bytes += static_cast<char>(bits >> shift & 0xff);
    }
    return bytes;
  }
  std::string Number(double value, std::size_t i, std::size_t count) const {
    if (format == "KRBI") return BigEndian(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    if (format == "KDBI") return BigEndian(std::bit_cast<std::uint64_t>(value));
    const std::size_t width = format == "LRFI" ? 10 : 20, a_line = 80 / width;
    std::string word =
        std::isnan(value) ? "*missing*" : (width == 10 ? fmt::format("{:.7f}", value) : fmt::format("{:.12e}", value));
    word = fmt::format("{:>{}}", word, width);
    return word + (i + 1 == count || i % a_line + 1 == a_line ? "\n" : "");
  }
};

}  // namespace rodeira::surface
