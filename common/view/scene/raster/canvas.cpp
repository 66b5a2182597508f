// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/raster/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::scene {
namespace {

constexpr int kCircleCorners = 32;

}  // namespace

Canvas::Canvas(int width_px, int height_px, Colour ground)
    : width_(kSamples * width_px),
      height_(kSamples * height_px),
      half_width_(static_cast<double>(width_px) / height_px),
      samples_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), ground) {}

void Canvas::Fill(Points outline, Colour colour) {
  const double scale = 0.5 * height_;  // samples a unit
  double low = 1e9, high = -1e9;
  for (const Eigen::Vector2d& p : outline) low = std::min(low, p.y()), high = std::max(high, p.y());
  const int first = std::max(0, static_cast<int>(std::floor((low + 1.0) * scale))),
            last = std::min(height_ - 1, static_cast<int>(std::ceil((high + 1.0) * scale)));
  std::vector<double> crossings;
  for (int row = first; row <= last; ++row) {
    const double y = (row + 0.5) / scale - 1.0;
    crossings.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto column = [&](double x) {
        return std::clamp(static_cast<int>(std::ceil((x + half_width_) * scale - 0.5)), 0, width_);
      };
      auto* at = &samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_)];
      std::fill(at + column(crossings[i]), at + column(crossings[i + 1]), colour);
    }
  }
}

void Canvas::Disc(const Eigen::Vector2d& middle, double radius, Colour colour) {
  std::array<Eigen::Vector2d, kCircleCorners> ring;
  for (int k = 0; k < kCircleCorners; ++k) {
    const double angle = 2.0 * base::kPi * k / kCircleCorners;
    ring[static_cast<std::size_t>(k)] = middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  Fill(ring, colour);
}

void Canvas::Bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, Colour colour) {
  const Eigen::Vector2d way = to - from;
  if (!(way.norm() > 0.0)) return;
  const Eigen::Vector2d aside = 0.5 * width / way.norm() * Eigen::Vector2d(-way.y(), way.x());
  Fill(std::array<Eigen::Vector2d, 4>{from - aside, to - aside, to + aside, from + aside}, colour);
}

void Canvas::Stroke(Points points, double width, Colour colour) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Disc(points[i], 0.5 * width, colour);
    if (i > 0) Bar(points[i - 1], points[i], width, colour);
  }
}

Raster Canvas::Paint() const {
  Raster raster;
  raster.width_px = width_ / kSamples, raster.height_px = height_ / kSamples;
  for (int y = 0; y < raster.height_px; ++y) {
    for (int x = 0; x < raster.width_px; ++x) {
      std::array<int, 3> sum{};
      for (int row = kSamples * y; row < kSamples * (y + 1); ++row) {
        const Colour* at = &samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                     static_cast<std::size_t>(kSamples * x)];
        for (int k = 0; k < kSamples; ++k) sum[0] += at[k].red, sum[1] += at[k].green, sum[2] += at[k].blue;
      }
      constexpr int kAll = kSamples * kSamples;
      const auto mean = [](int total) { return static_cast<std::uint8_t>((total + kAll / 2) / kAll); };
      raster.pixels.push_back({mean(sum[0]), mean(sum[1]), mean(sum[2])});
    }
  }
  return raster;
}

}  // namespace rodeira::scene
