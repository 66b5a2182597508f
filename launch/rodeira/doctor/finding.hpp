// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "common/core/base/error_id.hpp"

namespace rodeira::cli {

inline constexpr double kBytesPerMegabyte = 1e6;

enum class Verdict {
  kOk,
  kWarning,  // a run works, but something may surprise
  kFault,    // a run, or a part of it, cannot work
};

// What one check of `rodeira doctor` says.
struct Finding {
  std::string check;  // "shared memory"
  Verdict verdict = Verdict::kOk;
  std::string sentence;   // what was found and, where that is not well, what was expected and what to do
  base::ErrorId id = {};  // of what is not well
};

// The id names the kind of what is not well (docs/reference/errors.md).
inline Finding Ok(std::string check, std::string sentence) {
  return {std::move(check), Verdict::kOk, std::move(sentence)};
}
inline Finding Warning(base::ErrorId id, std::string check, std::string sentence) {
  return {std::move(check), Verdict::kWarning, std::move(sentence), id};
}
inline Finding Fault(base::ErrorId id, std::string check, std::string sentence) {
  return {std::move(check), Verdict::kFault, std::move(sentence), id};
}

}  // namespace rodeira::cli
