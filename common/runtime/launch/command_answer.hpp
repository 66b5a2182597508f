// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::launch {

// The answer to an operator's command as one line of the control socket (docs/reference/run-control.md):
// "ok SENTENCE", "wrong ID SENTENCE" where the command is wrong input, or "failed ID SENTENCE".
std::string AnswerLine(const base::Result<std::string>& done);

// The same, read. An id that no command gives, as of another version, becomes "run.refused". A line of another form
// is an error "run.no_answer".
base::Result<std::string> ReadAnswer(std::string_view line);

}  // namespace rodeira::launch
