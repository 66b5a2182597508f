// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "launch/rodeira/commands/all_commands.hpp"
#include "launch/rodeira/commands/schema_command.hpp"

namespace rodeira::cli {

void AddSchema(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<SchemaOptions>();
  CLI::App* command = app.add_subcommand("schema", "print the keys of a kind of file: defaults, ranges, meaning");
  command->add_option("KIND", options->kind, "kind of file (driver, lab ...); otherwise the kinds are listed");
  CLI::Option* json = command->add_flag("--json", options->json, "as JSON Schema, for editors of YAML");
  command->add_flag("--markdown", options->markdown, "as a table in Markdown")->excludes(json);
  chosen.When(*command, [options] { return PrintSchema(*options); });
}

}  // namespace rodeira::cli
