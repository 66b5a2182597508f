// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_surface.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::surface {
namespace {

constexpr double kEvenSpacing_m = 1e-9;  // sections count as evenly spaced
constexpr double kClosingCosine = 0.5;   // of 60 degrees
constexpr double kParallel = 1e-9;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The remainder in [0, size).
double Modulo(double value, double size) {
  const double rest = std::fmod(value, size);
  return rest < 0.0 ? rest + size : rest;
}

}  // namespace

CrgSurface::CrgSurface(CrgShape shape) : shape_(std::move(shape)) {
  const std::size_t sections = shape_.v_m.size();
  RODEIRA_ASSERT(sections >= 2 && rows() == shape_.line.points_W().size());
  RODEIRA_ASSERT(shape_.heights.size() == rows() * sections && shape_.banking.size() == rows());
  v_step_m_ = (shape_.v_m.back() - shape_.v_m.front()) / static_cast<double>(sections - 1);
  for (std::size_t i = 0; i < sections; ++i) {
    if (std::fabs(shape_.v_m.front() + static_cast<double>(i) * v_step_m_ - shape_.v_m[i]) > kEvenSpacing_m) {
      v_step_m_ = 0.0;
      break;
    }
  }
  if (shape_.options.close_track) FindClosure();
}

// Both ends' prolongations meet in front of the one and behind the other: u goes over at their crossing, or in the
// middle of the gap where they are parallel.
void CrgSurface::FindClosure() {
  const CrgReferenceLine& line = shape_.line;
  const Eigen::Vector2d begin = line.points_W().front(), end = line.points_W().back();
  const Eigen::Vector2d ahead = line.DirectionAt(line.begin_u_m()), behind = line.DirectionAt(line.end_u_m());
  const double cosine = ahead.dot(behind);
  if (!(cosine > kClosingCosine)) return;
  const double past_end = (begin - end).dot(ahead) / cosine;  // where the line across the start cuts the prolongation
  const double before_begin = (end - begin).dot(behind) / cosine;  // and the line across the end that before the start
  if (!(past_end >= 0.0 && before_begin <= 0.0)) return;
  double low = 0.5 * before_begin * cosine, high = 0.5 * past_end * cosine;
  const double sine = Cross(ahead, behind);
  if (std::fabs(sine) > kParallel) {
    const double from_end = Cross(begin - end, ahead) / Cross(behind, ahead);
    const double from_begin = Cross(end - begin, behind) / sine;
    if (from_end >= 0.0 && from_begin <= 0.0) low = from_begin, high = from_end;
  }
  closed_ = true;
  close_low_u_m_ = line.begin_u_m() + low;
  close_high_u_m_ = line.end_u_m() + high;
}

double CrgSurface::Fold(double value, double low, double high, CrgBorder border, double& sign) const {
  const double size = high - low;
  if (value >= low && value <= high) return value;
  if (border == CrgBorder::kRepeat) return low + Modulo(value - low, size);
  if (border != CrgBorder::kReflect) return value;
  const double there_and_back = Modulo(value - low, 2.0 * size);
  if (there_and_back <= size) return low + there_and_back;
  sign = -1.0;
  return low + (2.0 * size - there_and_back);
}

CrgSurface::Cell CrgSurface::AlongU(double u_m) const {
  const CrgReferenceLine& line = shape_.line;
  Cell cell;
  cell.size_m = line.step_m();
  const double u = Fold(u_m, line.begin_u_m(), line.end_u_m(), shape_.options.border_u, cell.sign);
  const double last = static_cast<double>(rows() - 1);
  const double at = (u - line.begin_u_m()) / line.step_m();
  const double held = std::clamp(at, 0.0, last);
  cell.outside = u < line.begin_u_m() || u > line.end_u_m();
  cell.index = std::min(static_cast<std::size_t>(held), rows() - 2);
  cell.share = held - static_cast<double>(cell.index);
  return cell;
}

CrgSurface::Cell CrgSurface::AcrossV(double v_m) const {
  const std::vector<double>& sections = shape_.v_m;
  Cell cell;
  const double v = Fold(v_m, sections.front(), sections.back(), shape_.options.border_v, cell.sign);
  const double held = std::clamp(v, sections.front(), sections.back());
  cell.outside = v != held;
  const std::size_t last = sections.size() - 2;
  if (v_step_m_ > 0.0) {
    cell.index = std::min(static_cast<std::size_t>((held - sections.front()) / v_step_m_), last);
  } else {
    const auto above = std::upper_bound(sections.begin(), sections.end(), held);
    cell.index = std::min(static_cast<std::size_t>(above - sections.begin()) - 1, last);
  }
  cell.size_m = sections[cell.index + 1] - sections[cell.index];
  cell.share = std::clamp((held - sections[cell.index]) / cell.size_m, 0.0, 1.0);
  return cell;
}

