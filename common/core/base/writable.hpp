// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// Whether WriteWhole (files.hpp) can write there, which is tried, its folders made; failed where it cannot, or a folder
// has that name. Nothing else changes.
Status CheckWritable(const std::filesystem::path& path);

}  // namespace rodeira::base
