// SPDX-License-Identifier: Apache-2.0
#include "common/editor/commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace rodeira::editor {
namespace {

bool Fits(const Eigen::Vector2d& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= static_cast<double>(traffic_map::kFarthest_m);
}

base::Error TooFar() {
  return base::WrongInput("edit.out_of_range", "a point would lie farther out than 1 000 000 m, where no map reaches");
}

// Nothing, or what is wrong with a lane's sides.
base::Status CheckSides(const Document& document, const traffic_map::LaneSide& left,
                        const traffic_map::LaneSide& right) {
  for (const auto& [side, name] : {std::pair(left, "left"), std::pair(right, "right")}) {
    if (!Find(document.map.curves, side.curve))
      return base::WrongInput("edit.unknown_element", fmt::format("the {} curve {} does not exist", name, side.curve));
  }
  if (left.curve == right.curve)
    return base::WrongInput("edit.wrong_connection",
                            fmt::format("curve {} is on both sides; two curves were expected", left.curve));
  return {};
}

}  // namespace

base::Result<traffic_map::Curve> CurveOf(std::int32_t number, const Points& points_W) {
  traffic_map::Curve curve;
  curve.id = number;
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    if (!Fits(points_W[i])) return TooFar();
    curve.points[i] = {static_cast<float>(points_W[i].x()), kDrawingHeight, static_cast<float>(points_W[i].y())};
  }
  return curve;
}

base::Result<Edit> NewCurve(Document& document, const Points& points_W) {
  const auto curve = CurveOf(NextNumber(document.map.curves), points_W);
  if (!curve) return curve.error();
  Recorder recorder(document);
  recorder.Add(curve.value());
  return std::move(recorder).Finish(fmt::format("curve {} made", curve.value().id));
}

base::Result<Edit> MoveHandles(Document& document, const std::vector<Handle>& handles, const Eigen::Vector2d& by_W) {
  std::map<std::size_t, traffic_map::Curve> moved;
  for (const Handle& handle : handles) {
    const auto at = Find(document.map.curves, handle.curve);
    if (!at || handle.index < 0 || handle.index > 3)
      return base::WrongInput("edit.unknown_element", fmt::format("curve {} does not exist", handle.curve));
    traffic_map::Curve& curve = moved.try_emplace(*at, document.map.curves[*at].value).first->second;
    traffic_map::ControlPoint& point = curve.points[static_cast<std::size_t>(handle.index)];
    const Eigen::Vector2d to = Eigen::Vector2d(static_cast<double>(point.x_m), static_cast<double>(point.y_m)) + by_W;
    if (!Fits(to)) return TooFar();
    point.x_m = static_cast<float>(to.x());
    point.y_m = static_cast<float>(to.y());
  }
  Recorder recorder(document);
  for (const auto& [index, curve] : moved) recorder.SetCurve(index, curve);
  return std::move(recorder).Finish(
      handles.size() == 1 ? fmt::format("handle {} of curve {} moved", handles[0].index + 1, handles[0].curve)
                          : fmt::format("{} handles moved", handles.size()));
}

base::Result<Edit> NewLane(Document& document, const traffic_map::LaneSide& left, const traffic_map::LaneSide& right,
                           traffic_map::LaneMode mode) {
  if (auto status = CheckSides(document, left, right); !status)
    return status.error().WithMessage("no lane was made: " + status.error().message).WithContext("");
  const traffic_map::Lane lane{NextNumber(document.map.lanes), left, right, mode};
  Recorder recorder(document);
  recorder.Add(lane);
  return std::move(recorder).Finish(fmt::format("lane {} made", lane.id));
}

base::Result<Edit> SetLane(Document& document, const traffic_map::Lane& lane) {
  const auto at = Find(document.map.lanes, lane.id);
  if (!at) return base::WrongInput("edit.unknown_element", fmt::format("lane {} does not exist", lane.id));
  if (auto status = CheckSides(document, lane.left, lane.right); !status)
    return status.error()
        .WithMessage(fmt::format("lane {} was not changed: {}", lane.id, status.error().message))
        .WithContext("");
  Recorder recorder(document);
  recorder.SetLane(*at, lane);
  return std::move(recorder).Finish(fmt::format("lane {} changed", lane.id));
}

base::Result<Edit> NewConnection(Document& document, std::int32_t from, std::int32_t to, bool stop) {
  for (const std::int32_t lane : {from, to}) {
    if (!Find(document.map.lanes, lane))
      return base::WrongInput("edit.unknown_element",
                              fmt::format("no connection was made: lane {} does not exist", lane));
  }
  if (from == to)
    return base::WrongInput("edit.wrong_connection",
                            fmt::format("no connection was made: it would lead from lane {} back into it", from));
  if (Find(document.map.connections, from, to))
    return base::WrongInput("edit.wrong_connection",
                            fmt::format("no connection was made: lane {} is connected to lane {} already", from, to));
  Recorder recorder(document);
  recorder.Add(traffic_map::Connection{from, to, stop, {}});
  return std::move(recorder).Finish(fmt::format("connection {} to {} made", from, to));
}

base::Result<Edit> SetStop(Document& document, std::int32_t from, std::int32_t to, bool stop) {
  const auto at = Find(document.map.connections, from, to);
  if (!at)
    return base::WrongInput("edit.wrong_connection", fmt::format("lane {} is not connected to lane {}", from, to));
  traffic_map::Connection connection = document.map.connections[*at].value;
  connection.stop = stop;
  Recorder recorder(document);
  recorder.SetConnection(*at, connection);
  return std::move(recorder).Finish(fmt::format("connection {} to {} changed", from, to));
}

base::Result<Edit> SetPicture(Document& document, std::string bytes, float scale) {
  if (!(scale >= 1e-6f) || scale > traffic_map::kFarthest_m)
    return base::WrongInput("edit.out_of_range",
                            fmt::format("the scale is {}; a number from 0.000001 to 1000000 was expected", scale));
  Recorder recorder(document);
  const bool none = bytes.empty();
  recorder.SetPicture(std::move(bytes));
  recorder.SetScale(scale);
  return std::move(recorder).Finish(none ? "background taken away" : "background imported");
}

base::Result<Edit> SetScale(Document& document, float scale) {
  if (!(scale >= 1e-6f) || scale > traffic_map::kFarthest_m)
    return base::WrongInput("edit.out_of_range",
                            fmt::format("the scale is {}; a number from 0.000001 to 1000000 was expected", scale));
  Recorder recorder(document);
  recorder.SetScale(scale);
  return std::move(recorder).Finish(fmt::format("background scale {}", scale));
}

base::Result<Edit> ScaleByDistance(Document& document, const Eigen::Vector2d& here_W, const Eigen::Vector2d& there_W,
                                   double known_m) {
  const double measured_m = (here_W - there_W).norm();
  if (!(known_m > 0.0) || !std::isfinite(known_m))
    return base::WrongInput("edit.out_of_range",
                            fmt::format("the known distance is {} m; one above 0 was expected", known_m));
  if (!(measured_m > 1e-3))
    return base::WrongInput("edit.too_short", "the two points coincide; two points of the background were expected");
  return SetScale(document,
                  static_cast<float>(static_cast<double>(document.map.scale.value.value) * known_m / measured_m));
}

}  // namespace rodeira::editor
