// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/csv/layout.hpp"
#include "common/data/record/mcap_reader.hpp"

namespace rodeira::csv {

// Which part of a recording becomes tables. What is not set restricts nothing.
struct Selection {
  std::vector<std::string> topics;            // with or without "rodeira/"
  std::vector<std::string> columns;           // columns, or groups of them: "position_w_m", "wheels.load_n"
  double rate_hz = 0.0;                       // above 0: of each source the first sample in each 1 / rate_hz of time
  std::set<std::string, std::less<>> events;  // topics of which the rate removes no sample
  std::optional<double> from_s;               // from this time on
  std::optional<double> to_s;                 // before this time
};

// Whether a time in seconds is chosen.
bool Holds(const Selection& selection, double time_s);
// The query for these times, of all channels. Wrong input where no time is left, or the recording ends before.
base::Result<record::Query> TimesOf(const Selection& selection, const record::McapReader& reader);

// The topic without "rodeira/".
std::string_view ShortTopic(std::string_view topic);

// True where one of the names is that of the topic.
bool HasTopic(const std::vector<std::string>& names, std::string_view topic);

// True where `name` is the column, or a group that it belongs to. A group may leave out indexes.
bool Names(std::string_view name, std::string_view column);

// Keeps the cells and lists of the layout that are named, and drops all others; without names it keeps all. Returns
// how many are kept.
std::size_t KeepColumns(const std::vector<std::string>& names, Layout& layout);

// Names the columns of a layout that can be chosen.
std::vector<std::string> ColumnsOf(const Layout& layout);

// Thins the samples of one source.
class Thinning {
 public:
  explicit Thinning(double rate_hz) : rate_hz_(rate_hz) {}
  // True for the first sample in each 1 / rate; samples come by time.
  bool Keeps(std::uint64_t time_ns);

 private:
  double rate_hz_;
  std::optional<std::uint64_t> last_;  // number of the interval of the newest sample
};

}  // namespace rodeira::csv
