// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/core/base/result.hpp"

// The time series of a drive: `time_s`, the columns of DriveColumns, and those that follow from them.
namespace rodeira::measures {

// Names with units, in the order of a table's columns; `time_s` is the first one.
const std::vector<std::string>& SeriesNames();
// Wrong input, with the nearest right name, where there is no such column.
base::Result<std::size_t> FindSeries(std::string_view name);
// Column `column` of SeriesNames at sample k; NaN where it is missing.
double SeriesValue(const Drive& drive, std::size_t column, std::size_t k);
// The whole column.
std::vector<double> SeriesOf(const Drive& drive, std::size_t column);

}  // namespace rodeira::measures
