// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/font_file.hpp"

#include <system_error>

namespace rodeira::base {

std::filesystem::path FontFile() {
  for (const char* folder :
       {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF"}) {
    const std::filesystem::path file = std::filesystem::path(folder) / "DejaVuSans.ttf";
    std::error_code problem;
    if (std::filesystem::is_regular_file(file, problem)) return file;
  }
  return {};
}

}  // namespace rodeira::base
