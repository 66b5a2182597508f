// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/print_error.hpp"
#include "launch/rodeira/env/env_command.hpp"
#include "launch/rodeira/key_values.hpp"

namespace rodeira::cli {

void AddEnv(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<EnvOptions>();
  const auto sets = std::make_shared<std::vector<std::string>>();
  CLI::App* env = app.add_subcommand("env", "episodes for rodeira.Env of the Python package, over pipes");
  env->group("");
  env->add_option("LAUNCH.yaml", options->launch_file, "launch file, or its name (demo)")->required();
  env->add_option("--agent", options->agent, "input node that the agent drives")->required();
  env->add_option("--set", *sets, "KEY=VALUE: replaces a value of the launch file");
  chosen.When(*env, [options, sets] {
    auto overrides = KeyValues("--set", *sets);
    if (!overrides) return base::PrintError("rodeira", overrides.error());
    options->overrides = std::move(overrides).value();
    return Env(*options);
  });
}

}  // namespace rodeira::cli
