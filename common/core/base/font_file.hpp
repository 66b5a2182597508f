// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace rodeira::base {

// Where DejaVu Sans is installed (Debian's fonts-dejavu-core); empty where it is not.
std::filesystem::path FontFile();

}  // namespace rodeira::base
