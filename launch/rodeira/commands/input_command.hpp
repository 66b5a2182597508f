// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rodeira::cli {

// `rodeira input setup`: finds out by at most five movements what turns and what is pressed, and writes a wheel file.
struct InputOptions {
  std::optional<std::filesystem::path> out;  // otherwise the user's folder, by GUID
  double lock_deg = 450.0;
};

// `say` prints a line to the person; `wait` waits for 10 ms and is false where the person has had enough.
int SetUpInput(const InputOptions& options, const std::function<void(const std::string&)>& say,
               const std::function<bool()>& wait);
// The same at the terminal, until Ctrl-C.
int SetUpInput(const InputOptions& options);

}  // namespace rodeira::cli
