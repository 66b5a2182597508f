// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/shell/shell_command.hpp"

namespace rodeira::cli {

void AddShell(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ShellOptions>();
  CLI::App* completion = app.add_subcommand("completion", "print the completion script of a shell");
  completion->add_option("SHELL", options->shell, "bash or zsh")->required()->check(OneOf({"bash", "zsh"}));
  chosen.When(*completion, [options, &app] {
    options->command = "completion";
    return Shell(*options, app);
  });
  CLI::App* manual = app.add_subcommand("manual", "print the manual page (roff)");
  manual->add_flag("--markdown", options->markdown, "commands and options as Markdown");
  chosen.When(*manual, [options, &app] {
    options->command = "manual";
    return Shell(*options, app);
  });
}

}  // namespace rodeira::cli
