#include "launch/in_process_command.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "common/dds/options.hpp"
#include "common/lockstep/in_process.hpp"
#include "launch/node_factories.hpp"
#include "launch/run_report.hpp"
#include "nodes/road/road_service.hpp"

namespace rodeira::front {
namespace {

std::atomic<bool> g_interrupted = false;
void OnInterrupt(int) { g_interrupted = true; }

// SUELO from the library itself; each node has a Ground of its own on the one world.
class LocalContext final : public launch::NodeContext {
 public:
  LocalContext(const launch::Launch& launch, lockstep::NodeIndex index, std::shared_ptr<const road::World> world)
      : NodeContext(launch, index), world_(std::move(world)) {
    if (world_ != nullptr) ground_ = world_->MakeGround();
  }
  terrain::Ground& Ground() override {
    RODEIRA_ASSERT(ground_ != nullptr);  // World() comes first and refuses
    return *ground_;
  }
  base::Result<launch::WorldSummary> World() override {
    if (world_ == nullptr) return base::WrongInput("the launch file has no node of kind 'road', or names no world", launch().path().string());
    return nodes::Summary(*world_);
  }

 private:
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<terrain::Ground> ground_;
};

// The world of the run, where a road server would load it.
base::Result<std::shared_ptr<const road::World>> LoadWorld(const launch::Launch& launch) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name == "road") return road::World::Load(launch.world());
  }
  return std::shared_ptr<const road::World>();
}

RunReport ReportOf(const lockstep::RunOutcome& outcome, const lockstep::Roster& roster, double wall_s) {
  RunReport report;
  report.ready = true;
  report.ended = true;
  report.ok = outcome.ok;
  report.step = outcome.last_step;
  report.wall_s = wall_s;
  report.slipped_s = static_cast<double>(outcome.slipped_ns) * 1e-9;
  report.digest = base::Hex(outcome.digest);
  if (!outcome.fault.empty()) report.faults.push_back(outcome.fault);
  for (const lockstep::Report& node : outcome.reports) {
    const double mean_us = node.steps == 0 ? 0.0 : static_cast<double>(node.busy_ns) * 1e-3 / static_cast<double>(node.steps);
    report.nodes.push_back({roster.node(node.node).name, node.steps, mean_us, static_cast<double>(node.worst_ns) * 1e-3, node.server_calls});
  }
  return report;
}

}  // namespace

int RunInProcess(const RunOptions& options, const launch::Launch& launch) {
  const auto& roster = launch.roster();
  const auto world = LoadWorld(launch);
  if (!world) {
    fmt::print(stderr, "rodeira: {}\n", world.error().Text());
    return world.error().exit_status();
  }
  std::vector<std::unique_ptr<LocalContext>> contexts;
  std::vector<std::unique_ptr<lockstep::Node>> owned;
  std::vector<lockstep::Node*> nodes;
  for (lockstep::NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    contexts.push_back(std::make_unique<LocalContext>(launch, n, world.value()));
    nodes.push_back(nullptr);
    if (roster.node(n).role == lockstep::Role::kService) continue;
    const launch::NodeFactory factory = FactoryOf(roster.node(n).kind);
    RODEIRA_ASSERT(factory != nullptr);
    auto node = factory(*contexts.back());
    if (!node) {
      fmt::print(stderr, "rodeira: node '{}': {}\n", roster.node(n).name, node.error().Text());
      return node.error().exit_status();
    }
    owned.push_back(std::move(node).value());
    nodes.back() = owned.back().get();
  }
  if (auto status = launch.file().Finish(); !status) {
    fmt::print(stderr, "rodeira: {}\n", status.error().Text());
    return status.error().exit_status();
  }
  lockstep::InProcessSettings settings;
  const auto seconds = options.duration_s ? options.duration_s : launch.duration_s();
  if (seconds) settings.last_step = static_cast<lockstep::Step>(std::llround(*seconds * 1e9 / static_cast<double>(roster.base_step_ns())));
  settings.pace = dds::ParsePace(options.pace).value();
  settings.stop_requested = [] { return g_interrupted.load(); };
  ::signal(SIGINT, OnInterrupt);
  ::signal(SIGTERM, OnInterrupt);
  const auto start = std::chrono::steady_clock::now();
  const lockstep::RunOutcome outcome = lockstep::RunThreaded(roster, nodes, settings);
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const RunReport report = ReportOf(outcome, roster, wall_s);
  if (!outcome.ok) fmt::print(stderr, "rodeira: {}\n", outcome.fault);
  if (!options.quiet) fmt::print("{}", report.Table(static_cast<double>(roster.base_step_ns()) * 1e-9, options.record));
  return outcome.ok ? 0 : 1;
}

}  // namespace rodeira::front
