// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/branch_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/core/base/print_error.hpp"
#include "common/runtime/launch/pace.hpp"
#include "common/runtime/replay/splice.hpp"
#include "launch/rodeira/files_from_here.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/named_inputs.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/recording_text.hpp"
#include "launch/rodeira/run/operator.hpp"
#include "launch/rodeira/whole_steps.hpp"

namespace rodeira::cli {
namespace {

// With the option that made it wrong: a branch's changes are said by --branch, as they were typed.
base::Error WithBranchOption(const base::Error& error, const launch::Overrides& typed, const launch::Overrides& read) {
  std::string place = error.context, message = error.message;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::string set = fmt::format("--set {}={}", read[i].first, read[i].second);
    for (std::string* text : {&place, &message}) {
      if (const auto at = text->find(set); at != std::string::npos)
        text->replace(at, set.size(), fmt::format("--branch {}={}", typed[i].first, typed[i].second));
    }
  }
  return error.WithMessage(message).WithContext(place);
}

// `needs_graphics`: whether the branch draws, or reads a wheel or a game pad.
base::Result<BranchSpec> SpecOf(const ReplayOptions& options, bool& needs_graphics) {
  if (!options.from_s)
    return base::WrongInput("command.missing_option",
                            "--from is missing; name the time in s at which the branch leaves its parent",
                            "replay --branch");
  if (options.record.empty())
    return base::WrongInput("command.missing_option", "--record is missing; name a new file for the branch",
                            "replay --branch");
  if (auto status = replay::CheckNewRecording(options.record); !status) return status.error();
  const auto parent = replay::RecordedRun::Open(options.file);
  if (!parent) return parent.error();
  const auto steps = [&](double seconds, const char* option) {
    return WholeSteps(seconds, parent.value().roster().base_step_ns(), option, options.file);
  };
  const auto from = steps(*options.from_s, "--from");
  if (!from) return base::WrongInput("replay.wrong_branch_time", from.error().message, options.file);
  BranchSpec spec;
  spec.parent = options.file;
  spec.at = from.value();
  if (options.for_s) {
    const auto duration = steps(*options.for_s, "--for");
    if (!duration) return duration.error();
    spec.last_step = spec.at + duration.value();
  }
  const auto named = WithNamedInputs(options.changes, parent.value().launch().path(), "--branch");
  if (!named) return named.error();
  for (const auto& [key, value] : named.value()) spec.changes.emplace_back(key, WithFilesFromHere(value));
  auto libraries = LibrariesOf(options);
  if (!libraries) return libraries.error();
  spec.libraries = std::move(libraries).value();
  spec.recording = options.record;
  spec.stop_requested = Interrupted;
  spec.with_view = options.view;
  const auto persons = DrivenLive(spec);
  if (!persons) return WithBranchOption(persons.error(), options.changes, spec.changes);
  const auto pace =
      launch::ParsePace(options.pace.value_or(options.view || !persons.value().names.empty() ? "real" : "max"));
  if (!pace) return pace.error();
  spec.pace = pace.value();
  needs_graphics = options.view || persons.value().by_device;
  return spec;
}

void Tell(const ReplayOptions& options, const BranchOutcome& outcome) {
  const std::string basis =
      outcome.recomputed_from == outcome.at
          ? fmt::format("the states recorded at step {}", outcome.at)
          : fmt::format("repeated from step {} to {}, identical", outcome.recomputed_from, outcome.at);
  fmt::print("parent    {} ({})\nbranch    steps {} to {}\n", options.file, basis, outcome.at, outcome.last_step);
  for (const auto& [key, value] : options.changes) fmt::print("changed   {} = {}\n", key, value);
  if (!outcome.without_state.empty()) fmt::print("{}", ComputedFromTheStart(outcome.without_state));
  if (!outcome.live.empty()) fmt::print("driven by a person: {}\n", fmt::join(outcome.live, ", "));
  if (!outcome.taken_over.empty())
    fmt::print("began from what was published: {}\n", fmt::join(outcome.taken_over, ", "));
  fmt::print("wrote     {}\n", options.record);
}

}  // namespace

int MakeBranch(const ReplayOptions& options) {
  bool needs_graphics = false;
  auto spec = SpecOf(options, needs_graphics);
  if (!spec) return base::PrintError("rodeira", spec.error());
  if (needs_graphics && CanContinueInGraphics()) return ContinueInGraphics("replay --branch");
  std::unique_ptr<Operator> run_operator;
  if (spec.value().pace > 0.0) {  // there is time to say something
    run_operator =
        std::make_unique<Operator>("branch-" + std::filesystem::path(options.record).stem().string(), options.quiet);
    spec.value().next_command = [&run_operator] { return NextCommand(*run_operator); };
  }
  const auto outcome = Branch(spec.value());
  run_operator.reset();  // the terminal is a terminal again
  if (!outcome)
    return base::PrintError("rodeira", WithBranchOption(outcome.error(), options.changes, spec.value().changes));
  if (outcome.value().difference) {
    const int status = base::PrintError("rodeira", base::Failed("replay.different",
                                                                "the parent could not be repeated up to the branch; " +
                                                                    outcome.value().difference->Text(),
                                                                options.file));
    fmt::print(stderr, "{}", outcome.value().recorded_by_another);
    return status;
  }
  Tell(options, outcome.value());
  return 0;
}

}  // namespace rodeira::cli
