// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "launch/rodeira/commands/chosen_command.hpp"

// Each function declares a command with its options and their help, and says what `chosen` runs if the command line
// names it. Their order in `Main` is that of `rodeira --help`.
namespace rodeira::cli {

void AddRun(CLI::App& app, ChosenCommand& chosen);
void AddWorld(CLI::App& app, ChosenCommand& chosen);
void AddWorldImport(CLI::App& world, ChosenCommand& chosen);  // a command of `rodeira world`
void AddMap(CLI::App& app, ChosenCommand& chosen);
void AddTraffic(CLI::App& app, ChosenCommand& chosen);
void AddPolyline(CLI::App& app, ChosenCommand& chosen);
void AddSurface(CLI::App& app, ChosenCommand& chosen);
void AddMechanism(CLI::App& app, ChosenCommand& chosen);
void AddVehicle(CLI::App& app, ChosenCommand& chosen);
void AddDoctor(CLI::App& app, ChosenCommand& chosen);
void AddJoysticks(CLI::App& app, ChosenCommand& chosen);
void AddInput(CLI::App& app, ChosenCommand& chosen);
void AddEdit(CLI::App& app, ChosenCommand& chosen);
void AddCtl(CLI::App& app, ChosenCommand& chosen);
void AddInfo(CLI::App& app, ChosenCommand& chosen);
void AddExport(CLI::App& app, ChosenCommand& chosen);
void AddRepair(CLI::App& app, ChosenCommand& chosen);
void AddMeasures(CLI::App& app, ChosenCommand& chosen);
void AddReport(CLI::App& app, ChosenCommand& chosen);
void AddSchema(CLI::App& app, ChosenCommand& chosen);
void AddReplay(CLI::App& app, ChosenCommand& chosen);
void AddView(CLI::App& app, ChosenCommand& chosen);
void AddEnv(CLI::App& app, ChosenCommand& chosen);    // for rodeira.Env; not in `rodeira --help`
void AddShell(CLI::App& app, ChosenCommand& chosen);  // completion, manual

}  // namespace rodeira::cli
