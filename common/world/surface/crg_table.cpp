// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

namespace rodeira::surface {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kRecordBytes = 80;
constexpr double kLargest = 1e9;

// How many rows the header asks for; nothing where it leaves that to the numbers.
std::optional<double> RowsAsked(const CrgRoadKeys& road) {
  if (!road.end_u_m || !road.increment_m) return std::nullopt;
  return std::round((*road.end_u_m - road.start_u_m.value_or(0.0)) / *road.increment_m) + 1.0;
}

class TextNumbers {
 public:
  TextNumbers(const CrgHeader& header, std::span<const std::byte> bytes, std::string_view name)
      : text_(reinterpret_cast<const char*>(bytes.data()) + header.data_offset, bytes.size() - header.data_offset),
        name_(name),
        width_(header.format == CrgFormat::kText10 ? 10 : 20),
        line_(header.data_line) {}

  base::Result<CrgTable> Read(std::size_t columns) {
    CrgTable table{0, columns, {}};
    while (NextLine()) {
      if (now_.empty()) continue;  // between rows
      for (std::size_t column = 0; column < columns; ++column) {
        if (column > 0 && column % (kRecordBytes / width_) == 0 && !NextLine()) {
          return Wrong(fmt::format("the file ends within a row: {} of {} numbers are there", column, columns));
        }
        const std::size_t at = column % (kRecordBytes / width_) * width_;
        if (at >= now_.size()) {
          return Wrong(fmt::format("number {} of the row is missing; {} were expected, each {} characters wide",
                                   column + 1, columns, width_));
        }
        std::string_view word = now_.substr(at, width_);
        while (word.starts_with(' ')) word.remove_prefix(1);
        while (word.ends_with(' ')) word.remove_suffix(1);
        if (word.starts_with('*')) {
          table.values.push_back(kMissing);
          continue;
        }
        if (last_ && now_.size() < at + width_) {
          return Wrong(fmt::format(
              "the file is cut short within a number: it ends after '{}'; {} characters were expected", word, width_));
        }
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc() || end != word.data() + word.size() || !(std::fabs(value) <= kLargest)) {
          return Wrong(fmt::format(
              "'{}' was found in columns {} to {}; a number up to 1e9, or one that begins with '*' where it is "
              "missing, was expected",
              word, at + 1, at + width_));
        }
        table.values.push_back(value);
      }
      ++table.rows;
    }
    return table;
  }

 private:
  base::Error Wrong(std::string_view message) const {
    return base::WrongInput("surface.wrong_numbers", message, fmt::format("{}:{}", name_, line_ - 1));
  }

  bool NextLine() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    last_ = end == text_.size();
    now_ = text_.substr(at_, end - at_);
    while (now_.ends_with('\r') || now_.ends_with(' ')) now_.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return true;
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t width_;
  int line_;  // the one after now_
  std::string_view now_;
  bool last_ = false;  // now_ ends with the file itself: nothing shows that it was written to its end
  std::size_t at_ = 0;
};

template <class Real, class Bits>
double BigEndian(const std::byte* at) {
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) bits = static_cast<Bits>((bits << 8) | std::to_integer<Bits>(at[i]));
  return static_cast<double>(std::bit_cast<Real>(bits));
}

base::Result<CrgTable> ReadBinary(const CrgHeader& header, std::span<const std::byte> bytes, std::string_view name) {
  const std::size_t size = header.format == CrgFormat::kFloat ? 4 : 8;
  const std::size_t columns = header.channels.size();
  const std::span<const std::byte> data = bytes.subspan(header.data_offset);
  const std::size_t there = data.size() / size / columns;
  const auto asked = RowsAsked(header.road);
  if (asked && *asked > static_cast<double>(there)) {
    return base::WrongInput(
        "surface.wrong_rows",
        fmt::format("the file is cut short: {} rows of {} numbers are there, and the header asks for {}", there,
                    columns, *asked),
        name);
  }
  CrgTable table{asked ? static_cast<std::size_t>(*asked) : there, columns, {}};
  table.values.resize(table.rows * columns);
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const std::byte* at = data.data() + i * size;
    table.values[i] = size == 4 ? BigEndian<float, std::uint32_t>(at) : BigEndian<double, std::uint64_t>(at);
    if (std::fabs(table.values[i]) > kLargest) {
      return base::WrongInput("surface.wrong_numbers",
                              fmt::format("the number in row {}, column {} is {}; at most 1e9 was expected",
                                          i / columns + 1, i % columns + 1, table.values[i]),
                              name);
    }
  }
  // Where the header does not say where the rows end, the last record's filling may look like rows.
  std::size_t filling = kRecordBytes / size;
  while (!asked && table.rows > 0 && filling >= columns) {
    const auto last = table.values.end() - static_cast<std::ptrdiff_t>(columns);
    if (!std::all_of(last, table.values.end(), [](double value) { return std::isnan(value); })) break;
    table.values.resize(table.values.size() - columns);
    --table.rows;
    filling -= columns;
  }
  return table;
}

}  // namespace

base::Result<CrgTable> ReadCrgTable(const CrgHeader& header, std::span<const std::byte> bytes, std::string_view name) {
  if (header.channels.empty()) {
    return base::WrongInput("surface.wrong_numbers",
                            "the header describes no column of numbers ($KD_DEFINITION, 'D:long section …,m')", name);
  }
  if (header.format == CrgFormat::kNone) {
    return base::WrongInput("surface.wrong_numbers",
                            "the header does not say how the numbers are written ('#:KRBI', KDBI, LRFI or LDFI)", name);
  }
  if (const auto asked = RowsAsked(header.road); asked && *asked < 2.0) {
    return base::WrongInput(
        "surface.wrong_rows",
        fmt::format("the header goes from u = {} to {} every {} m; at least 2 rows were expected",
                    header.road.start_u_m.value_or(0.0), *header.road.end_u_m, *header.road.increment_m),
        name);
  }
  const bool text = header.format == CrgFormat::kText10 || header.format == CrgFormat::kText20;
  auto table = text ? TextNumbers(header, bytes, name).Read(header.channels.size()) : ReadBinary(header, bytes, name);
  if (!table) return table;
  const auto asked = RowsAsked(header.road);
  if (asked && *asked != static_cast<double>(table.value().rows)) {
    return base::WrongInput(
        "surface.wrong_rows",
        fmt::format("{} rows of numbers were found; from u = {} to {} every {} m are {}", table.value().rows,
                    header.road.start_u_m.value_or(0.0), *header.road.end_u_m, *header.road.increment_m, *asked),
        name);
  }
  if (table.value().rows < 2) {
    return base::WrongInput("surface.wrong_rows",
                            fmt::format("{} rows of numbers were found; at least 2 were expected", table.value().rows),
                            name);
  }
  return table;
}

}  // namespace rodeira::surface
