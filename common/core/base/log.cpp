// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/log.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace rodeira::base {

void Log(LogLevel level, std::string_view node, std::string_view text) {
  const std::string place = node.empty() ? std::string() : fmt::format("node '{}': ", node);
  fmt::print(stderr, "rodeira: {}{}: {}\n", place, level == LogLevel::kWarning ? "warning" : "info", text);
}

}  // namespace rodeira::base
