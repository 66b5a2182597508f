// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/repair_command.hpp"

#include <fmt/format.h>
#include <signal.h>

#include "common/core/base/print_error.hpp"
#include "common/data/record/repair.hpp"
#include "common/runtime/replay/repaired_end.hpp"
#include "launch/rodeira/replay/recording_text.hpp"

namespace rodeira::cli {

int RepairRecording(const std::string& recording, const std::string& out) {
  ::signal(SIGXFSZ, SIG_IGN);
  replay::RepairedEnd end;
  const auto report = record::Repair(recording, out, &end);
  if (!report) return base::PrintError("rodeira", report.error());
  const auto& done = report.value();
  fmt::print("{}{}  {} of {}\n", done.Text(), out, Size(done.target_bytes), Size(done.source_bytes));
  return done.lost ? 1 : 0;
}

}  // namespace rodeira::cli
