// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "launch/rodeira/commands/measures_command.hpp"

namespace rodeira::cli {

// Declares `rodeira measures`; its words go into the options, which must live as long as the app.
CLI::App* AddMeasures(CLI::App& app, MeasuresOptions& options);

}  // namespace rodeira::cli
