// SPDX-License-Identifier: Apache-2.0
// Looks on at a run (law L5): reads its grants, reports and samples, best effort, and counts them. SLOW_MS: how long
// each of its callbacks takes.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/participant.hpp"
#include "idl/topics.hpp"

int main(int argc, char** argv) {
  using namespace rodeira;
  const dds::ParsedOptions parsed = dds::ParseOptions("observer", dds::ProgramOf::kNode, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  const auto launch = launch::Launch::Load(parsed.options.launch_file, parsed.options.overrides);
  if (!launch) return launch.error().exit_status();
  const auto participant = dds::Participant::Open(dds::DomainOf(parsed.options, launch.value(), "observer"));
  if (!participant) return participant.error().exit_status();
  const char* slow = std::getenv("SLOW_MS");
  const std::chrono::milliseconds pause(slow == nullptr ? 0 : std::atoi(slow));
  std::atomic<int> heard = 0;
  std::vector<std::unique_ptr<dds::Reader>> readers;
  for (const std::string_view topic :
       {idl::topics::kGrant, idl::topics::kReport, idl::topics::kPulse, idl::topics::kVehicleState}) {
    auto reader = participant.value()->MakeReader(topic, dds::Delivery::kObserve, [&](base::Bytes&&) {
      std::this_thread::sleep_for(pause);
      ++heard;
    });
    if (!reader) return reader.error().exit_status();
    readers.push_back(std::move(reader).value());
  }
  for (;;) {
    fmt::print("heard {}\n", heard > 20 ? "much" : "little");
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}
