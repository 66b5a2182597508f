// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/core/geometry/cubic.hpp"
#include "common/core/geometry/vertical_profile.hpp"

namespace rodeira::design {

// 'vertical': the points where two grades meet. What does not fit together is a problem of the map's file; then the
// points must not be built into a profile.
std::vector<geometry::GradePoint> ReadGrades(const config::Map& road);

// Of points that ascend: where two grades meet without a parabola and differ by more than 0.5 %.
std::vector<std::string> GradeWarnings(const config::Map& road, const std::vector<geometry::GradePoint>& grades);

// The same heights over s in [0, length] as cubics: grades and parabolas.
geometry::CubicTable Elevation(const geometry::VerticalProfile& profile, double length_m);

// 'superelevation': {s_m, slope}, the slope across as a ratio, positive where the left side is higher, passing by
// 3 u^2 - 2 u^3 from point to point; as an angle over s.
geometry::CubicTable ReadSuperelevation(const config::DeclaredMap& road);

}  // namespace rodeira::design
