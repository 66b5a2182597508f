// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/editor/edit.hpp"
#include "common/editor/selection.hpp"

// The actions of a person on a map. Each does all of its change and gives the edit that takes it back, or does nothing
// and gives a sentence: wrong input.
namespace rodeira::editor {

// Where new curves lie in the original editor (figure 18).
constexpr float kDrawingHeight = 14.70026f;

using Points = std::array<Eigen::Vector2d, 4>;

// Its number is given by the document.
base::Result<Edit> NewCurve(Document& document, const Points& points_W);
// All of them by the same way. Refused where one would leave what a file may hold.
base::Result<Edit> MoveHandles(Document& document, const std::vector<Handle>& handles, const Eigen::Vector2d& by_W);

// The number is given by the document; both curves must be there and be two.
base::Result<Edit> NewLane(Document& document, const traffic_map::LaneSide& left, const traffic_map::LaneSide& right,
                           traffic_map::LaneMode mode);
// The lane of that number becomes this one.
base::Result<Edit> SetLane(Document& document, const traffic_map::Lane& lane);
// Both lanes must be there and be two, not connected so yet.
base::Result<Edit> NewConnection(Document& document, std::int32_t from, std::int32_t to, bool stop);
// The connection must be there.
base::Result<Edit> SetStop(Document& document, std::int32_t from, std::int32_t to, bool stop);

// With a curve go its heights and the lanes along it, with a lane its connections, signs, flow and lights. Handles
// alone are not taken away.
base::Result<Edit> Remove(Document& document, const Selection& selection);
// Curves, lanes, connections and the companion's contents go; the picture stays.
base::Result<Edit> Reset(Document& document);

// What the companion says of single elements. Heights of four zeros, and a flow of 0, are none.
base::Result<Edit> SetHeights(Document& document, std::int32_t curve, const std::array<double, 4>& z_m);
// All signs of the map; their lanes must be there.
base::Result<Edit> SetSigns(Document& document, const std::vector<traffic_map::LaneSign>& signs);
base::Result<Edit> SetFlow(Document& document, std::int32_t lane, double vehph);
// All lights of the map, in place of those that are there.
base::Result<Edit> SetLights(Document& document, const std::vector<lights::LightPlan>& lights);

// The whole file of a PNG or JPEG picture, or nothing; scale above 0 (the picture is 10·scale metres high).
base::Result<Edit> SetPicture(Document& document, std::string bytes, float scale);
// From 1e-6 on; without a picture, too.
base::Result<Edit> SetScale(Document& document, float scale);
// The picture becomes so large that two of its points, here and there now, lie `known_m` apart.
base::Result<Edit> ScaleByDistance(Document& document, const Eigen::Vector2d& here_W, const Eigen::Vector2d& there_W,
                                   double known_m);

// A point as the file holds it; refused beyond its bounds.
base::Result<traffic_map::Curve> CurveOf(std::int32_t number, const Points& points_W);

}  // namespace rodeira::editor
