// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/opendrive/read.hpp"

// Consistency checks. Findings go to the two lists of Findings.
namespace rodeira::opendrive {

// Results of the checks, in the order in which they ran.
struct Findings {
  std::vector<Finding> errors, warnings;
  Source* source = nullptr;  // the file's
};

// The end of a sentence about a gap: that it is too large, or that it is closed, and what ASAM's own checker allows.
std::string GapWords(double found, double most, double asam, std::string_view unit);

// A step of heights where road or lane go on: up to `most_m` a warning (a millimetre or more), above it an error; and
// the end of the sentence about it. Nothing closes a step, so it is an error where no car climbs it (StepMost), or
// strictly where ASAM allows none.
constexpr double kClimbed_m = 0.2;
// The most for JudgeStep, m: kClimbed_m, with a strict tolerance strictly_m.
inline double StepMost(const Tolerance& tolerance, double strictly_m) {
  return tolerance.strict ? strictly_m : kClimbed_m;
}
void JudgeStep(Finding finding, double step_m, double most_m, Findings& findings);
// For the finding's text, of the same step as JudgeStep.
std::string StepWords(double step_m, double most_m);
// The most between two lanes: strictly ASAM's own.
double LaneGap(const Tolerance& tolerance);

// Elements of one road: stations, gaps and kinks between them, the lengths of cubics, the road's length.
void CheckPlan(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// Borders of lanes that lie inside of the next inner lane's edge.
void CheckBorders(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// Widths and lane offsets that jump within a lane section, under lanes that are driven on.
void CheckJumps(const RoadReading& road, const Tolerance& tolerance, Findings& findings);
// One warning for each road with a reference line that has jumps of curvature, also where it goes on into another road
// outside of junctions: at the largest of them.
void TellCurvatureJumps(const network::Network& network, std::span<const RoadLines> lines, Findings& findings);
// Signs of speed limits that say something else than every lane that they are for, or the road's type.
void TellSignLimits(const network::Network& network, std::span<const RoadLines> lines, Findings& findings);
// One road's surface: heights that jump between records of elevation, bank and cross-section; edges that fold in bends;
// lanes narrower than nothing.
void CheckSurfaces(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                   Findings& findings);
// Junctions with a boundary and heights of their own: the ground of each, laid under its connecting roads too.
void LayJunctionGrounds(std::span<const JunctionReading> junctions, const Tolerance& tolerance,
                        network::NetworkSpec& spec, Findings& findings);
// Roads that are met in their middle by connecting roads get lane sections that begin there; `not_of`: but for these
// connecting roads.
void CutAtMiddles(std::vector<RoadReading>& roads, const std::set<std::string, std::less<>>& not_of,
                  Findings& findings);
// The roads that are paths across others for people on foot (crossPath).
std::set<std::string, std::less<>> PathsOnFoot(std::span<const RoadReading> roads,
                                               std::span<const JunctionReading> junctions);
// Junctions' objects become those of the road beside which they lie, and paths across become crossings; roads that are
// such paths, and have nothing standing at them, are taken out.
void LayJunctionObjects(std::span<const JunctionReading> junctions, const std::set<std::string, std::less<>>& on_foot,
                        network::NetworkSpec& spec, std::vector<RoadLines>& lines, Findings& findings);
// Roads and junctions: that what is linked exists, is meant by both sides, meets, and is not ambiguous.
void CheckRoadLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);
// Lanes: that what is linked exists, is linked back, and meets.
void CheckLaneLinks(const network::Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                    Findings& findings);

}  // namespace rodeira::opendrive
