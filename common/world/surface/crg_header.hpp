// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

// The head of an OpenCRG file (ASAM OpenCRG 1.2, chapter "Data format"): named sections of text, in front of the
// numbers.
namespace rodeira::surface {

// What a column of the file's numbers is.
enum class CrgColumn {
  kHeading,  // of the reference line's step that ends in this row, rad; the first row's is not used
  kX,        // of the reference line, m; used where there is no heading
  kY,
  kSlope,    // dz/du over the step that ends in this row; the first row's is not used
  kBanking,  // dz/dv
  kHeight,   // m, on a line along the road at a constant v
  kUnused,   // u of the reference line: it is implied
};

// One column of the file's numbers.
struct CrgChannel {
  CrgColumn column = CrgColumn::kUnused;
  std::optional<double> v_m;  // of a height: where the file says "at v ="
  int number = 0;             // of a height: where the file counts them instead, from 1 at the right
};

enum class CrgFormat { kNone, kText10, kText20, kFloat, kDouble };  // LRFI, LDFI, KRBI, KDBI

// $ROAD_CRG. Absent keys stay empty; what they mean then is said in crg_data.hpp.
struct CrgRoadKeys {
  std::optional<double> start_u_m, end_u_m, increment_m;
  std::optional<double> start_x_m, start_y_m, start_z_m, start_heading_rad, start_slope, start_banking;
  std::optional<double> end_x_m, end_y_m, end_z_m, end_heading_rad, end_slope, end_banking;
  std::optional<double> v_right_m, v_left_m, v_increment_m;
};

// What lies beyond the first and last u, or beyond the outermost v.
enum class CrgBorder { kNone = 0, kZero = 1, kKeep = 2, kRepeat = 3, kReflect = 4 };

// $ROAD_CRG_OPTS, as far as it changes an answer.
struct CrgOptions {
  CrgBorder border_u = CrgBorder::kKeep;
  CrgBorder border_v = CrgBorder::kKeep;
  double offset_u_m = 0.0;  // added beyond the border where it is zero or kept
  double offset_v_m = 0.0;
  double smooth_begin_m = 0.0;  // over this length the heights grow from the reference line's height at its start
  double smooth_end_m = 0.0;    // and shrink to that at its end
  bool close_track = false;     // the end of the reference line goes on at its start, where both nearly meet
};

// $ROAD_CRG_MODS, in the order in which they act.
struct CrgModifiers {
  double scale_height = 1.0, scale_slope = 1.0, scale_banking = 1.0;
  double scale_length = 1.0, scale_width = 1.0, scale_curvature = 1.0;
  int missing = 2;  // heights missing at the sides: 0 stay missing, 1 zero, 2 the outermost one of the row
  double missing_offset_m = 0.0;
  // The reference point comes to lie at a place, in a direction …
  std::optional<double> point_u_m, point_u_fraction, point_u_offset_m, point_v_m, point_v_fraction, point_v_offset_m;
  std::optional<double> point_x_m, point_y_m, point_z_m, point_heading_rad;
  // … or else everything is turned about a centre and shifted.
  std::optional<double> centre_x_m, centre_y_m, turn_rad, shift_x_m, shift_y_m, shift_z_m;
};

// All that the head of a file says.
struct CrgHeader {
  std::string comment;  // $CT
  CrgRoadKeys road;
  std::optional<CrgOptions> options;  // where the file has the section
  std::optional<CrgModifiers> modifiers;
  std::string other_file;  // $ROAD_CRG_FILE: the numbers are there
  std::vector<CrgChannel> channels;
  CrgFormat format = CrgFormat::kNone;
  std::size_t data_offset = 0;        // of the numbers in the file; 0: the file has none
  int data_line = 0;                  // the line that they begin in
  std::vector<std::string> warnings;  // what was passed over, each with its line
};

// `name` stands in front of each line's number in messages. Wrong input: a key without a number, a value out of the
// format's range, a column or a number format that OpenCRG does not know.
base::Result<CrgHeader> ReadCrgHeader(std::span<const std::byte> bytes, std::string_view name);

}  // namespace rodeira::surface
