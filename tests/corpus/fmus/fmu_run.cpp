// SPDX-License-Identifier: Apache-2.0
// fmu_run FMU STEP_S: loads an FMU, takes 100 steps and reads every number of it. An FMU with states goes on from the
// state in their middle in a new instance, and has the same numbers at the end. Prints one line: "runs", "refused"
// (exit status 2) or "fails" (1), and a sentence.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "common/vehicle/fmi/unit.hpp"

namespace rodeira::fmi {
namespace {

constexpr int kSteps = 100;

base::Result<std::unique_ptr<Instance>> Start(Unit& unit) {
  auto instance = unit.Instantiate("corpus");
  if (!instance) return instance.error();
  if (auto status = instance.value()->EnterInitialisation(0.0); !status) return status.error();
  if (auto status = instance.value()->ExitInitialisation(); !status) return status.error();
  return instance;
}

base::Status Steps(Instance& instance, int from, int to, double step_s) {
  for (int i = from; i < to; ++i)
    if (auto status = instance.DoStep(i * step_s, step_s); !status) return status;
  return {};
}

// By their bits: values that are no number compare, too.
base::Result<std::vector<std::uint64_t>> Numbers(const Description& description, Instance& instance) {
  std::vector<std::uint64_t> numbers;
  for (const Variable& variable : description.variables) {
    if (variable.type == VariableType::kOther) continue;
    const auto value = instance.Get(variable);
    if (!value) return value.error();
    numbers.push_back(std::bit_cast<std::uint64_t>(value.value()));
  }
  return numbers;
}

struct Told {
  std::string text;
  bool runs = true;
};

base::Result<Told> Run(Unit& unit, double step_s) {
  auto first = Start(unit);
  if (!first) return first.error();
  if (auto status = Steps(*first.value(), 0, kSteps / 2, step_s); !status) return status.error();
  base::Bytes state;
  if (unit.can_save_state()) {
    auto saved = first.value()->State();
    if (!saved) return saved.error();
    state = std::move(saved).value();
  }
  if (auto status = Steps(*first.value(), kSteps / 2, kSteps, step_s); !status) return status.error();
  const auto numbers = Numbers(unit.description(), *first.value());
  if (!numbers) return numbers.error();
  const std::string told = fmt::format("{} numbers; ", numbers.value().size());
  if (!unit.can_save_state())
    return Told{told + (unit.note().empty() ? "no states" : "its states are of no use to another process")};
  if (unit.description().only_once) {
    if (auto status = first.value()->SetState(state); !status) return status.error();
  } else {
    first = Start(unit);
    if (!first) return first.error();
    if (auto status = first.value()->SetState(state); !status) return status.error();
  }
  if (auto status = Steps(*first.value(), kSteps / 2, kSteps, step_s); !status) return status.error();
  const auto again = Numbers(unit.description(), *first.value());
  if (!again) return again.error();
  const bool is_same = again.value() == numbers.value();
  return Told{told + (is_same ? "from its state the same" : "from its state others"), is_same};
}

int Main(int argc, char** argv) {
  const double step_s = argc == 3 ? std::strtod(argv[2], nullptr) : 0.0;
  if (!(step_s > 0.0)) {
    fmt::print(stderr, "usage: fmu_run FMU STEP_S\n");
    return 64;
  }
  const auto unit = Unit::Load(argv[1]);
  if (!unit) {
    fmt::print("{}\t{}\n", unit.error().exit_status() == 2 ? "refused" : "fails", unit.error().message);
    return unit.error().exit_status();
  }
  const auto told = Run(*unit.value(), step_s);
  const bool runs = told && told.value().runs;
  fmt::print("{}\t{}\n", runs ? "runs" : "fails", told ? told.value().text : told.error().message);
  std::fflush(stdout);
  return runs ? 0 : 1;
}

}  // namespace
}  // namespace rodeira::fmi

int main(int argc, char** argv) { return rodeira::fmi::Main(argc, argv); }
