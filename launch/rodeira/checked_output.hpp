// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace rodeira::cli {

// Runs the command and returns its exit status; 1 instead of 0, with a sentence, where its standard output could not be
// written. Output is written when its buffer is full or here: a disk that is full is noticed then.
int WithCheckedOutput(const std::function<int()>& command);

}  // namespace rodeira::cli
