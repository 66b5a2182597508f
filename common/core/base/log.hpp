// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::base {

// Kind of a line of Log.
enum class LogLevel {
  kInfo,     // "rodeira: info: …"
  kWarning,  // "rodeira: warning: …": the run goes on without something
};

// Writes one line to standard error: "rodeira: node 'NAME': warning: TEXT", without the node's part if `node` is empty.
// `rodeira run` reads the level from the line and keeps the line in the part's log file. An error that ends the
// program is PrintError's.
void Log(LogLevel level, std::string_view node, std::string_view text);

}  // namespace rodeira::base
