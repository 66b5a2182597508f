// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "common/analysis/report/page.hpp"

namespace rodeira::report {

// Speed, pedals, steering, lane position, gap and TTC over time, one curve a recording, as SVG. The marks and events of
// a single recording are vertical lines.
std::string StripsSvg(std::span<const ReportedDrive> drives);
// Shares of time by speed, lane position and time gap, as SVG.
std::string DistributionsSvg(std::span<const ReportedDrive> drives);

}  // namespace rodeira::report
