// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace rodeira::measures {

// The real matrices of doubles of a MATLAB v5 file with compressed variables (MAT-File Format, MathWorks 2019).
inline std::map<std::string, std::vector<double>> ReadMatFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  std::map<std::string, std::vector<double>> variables;
  const auto number = [](const std::string& text, std::size_t at) {
    std::uint32_t value = 0;
    if (at + sizeof(value) <= text.size()) std::memcpy(&value, text.data() + at, sizeof(value));
    return value;
  };
  constexpr std::size_t kHeader = 128;
  constexpr std::uint32_t kCompressed = 15, kDouble = 9;
  for (std::size_t at = kHeader; at + 8 <= file.size(); at += 8 + number(file, at + 4)) {
    if (number(file, at) != kCompressed) continue;
    std::string data(1u << 16, '\0');
    uLongf size = data.size();
    const std::string packed = file.substr(at + 8, number(file, at + 4));
    if (uncompress(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                   packed.size()) != Z_OK)
      continue;
    data.resize(size);
    // Tag 8, flags 16, dimensions 16, name, values; all padded to eight bytes.
    const std::size_t name_size = number(data, 44), values = 48 + (name_size + 7) / 8 * 8;
    if (number(data, values) != kDouble) continue;
    std::vector<double> numbers(number(data, values + 4) / sizeof(double));
    std::memcpy(numbers.data(), data.data() + values + 8, numbers.size() * sizeof(double));
    variables[data.substr(48, name_size)] = std::move(numbers);
  }
  return variables;
}

}  // namespace rodeira::measures
