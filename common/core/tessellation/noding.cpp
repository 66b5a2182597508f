// SPDX-License-Identifier: Apache-2.0
#include "common/core/tessellation/noding.hpp"

#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/core/base/assert.hpp"

namespace rodeira::tessellation {
namespace {

GEOSGeometry* ToGeos(GEOSContextHandle_t geos, const GridLine& line) {
  std::vector<double> xy;
  for (const GridPoint& p : line) {
    const double x = p.x, y = p.y;
    if (xy.size() >= 2 && xy[xy.size() - 2] == x && xy.back() == y) continue;
    xy.insert(xy.end(), {x, y});
  }
  if (xy.size() < 4) return nullptr;
  return GEOSGeom_createLineString_r(
      geos, GEOSCoordSeq_copyFromBuffer_r(geos, xy.data(), static_cast<unsigned>(xy.size() / 2), 0, 0));
}

// The same segments in fewer lines, each of which goes on in another one for as long as one ends there: GEOS draws
// random numbers for every line.
std::vector<GridLine> Joined(std::span<const GridLine> lines) {
  std::map<GridPoint, std::vector<std::size_t>> ending;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].empty()) ending[lines[i].front()].push_back(i), ending[lines[i].back()].push_back(i);
  }
  std::vector<bool> used(lines.size(), false);
  const auto go_on = [&](GridLine& line) {
    for (;;) {
      std::vector<std::size_t>& here = ending.at(line.back());
      while (!here.empty() && used[here.back()]) here.pop_back();
      if (here.empty()) return;
      const GridLine& next = lines[here.back()];
      used[here.back()] = true;
      if (next.front() == line.back())
        line.insert(line.end(), next.begin() + 1, next.end());
      else
        line.insert(line.end(), next.rbegin() + 1, next.rend());
    }
  };
  std::vector<GridLine> joined;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (used[i] || lines[i].empty()) continue;
    used[i] = true;
    GridLine& line = joined.emplace_back(lines[i]);
    go_on(line);
    std::reverse(line.begin(), line.end());
    go_on(line);
  }
  return joined;
}

void AddSegments(GEOSContextHandle_t geos, const GEOSGeometry* line, std::vector<GridSegment>& segments) {
  const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(geos, line);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(geos, points, &count);
  GridPoint before;
  for (unsigned i = 0; i < count; ++i) {
    double x = 0.0, y = 0.0;
    GEOSCoordSeq_getXY_r(geos, points, i, &x, &y);
    const GridPoint p{static_cast<std::int32_t>(std::lround(x)), static_cast<std::int32_t>(std::lround(y))};
    if (i > 0 && p != before) segments.push_back({std::min(before, p), std::max(before, p)});
    before = p;
  }
}

}  // namespace

std::vector<GridSegment> Node(std::span<const GridLine> lines) {
  GEOSContextHandle_t geos = GEOS_init_r();
  std::vector<GEOSGeometry*> parts;
  for (const GridLine& line : Joined(lines)) {
    if (GEOSGeometry* part = ToGeos(geos, line)) parts.push_back(part);
  }
  std::vector<GridSegment> segments;
  if (!parts.empty()) {
    GEOSGeometry* all =
        GEOSGeom_createCollection_r(geos, GEOS_MULTILINESTRING, parts.data(), static_cast<unsigned>(parts.size()));
    GEOSGeometry* noded = GEOSUnaryUnionPrec_r(geos, all, 1.0);
    RODEIRA_ASSERT(noded != nullptr);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, noded); ++i)
      AddSegments(geos, GEOSGetGeometryN_r(geos, noded, i), segments);
    GEOSGeom_destroy_r(geos, noded);
    GEOSGeom_destroy_r(geos, all);
  }
  GEOS_finish_r(geos);
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

}  // namespace rodeira::tessellation
