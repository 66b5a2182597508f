// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/road.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/network/junction_ground.hpp"
#include "common/world/network/lean_foot.hpp"
#include "common/world/network/settle.hpp"

namespace rodeira::network {
namespace {

// The last of the records that begin at s or before; null where none does.
template <class T>
const T* RecordAt(const std::vector<T>& records, double s_m) {
  const T* found = nullptr;
  for (const T& record : records) {
    if (record.s_m <= s_m) found = &record;
  }
  return found;
}

bool HasOwnSurface(const LaneSection& section) {
  const auto own = [](const Lane& lane) { return lane.level || !lane.heights.empty(); };
  return std::any_of(section.left.begin(), section.left.end(), own) ||
         std::any_of(section.right.begin(), section.right.end(), own);
}

// Where the level lanes that `lane` belongs to begin: the inner edge of the innermost lane from which on all are level.
LaneSpan LevelFrom(const LaneSection& section, const geometry::CubicPoint& centre, double s_m, int lane) {
  LaneSpan from = *section.Span(lane, centre, s_m);
  const int step = lane > 0 ? -1 : 1;
  for (int inner = lane + step; inner != 0 && section.Find(inner)->level; inner += step)
    from = *section.Span(inner, centre, s_m);
  return from;
}

}  // namespace

Road::Road(RoadSpec spec, geometry::PlanAxis axis)
    : spec_(std::move(spec)),
      axis_(std::move(axis)),
      length_m_(std::min(spec_.length_m, axis_.length_m())),
      rolled_(!spec_.superelevation.zero() && spec_.ground == nullptr),
      shaped_(spec_.ground != nullptr || !spec_.lateral.flat() ||
              std::any_of(spec_.sections.begin(), spec_.sections.end(), HasOwnSurface)) {
  RODEIRA_ASSERT(!spec_.sections.empty());
  for (std::size_t i = 0; i < spec_.sections.size(); ++i) {
    spec_.sections[i].end_s_m = i + 1 < spec_.sections.size() ? spec_.sections[i + 1].s_m : length_m_;
  }
}

std::size_t Road::SectionIndex(double s_m) const {
  if (spec_.sections.size() < 2 || s_m < spec_.sections[1].s_m) return 0;
  const auto after = std::upper_bound(spec_.sections.begin() + 2, spec_.sections.end(), s_m,
                                      [](double s, const LaneSection& section) { return s < section.s_m; });
  return static_cast<std::size_t>(after - spec_.sections.begin()) - 1;
}

double Road::Held(std::size_t section, double s_m) const {
  const LaneSection& held = spec_.sections[section];
  const bool last = section + 1 == spec_.sections.size();
  const double end = last ? length_m_ : std::nextafter(held.end_s_m, held.s_m);
  return std::clamp(s_m, std::min(held.s_m, end), end);
}

std::optional<LaneSpan> Road::SpanAt(std::size_t section, int lane, double s_m) const {
  const double s = Held(section, s_m);
  return spec_.sections[section].Span(lane, CentreAt(s), s);
}

LateralPoint Road::LaneHeightAt(const LaneSpan& span, double s_m, double t_m) const {
  const std::vector<LaneHeight>& heights = span.lane->heights;
  const double width = span.outer_t_m - span.inner_t_m;  // of either sign
  if (heights.empty() || width == 0.0) return {};
  // Between two records the height goes linearly, so that a kerb does not step along the road.
  const auto after = std::upper_bound(heights.begin(), heights.end(), s_m,
                                      [](double s, const LaneHeight& height) { return s < height.s_m; });
  LaneHeight now = after == heights.begin() ? heights.front() : *(after - 1);
  double inner_slope = 0.0, outer_slope = 0.0;
  if (after != heights.begin() && after != heights.end()) {
    const double length = after->s_m - now.s_m;
    inner_slope = (after->inner_m - now.inner_m) / length;
    outer_slope = (after->outer_m - now.outer_m) / length;
    now.inner_m += inner_slope * (s_m - now.s_m);
    now.outer_m += outer_slope * (s_m - now.s_m);
  }
  const double across = now.outer_m - now.inner_m;
  const double part = (t_m - span.inner_t_m) / width;
  const double part_slope =
      -(span.inner_slope + part * (span.outer_slope - span.inner_slope)) / width;  // by s at fixed t
  return {now.inner_m + part * across, inner_slope + part * (outer_slope - inner_slope) + part_slope * across,
          across / width};
}

SurfaceSample Road::Surface(double s_m, double t_m) const {
  const LaneSection& section = SectionAt(s_m);
  if (!shaped_) return Surface(s_m, t_m, section, {});
  double outside;
  const LaneSpan span = section.At(t_m, CentreAt(s_m), s_m, outside);
  return Surface(s_m, t_m, section, span);
}

SurfaceSample Road::OnGround(const geometry::PlanPoint& at, double s_m, double t_m, const LaneSpan& span) const {
  const Eigen::Vector2d N = at.left_W(), p = at.p_W + t_m * N, ds = (1.0 - at.curvature_1pm * t_m) * at.tangent_W;
  const GroundHeight ground = spec_.ground->At(p);
  const Eigen::Vector2d slope(ground.slope_x, ground.slope_y);
  const LateralPoint lane = span.lane == nullptr ? LateralPoint{} : LaneHeightAt(span, s_m, t_m);
  SurfaceSample sample;
  sample.p_W << p, ground.z_m + lane.z_m;
  sample.ds_W << ds, slope.dot(ds) + lane.slope_s;
  sample.dt_W << N, slope.dot(N) + lane.slope_t;
  return sample;
}

SurfaceSample Road::Surface(const geometry::PlanPoint& at, double s_m, double t_m, const LaneSection& section,
                            const LaneSpan& span) const {
  if (spec_.ground != nullptr) return OnGround(at, s_m, t_m, span);
  const geometry::Cubic& elevation = spec_.elevation.empty() ? kLevel : spec_.elevation.At(s_m);
  const double z_m = elevation.Value(s_m), z_slope = elevation.Slope(s_m);
  const Eigen::Vector2d& T = at.tangent_W;
  const Eigen::Vector2d N = at.left_W();
  // How t is split: the part that the superelevation turns, and the part beyond it that stays level.
  double turned = t_m, turned_s = 0.0, turned_t = 1.0;
  LateralPoint height;
  if (shaped_ && span.lane != nullptr) {
    height = LaneHeightAt(span, s_m, t_m);
    if (span.lane->level) {
      const LaneSpan from = LevelFrom(section, CentreAt(s_m), s_m, span.lane->id);
      turned = from.inner_t_m, turned_s = from.inner_slope, turned_t = 0.0;
    }
  }
  if (shaped_) {
    const LateralPoint lateral = spec_.lateral.At(s_m, turned);
    height.z_m += lateral.z_m;
    height.slope_s += lateral.slope_s + lateral.slope_t * turned_s;
    height.slope_t += lateral.slope_t * turned_t;
  }
  SurfaceSample sample;
  const geometry::Cubic* superelevation = rolled_ ? &spec_.superelevation.At(s_m) : nullptr;
  if (superelevation == nullptr || IsZero(*superelevation)) {
    const double pace = 1.0 - at.curvature_1pm * t_m;
    sample.p_W = {at.p_W.x() + t_m * N.x(), at.p_W.y() + t_m * N.y(), z_m + height.z_m};
    sample.ds_W = {pace * T.x(), pace * T.y(), z_slope + height.slope_s};
    sample.dt_W = {N.x(), N.y(), height.slope_t};
    return sample;
  }
  const Lean lean = LeanOf(RollAt(*superelevation, s_m), ClimbAt(elevation, s_m));
  if (turned_t == 1.0) {
    const LeanPace pace = PaceOf(lean, at.curvature_1pm, t_m);
    sample.p_W = {at.p_W.x() + t_m * (pace.dt_T * T.x() + pace.dt_N * N.x()),
                  at.p_W.y() + t_m * (pace.dt_T * T.y() + pace.dt_N * N.y()), z_m + t_m * lean.up + height.z_m};
    sample.ds_W = {pace.ds_T * T.x() + pace.ds_N * N.x(), pace.ds_T * T.y() + pace.ds_N * N.y(),
                   z_slope + t_m * lean.up_1pm + height.slope_s};
    sample.dt_W = {pace.dt_T * T.x() + pace.dt_N * N.x(), pace.dt_T * T.y() + pace.dt_N * N.y(),
                   lean.up + height.slope_t};
    return sample;
  }
  const double flat = t_m - turned, k = at.curvature_1pm;
  const Eigen::Vector2d e = lean.left * N - lean.back * T;
  const Eigen::Vector2d e_s = (lean.left_1pm - lean.back * k) * N - (lean.left * k + lean.back_1pm) * T;
  sample.p_W << at.p_W + turned * e + flat * N, z_m + turned * lean.up + height.z_m;
  sample.ds_W << T + turned_s * e + turned * e_s - turned_s * N - flat * k * T,
      z_slope + turned_s * lean.up + turned * lean.up_1pm + height.slope_s;
  sample.dt_W << N, height.slope_t;
  return sample;
}

Lean Road::LeanAt(double s_m) const {
  const geometry::Cubic& elevation = spec_.elevation.empty() ? kLevel : spec_.elevation.At(s_m);
  return LeanOf(RollAt(spec_.superelevation.At(s_m), s_m), ClimbAt(elevation, s_m));
}

bool Road::LeansBetween(double low_s_m, double high_s_m) const {
  if (!rolled_) return false;
  const geometry::Cubic* last = &spec_.superelevation.At(high_s_m);
  return std::any_of(&spec_.superelevation.At(low_s_m), last + 1,
                     [](const geometry::Cubic& record) { return !IsZero(record); });
}

std::optional<Road::LeanFoot> Road::FootOnLean(const geometry::AxisPanel& panel, const geometry::AxisFoot& foot,
                                               double low_s_m, double high_s_m) const {
  const std::optional<double> rate = axis_.RateOf(panel);
  const double from_s = panel.middle_s_m + foot.u_m;
  if (!rate || foot.beyond_m != 0.0 || from_s < low_s_m || from_s > high_s_m) return std::nullopt;
  const bool straight = panel.kind == geometry::AxisPanel::Kind::kLine;
  const double k = foot.at.curvature_1pm;
  const auto onward = [&](double u) { return straight ? StraightOn()(u, k) : BentOn{*rate}(u, k); };
  LeanStep step = FirstLeanStep(foot.t_m, k, *rate, LeanAt(from_s));
  double u = step.step_m;
  for (int i = 1; std::fabs(step.step_m) > kLastLeanStep_m; ++i) {
    if (i == kMaxLeanSteps) return std::nullopt;
    step = NextLeanStep(onward(u), foot.t_m, k + *rate * u, LeanAt(from_s + u));
    u += step.step_m;
  }
  const double s = from_s + u;
  if (!(step.fall > kMinLeanFall && s >= low_s_m && s <= high_s_m)) return std::nullopt;  // NaN too
  if (!straight && !BentOn{*rate}.Holds(u, k)) return std::nullopt;
  const Onward way = onward(u);
  const Eigen::Vector2d& T = foot.at.tangent_W;
  const Eigen::Vector2d N = foot.at.left_W();
  LeanFoot found{s, LeanT(way, foot.t_m, LeanAt(s)), {}};
  found.at.p_W = foot.at.p_W + way.ahead_m * T + way.left_m * N;
  found.at.tangent_W = {way.cosine * T.x() - way.sine * T.y(), way.cosine * T.y() + way.sine * T.x()};
  found.at.curvature_1pm = k + *rate * u;
  return found;
}

double Road::Settle(const Eigen::Vector2d& p_W, double low_s_m, double high_s_m, double& s_m, double& t_m) const {
  return SettleOn(*this, nullptr, p_W, low_s_m, high_s_m, s_m, t_m);
}

double Road::DistanceToEdge(const Eigen::Vector2d& p_W, double low_s_m, double high_s_m, double t_m,
                            double& s_m) const {
  return DistanceToEdgeOn(*this, nullptr, p_W, low_s_m, high_s_m, t_m, s_m);
}

std::optional<double> Road::SaidSpeedLimitAt(const Lane& lane, double s_m) const {
  if (const SpeedLimit* limit = RecordAt(lane.speeds, s_m)) return limit->speed_mps;
  if (const RoadType* type = RecordAt(spec_.types, s_m)) return type->speed_mps;
  return std::nullopt;
}

std::optional<double> Road::SpeedLimitAt(const Lane& lane, double s_m) const {
  if (const auto said = SaidSpeedLimitAt(lane, s_m)) return said;
  const SignSpeed* sign = RecordAt(lane.sign_speeds, s_m);
  return sign != nullptr ? sign->speed_mps : std::nullopt;
}

const RoadMark* Road::MarkAt(const Lane& lane, double s_m) const { return RecordAt(lane.marks, s_m); }

const LaneMaterial* Road::MaterialAt(const Lane& lane, double s_m) const { return RecordAt(lane.materials, s_m); }

}  // namespace rodeira::network
