// SPDX-License-Identifier: Apache-2.0
// A fresh process: takes snapshots of all nodes of a launch from a folder, goes on from there, prints the run's digest.
// resume_run LAUNCH.yaml FOLDER STEP LAST_STEP
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "launch/rodeira/run/local_nodes.hpp"

int main(int argc, char** argv) {
  using namespace rodeira;
  base::PinMathLibrary(argv);
  if (argc != 5) return 2;
  const auto launch = launch::Launch::Load(argv[1]);
  if (!launch) return 2;
  auto nodes = cli::LocalNodes::Make(launch.value());
  if (!nodes) {
    std::fprintf(stderr, "%s\n", nodes.error().Text().c_str());
    return 2;
  }
  lockstep::InProcessSettings settings;
  settings.first_step = std::atoll(argv[3]);
  settings.last_step = std::atoll(argv[4]);
  for (lockstep::NodeIndex n = 0; n < launch.value().roster().nodes().size(); ++n) {
    settings.resume.emplace_back();
    if (nodes.value().nodes()[n] == nullptr) continue;
    const auto bytes = base::ReadBytes(std::filesystem::path(argv[2]) / (std::to_string(n) + ".snapshot"));
    if (!bytes) return 2;
    auto snapshot = lockstep::Snapshot::Decode(bytes.value());
    if (!snapshot) return 2;
    settings.resume.back() = std::move(snapshot).value();
  }
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  if (!outcome.ok) {
    std::fprintf(stderr, "%s\n", outcome.fault.c_str());
    return 1;
  }
  std::printf("%s\n", base::Hex(outcome.digest).c_str());
}
