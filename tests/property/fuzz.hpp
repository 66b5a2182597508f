// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "tests/property/mutate.hpp"
#include "tests/setting.hpp"

namespace rodeira::property {

using rodeira::Setting;

// One sentence for a terminal: with a place, without line breaks or other control characters.
void ExpectSentence(const base::Error& error);

// What a reader says to a text; nothing where it takes it.
using Read = std::function<std::optional<base::Error>(const std::string& text)>;
// Changes a text once.
using Change = std::function<void(std::string& text, Draw& draw)>;

// Gives the reader the good texts, which it must take, and RODEIRA_FUZZ_FILES seeded mutations of them from the number
// RODEIRA_FUZZ_FIRST on: each taken or refused with a sentence, within a minute of the processor. Which one was being
// read is said where that ends the process. `change` stands in the place of Mutate (tests/property/mutate.hpp).
void Fuzz(const char* format, const std::vector<std::string>& good, const Read& read, const Change& change = Mutate);

}  // namespace rodeira::property
