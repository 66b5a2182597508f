// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_keys.hpp"

namespace rodeira::surface {
namespace {

constexpr double kFar = 1e9;  // metres; no place on Earth in any projection lies farther out
constexpr double kTurn = 7.0;
constexpr double kTiny = 1e-6;

template <auto kMember>
void Road(CrgHeader& header, double value) {
  header.road.*kMember = value;
}
template <auto kMember>
void Option(CrgHeader& header, double value) {
  header.options.value().*kMember = value;
}
template <auto kMember>
void Border(CrgHeader& header, double value) {
  header.options.value().*kMember = static_cast<CrgBorder>(static_cast<int>(value));
}
template <auto kMember>
void Modifier(CrgHeader& header, double value) {
  header.modifiers.value().*kMember = value;
}

using R = CrgRoadKeys;
using M = CrgModifiers;

constexpr CrgKey kRoadKeys[] = {
    {"reference_line_start_u", -kFar, kFar, Road<&R::start_u_m>},
    {"reference_line_start_x", -kFar, kFar, Road<&R::start_x_m>},
    {"reference_line_start_y", -kFar, kFar, Road<&R::start_y_m>},
    {"reference_line_start_z", -kFar, kFar, Road<&R::start_z_m>},
    {"reference_line_start_phi", -kTurn, kTurn, Road<&R::start_heading_rad>},
    {"reference_line_start_b", -1.0, 1.0, Road<&R::start_banking>},
    {"reference_line_start_s", -1.0, 1.0, Road<&R::start_slope>},
    {"reference_line_end_u", -kFar, kFar, Road<&R::end_u_m>},
    {"reference_line_end_x", -kFar, kFar, Road<&R::end_x_m>},
    {"reference_line_end_y", -kFar, kFar, Road<&R::end_y_m>},
    {"reference_line_end_z", -kFar, kFar, Road<&R::end_z_m>},
    {"reference_line_end_phi", -kTurn, kTurn, Road<&R::end_heading_rad>},
    {"reference_line_end_b", -1.0, 1.0, Road<&R::end_banking>},
    {"reference_line_end_s", -1.0, 1.0, Road<&R::end_slope>},
    {"reference_line_increment", kTiny, 1e6, Road<&R::increment_m>},
    {"long_section_v_right", -1e6, 1e6, Road<&R::v_right_m>},
    {"long_section_v_left", -1e6, 1e6, Road<&R::v_left_m>},
    {"long_section_v_increment", kTiny, 1e6, Road<&R::v_increment_m>},
    {"reference_line_offset_x"},
    {"reference_line_offset_y"},
    {"reference_line_offset_z"},
    {"reference_line_offset_phi"},
    {"reference_line_start_lon"},
    {"reference_line_start_lat"},
    {"reference_line_start_alt"},
    {"reference_line_end_lon"},
    {"reference_line_end_lat"},
    {"reference_line_end_alt"},
};

constexpr CrgKey kOptionKeys[] = {
    {"border_mode_u", 0.0, 4.0, Border<&CrgOptions::border_u>, true},
    {"border_mode_v", 0.0, 4.0, Border<&CrgOptions::border_v>, true},
    {"border_offset_u", -kFar, kFar, Option<&CrgOptions::offset_u_m>},
    {"border_offset_v", -kFar, kFar, Option<&CrgOptions::offset_v_m>},
    {"border_smooth_ubeg", 0.0, kFar, Option<&CrgOptions::smooth_begin_m>},
    {"border_smooth_uend", 0.0, kFar, Option<&CrgOptions::smooth_end_m>},
    {"refline_continuation", 0.0, 1.0,
     [](CrgHeader& header, double value) { header.options.value().close_track = value != 0.0; }, true},
    {"refline_search_far"},
    {"refline_search_close"},
    {"refline_search_u"},
    {"refline_search_ufrac"},
    {"warn_msgs"},
    {"warn_curv_local"},
    {"warn_curv_global"},
    {"log_msgs"},
    {"log_eval"},
    {"log_eval_freq"},
    {"log_hist"},
    {"log_hist_freq"},
    {"log_stat"},
    {"log_stat_freq"},
    {"check_eps"},
    {"check_inc"},
    {"check_tol"},
};

constexpr CrgKey kModifierKeys[] = {
    {"scale_z_grid", -1e6, 1e6, Modifier<&M::scale_height>},
    {"scale_slope", -1e6, 1e6, Modifier<&M::scale_slope>},
    {"scale_banking", -1e6, 1e6, Modifier<&M::scale_banking>},
    {"scale_length", 1e-3, 1e3, Modifier<&M::scale_length>},
    {"scale_width", 1e-3, 1e3, Modifier<&M::scale_width>},
    {"scale_curvature", -1e3, 1e3, Modifier<&M::scale_curvature>},
    {"grid_nan_mode", 0.0, 2.0,
     [](CrgHeader& header, double value) { header.modifiers.value().missing = static_cast<int>(value); }, true},
    {"grid_nan_offset", -kFar, kFar, Modifier<&M::missing_offset_m>},
    {"refpoint_u", -kFar, kFar, Modifier<&M::point_u_m>},
    {"refpoint_u_fraction", -1e3, 1e3, Modifier<&M::point_u_fraction>},
    {"refpoint_u_offset", -kFar, kFar, Modifier<&M::point_u_offset_m>},
    {"refpoint_v", -1e6, 1e6, Modifier<&M::point_v_m>},
    {"refpoint_v_fraction", -1e3, 1e3, Modifier<&M::point_v_fraction>},
    {"refpoint_v_offset", -1e6, 1e6, Modifier<&M::point_v_offset_m>},
    {"refpoint_x", -kFar, kFar, Modifier<&M::point_x_m>},
    {"refpoint_y", -kFar, kFar, Modifier<&M::point_y_m>},
    {"refpoint_z", -kFar, kFar, Modifier<&M::point_z_m>},
    {"refpoint_phi", -kTurn, kTurn, Modifier<&M::point_heading_rad>},
    {"refline_rotcenter_x", -kFar, kFar, Modifier<&M::centre_x_m>},
    {"refline_rotcenter_y", -kFar, kFar, Modifier<&M::centre_y_m>},
    {"refline_offset_phi", -kTurn, kTurn, Modifier<&M::turn_rad>},
    {"refline_offset_x", -kFar, kFar, Modifier<&M::shift_x_m>},
    {"refline_offset_y", -kFar, kFar, Modifier<&M::shift_y_m>},
    {"refline_offset_z", -kFar, kFar, Modifier<&M::shift_z_m>},
};

}  // namespace

std::span<const CrgKey> CrgRoadKeyTable() { return kRoadKeys; }
std::span<const CrgKey> CrgOptionTable() { return kOptionKeys; }
std::span<const CrgKey> CrgModifierTable() { return kModifierKeys; }

}  // namespace rodeira::surface
