// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::traffic_map {

// What is painted along a side of a lane; the numbers are the file's (MOTORS, appendix A.8).
enum class BorderType : std::int8_t {
  kNone = 0,
  kBoundary = 1,         // the edge of the road
  kSingle = 2,           // between opposite directions, not to be crossed
  kDashed = 3,           // between opposite directions, may be crossed to overtake
  kDashedSame = 4,       // between lanes of the same direction
  kDashedSpeedCtrl = 5,  // dense: a lane that enters a slower or faster road
  kDashedWarn = 6,       // dense: a danger ahead
  kDoubleDashed = 7,     // lanes about to split, or with a direction that is reversed at times
};
constexpr int kBorderTypes = 8;

// Where vehicles begin and end (A.9).
enum class LaneMode : std::int8_t { kNone = 0, kStart = 1, kEnd = 2 };

// A control point as it stands in the file: its x, y, z.
struct ControlPoint {
  float x_m = 0.0f;             // world x, to the east
  float drawing_height = 0.0f;  // where the original editor draws; no elevation, kept and not used
  float y_m = 0.0f;             // the file's z: world y, to the north

  bool operator==(const ControlPoint&) const = default;
};

// Line `p`: a cubic Bézier curve.
struct Curve {
  std::int32_t id = 0;
  std::array<ControlPoint, 4> points;

  bool operator==(const Curve&) const = default;
};

// One side of a lane. `inverted`: the lane runs along the curve from its last point to its first.
struct LaneSide {
  std::int32_t curve = 0;
  bool inverted = false;
  BorderType type = BorderType::kNone;

  bool operator==(const LaneSide&) const = default;
};

// Line `l`: the ground between two curves, driven in one direction.
struct Lane {
  std::int32_t id = 0;
  LaneSide left;
  LaneSide right;
  LaneMode mode = LaneMode::kNone;

  bool operator==(const Lane&) const = default;
};

// Line `c`: a vehicle at the end of lane `from` may go on in lane `to`. Figure 18 shows three more numbers, always
// zero, that appendix A.15 does not write; their meaning is unknown.
struct Connection {
  std::int32_t from = 0;
  std::int32_t to = 0;
  bool stop = false;  // a STOP sign at the end of `from`
  std::array<float, 3> unknown{};

  bool operator==(const Connection&) const = default;
};

// Line `s`: the picture is 10 · value metres high.
struct Scale {
  float value = 10.0f;

  bool operator==(const Scale&) const = default;
};

// A line of the file: what it says, and the bytes that it was read from, with their line end. Where the value is still
// what those bytes say they are written again; otherwise, and where there are none, the value is written anew.
template <class Value>
struct Line {
  Value value;
  std::string text;        // empty: a new line
  std::size_t number = 0;  // of the line in the file, from 1; 0: a new line
};

// A `.motors` file (MOTORS, figure 18, appendix A.15 to A.17), every line in its place. New lines are appended to their
// vector.
struct MapFile {
  std::vector<Line<Curve>> curves;
  std::vector<Line<Lane>> lanes;
  std::vector<Line<Connection>> connections;
  Line<Scale> scale;
  std::string picture;  // the bytes behind the line `i`: a whole PNG or JPEG file, or nothing
};

// Bounds of what is read; beyond them a file is refused with a sentence.
constexpr std::size_t kMaxBytes = 256u << 20;
constexpr std::size_t kMaxLines = 100'000;  // before the picture
constexpr std::size_t kLongestLine = 1000;  // bytes
constexpr float kFarthest_m = 1e6f;         // any coordinate

// Wrong input, with `name`:line, where a line cannot be read; with the byte where the file ends too early.
base::Result<MapFile> ParseMap(std::string_view bytes, const std::string& name);
base::Result<MapFile> LoadMap(const std::filesystem::path& path);

// The bytes of the file: those of ParseMap again where nothing was edited. New numbers are the shortest text that gives
// the same float32; new lines stand behind the others of their kind and end with LF. The byte 'i' stands nowhere before
// the line `i`, where the original program looks for it (A.17).
std::string WriteMap(const MapFile& map);
base::Status SaveMap(const MapFile& map, const std::filesystem::path& path);

}  // namespace rodeira::traffic_map
