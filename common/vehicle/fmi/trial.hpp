// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "common/core/base/result.hpp"

namespace rodeira::fmi {

// Runs foreign code in a child of this process and throws away what it did: wrong input where it is killed by a signal,
// or has computed for `most_s` seconds (waited for ten times as long) and is not back. What it returns itself is for
// the caller to find again.
base::Status TryInChild(const std::function<void()>& code, unsigned most_s = 10);

}  // namespace rodeira::fmi
