// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::window {

// Whether a video driver of SDL shows anything; null: no driver. Where no display answers, SDL draws
// unseen.
bool IsDisplay(const char* driver);

}  // namespace rodeira::window
