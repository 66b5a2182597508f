// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/run_meta.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/utf8.hpp"
#include "common/core/config/quoted.hpp"

namespace rodeira::cli {
namespace {

bool IsName(std::string_view key) {
  return !key.empty() && key.size() <= 64 && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string RecorderOf(const launch::Launch& launch) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name == "recorder") return node.name;
  }
  return "";
}

}  // namespace

base::Status AddMeta(const launch::Launch& launch, const std::vector<std::string>& meta, launch::Overrides& overrides) {
  if (meta.empty()) return {};
  const std::string recorder = RecorderOf(launch);
  if (recorder.empty())
    return base::WrongInput("command.wrong_combination", "nothing is recorded, so there is nowhere to write it",
                            "--meta");
  for (const std::string& pair : meta) {
    const auto equals = pair.find('=');
    const std::string key = pair.substr(0, equals);
    if (equals == std::string::npos || !IsName(key)) {
      return base::WrongInput(
          "command.wrong_value",
          fmt::format("'{}' was found; KEY=VALUE was expected, the key of letters, digits, _ and -", pair), "--meta");
    }
    if (base::FirstNotUtf8(pair)) {
      return base::WrongInput("command.wrong_value",
                              fmt::format("'{}' is not UTF-8, which texts in a recording are", pair), "--meta");
    }
    overrides.emplace_back("nodes." + recorder + ".config.meta." + key,
                           config::Quoted(std::string_view(pair).substr(equals + 1)));
  }
  return {};
}

}  // namespace rodeira::cli
