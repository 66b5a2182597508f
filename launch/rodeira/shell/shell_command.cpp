// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/shell/shell_command.hpp"

#include <fmt/format.h>

#include "common/core/base/version.hpp"
#include "launch/rodeira/shell/completion.hpp"
#include "launch/rodeira/shell/manual.hpp"

namespace rodeira::cli {

int Shell(const ShellOptions& options, const CLI::App& app) {
  const std::vector<CommandEntry> table = CommandTable(app);
  if (options.command == "manual")
    fmt::print("{}", options.markdown ? ManualMarkdown(table) : ManualPage(table, std::string(base::Version())));
  else
    fmt::print("{}", options.shell == "zsh" ? ZshCompletion(table) : BashCompletion(table));
  return 0;
}

}  // namespace rodeira::cli
