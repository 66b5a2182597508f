// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/json_option.hpp"

#include <string_view>

namespace rodeira::cli {
namespace {

constexpr const char* kJson = "--json";

}  // namespace

void AddJson(CLI::App& app) {
  if (app.get_option_no_throw(kJson) == nullptr)  // otherwise the command prints its result as JSON, too
    app.add_flag(kJson)->description("errors as JSON on standard error, one per line");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) AddJson(*command);
}

bool WantsJson(int argc, const char* const* argv) {
  for (int n = 1; n < argc && std::string_view(argv[n]) != "--"; ++n) {
    if (std::string_view(argv[n]) == kJson) return true;
  }
  return false;
}

}  // namespace rodeira::cli
