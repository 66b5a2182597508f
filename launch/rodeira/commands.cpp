// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/display.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/version.hpp"
#include "launch/rodeira/checked_output.hpp"
#include "launch/rodeira/commands/all_commands.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/json_option.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {
namespace {

// Without a command.
int ChooseCommand() {
  const Graphics* graphics = RegisteredGraphics();
  if (graphics == nullptr && base::NamesDisplay()) return ContinueInGraphics("rodeira without a command");
  if (graphics != nullptr && graphics->has_display()) return graphics->start_window();
  return base::PrintError(
      "rodeira", base::WrongInput("command.missing_command",
                                  "without a command a window opens to choose one, but there is no display; set "
                                  "DISPLAY, or name a command (`rodeira --help` lists them)"));
}

// `rodeira help world` as `rodeira world --help`.
std::vector<std::string> WordsOf(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

// Other processes compute the run.
bool RunsProcesses(int argc, char** argv) {
  return argc > 1 && std::string_view(argv[1]) == "run" && std::none_of(argv + 2, argv + argc, [](const char* word) {
           return std::string_view(word).starts_with("--in-process");
         });
}

int RunCommandLine(int argc, char** argv) {
  if (RunsProcesses(argc, argv))
    base::PinMathLibraryOfChildren();
  else
    base::PinMathLibrary(argv);
  base::NameExhaustion("rodeira");
  KeepArguments(argc, argv);
  if (argc == 1) return ChooseCommand();
  if (WantsJson(argc, argv)) base::PrintErrorsAsJson();
  ChosenCommand chosen;
  CLI::App app{"Rodeira, a distributed driving simulator."};
  app.name("rodeira");
  app.set_version_flag("--version", fmt::format("rodeira {}", base::Version()));
  app.require_subcommand(1);
  for (const auto add :
       {AddRun,      AddWorld,     AddMap,    AddTraffic, AddPolyline, AddSurface, AddMechanism, AddVehicle,
        AddDoctor,   AddJoysticks, AddInput,  AddEdit,    AddCtl,      AddInfo,    AddExport,    AddRepair,
        AddMeasures, AddReport,    AddSchema, AddReplay,  AddView,     AddEnv,     AddShell}) {
    add(app, chosen);
  }
  AddForce(app);
  AddJson(app);
  try {
    std::vector<std::string> words = WordsOf(argc, argv);
    std::ranges::reverse(words);  // as the library takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
      return app.exit(problem);  // --help, --version
    return base::PrintError("", OptionError(app, problem));
  }
  if (auto status = CheckResults(app); !status) return base::PrintError("", status.error());
  return chosen.Run();
}

}  // namespace

int Main(int argc, char** argv) {
  return WithCheckedOutput([argc, argv] { return RunCommandLine(argc, argv); });
}

}  // namespace rodeira::cli
