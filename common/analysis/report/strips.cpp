// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/report/strips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/analysis/measures/series.hpp"
#include "common/core/plot/curves.hpp"

namespace rodeira::report {
namespace {

using measures::Drive;
using measures::kMissing;

constexpr std::size_t kMaxBuckets = 500;  // along the axis of time; of each the extremes are drawn
constexpr double kMaxTtc_s = 20.0;

// A quantity of a report: a column of the time series.
struct Quantity {
  const char* column;
  const char* title;
  const char* axis;
  double factor = 1.0;
  double high = std::numeric_limits<double>::infinity();  // larger values are left out
};
constexpr Quantity kStrips[] = {
    {"speed_mps", "Speed", "km/h", 3.6},
    {"throttle", "Accelerator", "0 to 1"},
    {"brake", "Brake", "0 to 1"},
    {"steering_wheel_deg", "Steering wheel, left positive", "deg"},
    {"lane_position_m", "Position in the lane, left positive", "m"},
    {"leader_gap_m", "Gap to the leader", "m"},
    {"ttc_s", "Time to collision, up to 20 s", "s", 1.0, kMaxTtc_s},
};
constexpr Quantity kDistributions[] = {{"speed_mps", "Speed", "km/h", 3.6},
                                       {"lane_position_m", "Position in the lane, left positive", "m"},
                                       {"time_gap_s", "Time gap, up to 10 s", "s", 1.0, 10.0}};

std::vector<double> Values(const Drive& drive, const Quantity& quantity) {
  const auto column = measures::FindSeries(quantity.column);
  std::vector<double> values = measures::SeriesOf(drive, column.value());
  for (double& value : values) value = value <= quantity.high ? value * quantity.factor : kMissing;
  return values;
}

// The lowest and the highest value of each bucket, in their order; a bucket with missing values interrupts the curve.
std::vector<std::pair<double, double>> Thinned(const std::vector<double>& values, double rate_hz) {
  const std::size_t stride = std::max<std::size_t>(1, (values.size() + kMaxBuckets - 1) / kMaxBuckets);
  std::vector<std::pair<double, double>> points;
  const auto time = [rate_hz](std::size_t k) { return static_cast<double>(k) / rate_hz; };
  for (std::size_t begin = 0; begin < values.size(); begin += stride) {
    const std::size_t end = std::min(begin + stride, values.size());
    std::size_t low = end, high = end;
    bool missing = false;
    for (std::size_t k = begin; k < end; ++k) {
      if (std::isnan(values[k])) {
        missing = true;
        continue;
      }
      if (low == end || values[k] < values[low]) low = k;
      if (high == end || values[k] > values[high]) high = k;
    }
    if (low != end) {
      points.emplace_back(time(std::min(low, high)), values[std::min(low, high)]);
      if (low != high) points.emplace_back(time(std::max(low, high)), values[std::max(low, high)]);
    }
    if (missing) points.emplace_back(time(end - 1), kMissing);
  }
  return points;
}

bool HasValues(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

// Shares of time in bins, as the outline of a histogram.
std::vector<std::pair<double, double>> Histogram(const std::vector<double>& values, double low, double width,
                                                 int bins) {
  std::vector<double> counts(static_cast<std::size_t>(bins), 0.0);
  double all = 0.0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    const double bin = std::clamp(std::floor((value - low) / width), 0.0, static_cast<double>(bins - 1));
    counts[static_cast<std::size_t>(bin)] += 1.0;
    all += 1.0;
  }
  std::vector<std::pair<double, double>> outline{{low, 0.0}};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = low + width * static_cast<double>(i), share = all > 0.0 ? counts[i] / all : 0.0;
    outline.emplace_back(from, share);
    outline.emplace_back(from + width, share);
  }
  outline.emplace_back(low + width * bins, 0.0);
  return outline;
}

}  // namespace

std::string ShortName(const ReportedDrive& drive) {
  std::string name;
  for (const auto& [key, value] : drive.meta) {
    if ((key == "participant" || key == "condition" || key == "run") && !value.empty())
      name += (name.empty() ? "" : " ") + value;
  }
  return name.empty() ? std::filesystem::path(drive.facts.file).stem().string() : name;
}

std::string StripsSvg(std::span<const ReportedDrive> drives) {
  std::vector<plot::Diagram> diagrams;
  for (const Quantity& quantity : kStrips) {
    plot::Diagram diagram{quantity.title, "time in s", quantity.axis, {}, {}, {0.0}};
    for (const ReportedDrive& drive : drives) {
      const Drive& d = drive.reading->drive;
      diagram.shown_x.push_back(static_cast<double>(d.size()) / d.rate_hz);
      const std::vector<double> values = Values(d, quantity);
      if (HasValues(values)) diagram.curves.push_back({ShortName(drive), Thinned(values, d.rate_hz)});
    }
    if (diagram.curves.empty()) continue;
    if (drives.size() == 1) {
      const measures::DriveReading& reading = *drives[0].reading;
      if (std::string_view(quantity.column) == "speed_mps") {
        const std::vector<double> limit =
            Values(reading.drive, {"speed_limit_mps", quantity.title, quantity.axis, quantity.factor});
        if (HasValues(limit)) diagram.curves.push_back({"speed limit", Thinned(limit, reading.drive.rate_hz)});
      }
      for (const measures::DriveEvent& event : reading.events) diagram.marks.emplace_back(event.time_s, event.name);
    }
    diagrams.push_back(std::move(diagram));
  }
  return plot::ToSvg(diagrams, "Over time", 2);
}

std::string DistributionsSvg(std::span<const ReportedDrive> drives) {
  std::vector<plot::Diagram> diagrams;
  for (const Quantity& quantity : kDistributions) {
    std::vector<std::vector<double>> values;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const ReportedDrive& drive : drives) {
      values.push_back(Values(drive.reading->drive, quantity));
      for (const double value : values.back()) {
        if (std::isnan(value)) continue;
        low = std::min(low, value), high = std::max(high, value);
      }
    }
    if (!(low <= high)) continue;
    constexpr int kBins = 30;
    const double width = std::max((high - low) / kBins, 1e-3);
    plot::Diagram diagram{quantity.title, quantity.axis, "share of time", {}, {}, {}};
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (HasValues(values[i]))
        diagram.curves.push_back({ShortName(drives[i]), Histogram(values[i], low, width, kBins)});
    }
    diagrams.push_back(std::move(diagram));
  }
  return plot::ToSvg(diagrams, "Distributions", 2);
}

}  // namespace rodeira::report
