// SPDX-License-Identifier: Apache-2.0
#include "common/view/window/font.hpp"

#include <imgui.h>

#include <system_error>

namespace rodeira::window {
namespace {

constexpr float kHeight_px = 13.0f;
constexpr ImWchar kLetters[] = {0x0020, 0x024F, 0x0300, 0x052F, 0x1E00, 0x1FFF, 0x2010, 0x2044,
                                0x20AC, 0x20AC, 0x2190, 0x2193, 0x2212, 0x2212, 0};

bool IsFile(const std::filesystem::path& file) {
  std::error_code problem;
  return !file.empty() && std::filesystem::is_regular_file(file, problem);
}

}  // namespace

void UseFont(const std::filesystem::path& file) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  if (IsFile(file) && fonts.AddFontFromFileTTF(file.c_str(), kHeight_px, nullptr, kLetters) != nullptr) return;
  fonts.AddFontDefault();
}

}  // namespace rodeira::window
