// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/run_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/runtime/dds/network_state.hpp"
#include "common/runtime/launch/segments.hpp"
#include "common/runtime/launch/shared_process.hpp"
#include "launch/rodeira/run/host_hold.hpp"
#include "launch/rodeira/run/shared_memory.hpp"

namespace rodeira::cli {
namespace {

constexpr std::uint32_t kSegmentStepKib = 256;
// Below that the samples of one step may fill a segment.
constexpr std::uint32_t kMinSegmentKib = 1024;

double Megabytes(std::uint64_t bytes) { return static_cast<double>(bytes) * 1e-6; }

// The segments of the clock and of the nodes, KiB. A process that is started again finds the files of the dead one,
// which others still use.
std::vector<std::uint32_t> SegmentsOf(const launch::Launch& launch, const Placement& placement) {
  std::vector<std::uint32_t> segments_kib(launch.keeps_for_restarts() ? 3 : 1, launch::SegmentKibOf(launch, {}));
  for (const launch::NodeProcess& process : launch::ProcessesOf(launch)) {
    if (placement.Has(launch.node(process.nodes.front())))
      segments_kib.push_back(launch::SegmentKibOf(launch, process.nodes));
  }
  return segments_kib;
}

// Bytes of shared memory of processes with these segments, none of them larger than `most_kib`.
std::uint64_t NeedOf(std::span<const std::uint32_t> segments_kib, std::uint32_t most_kib) {
  std::uint64_t bytes = 0;
  for (const std::uint32_t segment_kib : segments_kib) bytes += dds::SharedMemoryNeed(std::min(segment_kib, most_kib));
  return bytes;
}

// Over the loop-back interface: nothing of the run leaves this PC.
base::Status UseUdp(const launch::Launch& launch, const std::string& reason, RunNetwork& network) {
  launch::TransportSettings transport = launch.transport_settings();
  transport.kind = launch::Transport::kUdp;
  const bool is_kept = transport.has_observers;
  network.overrides.emplace_back("transport", launch::TransportText(transport));
  if (!is_kept) network.overrides.emplace_back("discovery", "{kind: multicast, interface: 127.0.0.1}");
  network.note = fmt::format("{}; the run uses UDP{} instead of shared memory", reason, is_kept ? "" : " on 127.0.0.1");
  const dds::NetworkNeed need{transport, is_kept ? launch.discovery().interface : "127.0.0.1", false};
  if (const auto problem = dds::NetworkProblem(need, dds::ReadNetworkState()))
    return base::WrongInput("dds.no_transport", fmt::format("{}, and UDP cannot be used instead: {}", reason, *problem),
                            "shared memory");
  return {};
}

// What the processes need of shared memory is there, or smaller segments are, or UDP takes its place.
base::Status FitSharedMemory(const launch::Launch& launch, std::span<const std::uint32_t> segments_kib,
                             const std::filesystem::path& folder, RunNetwork& network) {
  const std::uint32_t wanted_kib = std::ranges::max(segments_kib);
  const auto need = [segments_kib](std::uint32_t most_kib) { return NeedOf(segments_kib, most_kib); };
  const auto room = dds::TryRoom(need(wanted_kib), folder);
  if (room.ok()) return {};
  const auto free_bytes = dds::FreeSharedMemory(folder);
  if (!free_bytes) return UseUdp(launch, free_bytes.error().Text(), network);
  const std::string found =
      fmt::format("{} has {:.1f} MB free, {} processes need {:.1f} MB", folder.string(), Megabytes(free_bytes.value()),
                  segments_kib.size(), Megabytes(need(wanted_kib)));
  launch::TransportSettings smaller = launch.transport_settings();
  smaller.segment_kib = SegmentThatFits(free_bytes.value(), segments_kib);
  if (smaller.segment_kib == 0 || !dds::TryRoom(need(smaller.segment_kib), folder).ok())
    return UseUdp(launch, found, network);
  network.overrides.emplace_back("transport", launch::TransportText(smaller));
  network.note = fmt::format("{}; each uses a segment of at most {} KiB instead of {} KiB", found, smaller.segment_kib,
                             wanted_kib);
  return {};
}

}  // namespace

std::uint32_t SegmentThatFits(std::uint64_t free_bytes, std::span<const std::uint32_t> segments_kib) {
  std::uint32_t most_kib = std::ranges::max(segments_kib);
  for (; most_kib >= kMinSegmentKib; most_kib -= kSegmentStepKib) {
    if (NeedOf(segments_kib, most_kib) <= free_bytes) return most_kib;
  }
  return 0;
}

std::uint32_t SegmentThatFits(std::uint64_t free_bytes, int processes) {
  return SegmentThatFits(free_bytes, std::vector<std::uint32_t>(static_cast<std::size_t>(processes),
                                                                launch::TransportSettings::kSegmentKib));
}

base::Result<RunNetwork> RunNetwork::Prepare(const RunOptions& options, const Placement& placement,
                                             const launch::Launch& launch, const DomainPlace& place) {
  if (const auto problem = dds::NetworkProblem(dds::NeedOf(launch), dds::ReadNetworkState()))
    return base::WrongInput("dds.no_transport", *problem, launch.path().string());
  RemoveLeftOvers({}, place.folder);  // of dead runs: they count neither as ports nor as room
  RunNetwork network;
  if (options.domain) {
    network.domain = *options.domain;
    network.hold = DomainHold::Take(network.domain, place);
  } else {
    auto hold = DomainHold::FindFree(options.run, place);
    if (!hold) return hold.error();
    network.domain = hold.value().domain();
    network.hold = std::move(hold).value();
  }
  auto host = HoldHost(network.domain, options.run, placement.host(), place);
  if (!host) return host.error();
  network.host = std::move(host).value();
  if (launch.transport() == launch::Transport::kUdp) return network;
  base::Status status;
  if (const auto other = OtherUserOf(network.domain, place)) {
    status = UseUdp(launch, *other, network);
  } else {
    status = FitSharedMemory(launch, SegmentsOf(launch, placement), place.folder, network);
  }
  if (!status) return status.error();
  return network;
}

}  // namespace rodeira::cli