// Within the zone the point's height over `base_z_m` grows with the distance from the end.
void CrgSurface::Smooth(double from_m, double zone_m, double sign, double base_z_m, CrgPoint& point) const {
  if (!(zone_m > from_m)) return;
  const double share = std::max(from_m, 0.0) / zone_m;
  const double over = point.z_m - base_z_m;
  point.z_m = base_z_m + share * over;
  point.dz_du = share * point.dz_du + (from_m > 0.0 ? sign * over / zone_m : 0.0);
  point.dz_dv *= share;
}

CrgPoint CrgSurface::At(double u_m, double v_m) const {
  CrgPoint point;
  if (!std::isfinite(u_m) || !std::isfinite(v_m)) return point;
  double u = u_m;
  if (closed_ && (u < close_low_u_m_ || u > close_high_u_m_)) {
    u = close_low_u_m_ + Modulo(u - close_low_u_m_, close_high_u_m_ - close_low_u_m_);
  }
  const CrgOptions& options = shape_.options;
  const Cell along = AlongU(u), across = AcrossV(v_m);
  if ((along.outside && options.border_u == CrgBorder::kNone) ||
      (across.outside && options.border_v == CrgBorder::kNone)) {
    return point;
  }

  const double* corner = shape_.heights.data() + along.index * shape_.v_m.size() + across.index;
  double z00 = corner[0], z01 = corner[1], z10 = corner[shape_.v_m.size()], z11 = corner[shape_.v_m.size() + 1];
  if (std::isnan(z00 + z01 + z10 + z11)) {  // a corner without weight is not needed
    if (across.share == 0.0) z01 = z00, z11 = z10;
    if (across.share == 1.0) z00 = z01, z10 = z11;
    if (along.share == 0.0) z10 = z00, z11 = z01;
    if (along.share == 1.0) z00 = z10, z01 = z11;
    if (std::isnan(z00 + z01 + z10 + z11)) return point;
  }
  const double p = along.share, q = across.share;
  const double v = shape_.v_m[across.index] + q * across.size_m;
  const double line_z = shape_.line_z_m[along.index], line_step = shape_.line_z_m[along.index + 1] - line_z;
  const double bank = shape_.banking[along.index], bank_step = shape_.banking[along.index + 1] - bank;
  const double onward = (1.0 - q) * (z10 - z00) + q * (z11 - z01);    // over one step of u
  const double leftward = (1.0 - p) * (z01 - z00) + p * (z11 - z10);  // over the cell's width
  point.inside = true;
  point.z_m = (1.0 - q) * ((1.0 - p) * z00 + p * z10) + q * ((1.0 - p) * z01 + p * z11) + line_z + p * line_step +
              (bank + p * bank_step) * v;
  point.dz_du = along.outside ? 0.0 : along.sign * (onward + line_step + bank_step * v) / along.size_m;
  point.dz_dv = across.outside ? 0.0 : across.sign * (leftward / across.size_m + bank + p * bank_step);

  const auto beyond = [&point](CrgBorder border, double offset_m) {
    if (border == CrgBorder::kZero) point.z_m = offset_m, point.dz_du = 0.0, point.dz_dv = 0.0;
    if (border == CrgBorder::kKeep) point.z_m += offset_m;
  };
  if (along.outside) beyond(options.border_u, options.offset_u_m);
  if (across.outside) beyond(options.border_v, options.offset_v_m);

  const double from_begin = (static_cast<double>(along.index) + p) * along.size_m;
  Smooth(from_begin, options.smooth_begin_m, along.outside ? 0.0 : along.sign, shape_.line_z_m.front(), point);
  Smooth(length_m() - from_begin, options.smooth_end_m, along.outside ? 0.0 : -along.sign, shape_.line_z_m.back(),
         point);
  return point;
}

CrgGround CrgSurface::Ground(double x_m, double y_m) const {
  CrgGround ground;
  if (!std::isfinite(x_m) || !std::isfinite(y_m)) return ground;
  const CrgFoot foot = shape_.line.Project(x_m, y_m);
  const CrgPoint point = At(foot.u_m, foot.v_m);
  ground.u_m = foot.u_m;
  ground.v_m = foot.v_m;
  if (!point.inside) return ground;
  const Eigen::Vector2d slope = point.dz_du * foot.u_slope_W + point.dz_dv * foot.v_slope_W;
  ground.z_m = point.z_m;
  ground.slope_x = slope.x();
  ground.slope_y = slope.y();
  ground.inside = true;
  return ground;
}

}  // namespace rodeira::surface
