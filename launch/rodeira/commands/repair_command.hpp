// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::cli {

// `rodeira repair FILE.mcap --out FILE`: writes what is left of a recording as a whole one and says what is lost.
int RepairRecording(const std::string& recording, const std::string& out);

}  // namespace rodeira::cli
