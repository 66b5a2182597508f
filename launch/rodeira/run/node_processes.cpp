// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/node_processes.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "common/core/base/installation.hpp"
#include "common/core/base/user_folders.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

// No code of it runs any more. One that was killed has two seconds to end as well; what it still holds then, memory and
// open files, is let go when its last thread gets a processor (KilledBy).
base::Status MakeSureItIsDead(Child& child) {
  child.Signal(SIGKILL);
  for (int i = 0; i < 20'000 && !child.ended() && !(i >= 2'000 && child.killed()); ++i) {
    child.Poll();
    if (!child.ended()) ::usleep(1000);
  }
  return child.ended() || child.killed()
             ? base::Status()
             : base::Failed("system.cannot_end_process",
                            fmt::format("process {} of '{}' cannot be ended", child.pid(), child.name()));
}

}  // namespace

std::string ProgramOf(const launch::Launch& launch, const launch::NodeProcess& process) {
  if (!process.is_shared()) return launch.node(process.nodes.front()).kind->program;
  const bool draws = std::ranges::any_of(process.nodes, [&](lockstep::NodeIndex n) {
    return launch.node(n).kind->name == "view" || ReadsDevice(launch.node(n));
  });
  return draws ? "rodeira-nodes-graphics" : "rodeira-nodes";
}

NodeProcesses::NodeProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
                             launch::Overrides overrides)
    : options_(options),
      placement_(placement),
      launch_(launch),
      overrides_(std::move(overrides)),
      domain_(options.domain.value()) {
  for (launch::NodeProcess& process : launch::ProcessesOf(launch)) {
    const launch::LaunchNode& first = launch.node(process.nodes.front());
    if (!placement.Has(first)) continue;
    const std::string child = process.is_shared() ? "process " + process.name : first.name;
    parts_.push_back({child, std::move(process)});
  }
}

std::vector<std::string> NodeProcesses::Command(const std::string& program) const {
  std::vector<std::string> command{base::FindProgram(program).string(),
                                   "--launch",
                                   launch_.path().string(),
                                   "--run",
                                   options_.run,
                                   "--domain",
                                   std::to_string(domain_)};
  for (const auto& [key, value] : overrides_) {
    command.push_back("--set");
    command.push_back(key + "=" + value);
  }
  return command;
}

std::vector<std::string> NodeProcesses::ClockCommand(const std::string& pace) const {
  std::vector<std::string> command = Command("rodeira-clock");
  if (!placement_.has_clock()) {
    command.insert(command.end(), {"--follow", placement_.host()});
    return command;
  }
  command.insert(command.end(), {"--listen", "--pace", pace});
  if (options_.duration_s) command.insert(command.end(), {"--for", fmt::format("{}", *options_.duration_s)});
  return command;
}

// Logs lie in logs/LAUNCH among the user's recordings.
PartLog* NodeProcesses::MakeLog(const std::string& name) {
  auto& log = logs_[name];
  if (!log) {
    const auto plain = [](std::string text) {
      std::ranges::replace(text, '/', '_');
      return text;
    };
    log = std::make_unique<PartLog>(plain(name), base::UserDataFolder() / "logs" / plain(launch_.name()),
                                    exhaustion_told_);
  }
  return log.get();
}

const PartLog* NodeProcesses::LogOf(const std::string& name) const {
  const auto found = logs_.find(name);
  return found == logs_.end() ? nullptr : found->second.get();
}

base::Status NodeProcesses::StartClock() {
  const std::string name = placement_.has_clock() ? "clock" : "follower of the clock";
  auto child = Child::Start(name, ClockCommand(options_.pace), true, MakeLog(name));
  if (!child) return child.error();
  children_.push_back(std::move(child).value());
  return {};
}

base::Status NodeProcesses::RestartClock(const ClocksPlace& place) {
  if (auto status = MakeSureItIsDead(clock()); !status) return status;
  const std::string pace = place.begun_ns < 0 ? options_.pace
                           : place.pace > 0.0 ? fmt::format("{}", place.pace)
                                              : "max";
  std::vector<std::string> command = ClockCommand(pace);
  command.insert(command.end(), {"--incarnation", std::to_string(++clocks_life_), "--clock-id",
                                 std::to_string(place.id), "--begun-ns", std::to_string(place.begun_ns)});
  if (place.paused) command.emplace_back("--paused");
  auto child = Child::Start("clock", command, true, MakeLog("clock"));
  if (!child) return child.error();
  clock() = std::move(child).value();
  return {};
}

base::Status NodeProcesses::StartNodes() {
  has_nodes_ = true;
  for (const Part& part : parts_) {
    auto status = Start(part, nullptr);
    if (status.ok()) continue;
    *exhaustion_told_ = true;  // a process or pipe could not be had: what else ends for it says the same
    return status;
  }
  return {};
}

const NodeProcesses::Part* NodeProcesses::PartOf(std::string_view child) const {
  const auto part = std::ranges::find(parts_, child, &Part::child);
  return part == parts_.end() ? nullptr : &*part;
}

std::vector<std::string> NodeProcesses::CommandOf(const Part& part) const {
  std::vector<std::string> command = Command(ProgramOf(launch_, part.process));
  const std::string& first = launch_.node(part.process.nodes.front()).name;
  if (!part.process.is_shared()) {
    command.insert(command.end(), {"--node", first});
    if (const auto number = incarnation(first); number > 0)
      command.insert(command.end(), {"--incarnation", std::to_string(number)});
    return command;
  }
  command.insert(command.end(), {"--process", part.process.name});
  for (const lockstep::NodeIndex n : part.process.nodes) {
    const std::string& name = launch_.node(n).name;
    if (const auto number = incarnation(name); number > 0)
      command.insert(command.end(), {"--incarnation", fmt::format("{}={}", name, number)});
  }
  return command;
}

base::Status NodeProcesses::Start(const Part& part, Child* place) {
  auto started = Child::Start(part.child, CommandOf(part), false, MakeLog(part.child));
  if (!started) return started.error();
  if (place == nullptr)
    children_.push_back(std::move(started).value());
  else
    *place = std::move(started).value();
  return {};
}

base::Result<NodeProcesses::Restarted> NodeProcesses::RestartNode(const std::string& name, std::uint32_t incarnation) {
  const lockstep::NodeIndex node = launch_.roster().Find(name);
  const auto part = std::ranges::find_if(
      parts_, [&](const Part& one) { return std::ranges::find(one.process.nodes, node) != one.process.nodes.end(); });
  if (part == parts_.end()) return Restarted::kElsewhere;
  wanted_[name] = incarnation;
  for (const lockstep::NodeIndex n : part->process.nodes) {
    const std::string& other = launch_.node(n).name;
    if (const auto wanted = wanted_.find(other); wanted == wanted_.end() || wanted->second <= this->incarnation(other))
      return Restarted::kAwaitsOthers;
  }
  const auto child = std::ranges::find_if(children_, [&](const Child& one) { return one.name() == part->child; });
  if (child == children_.end()) return Restarted::kElsewhere;
  if (auto status = MakeSureItIsDead(*child); !status) return status.error();
  for (const lockstep::NodeIndex n : part->process.nodes)
    incarnations_[launch_.node(n).name] = wanted_[launch_.node(n).name];
  if (auto status = Start(*part, &*child); !status) return status.error();
  return Restarted::kDone;
}

std::vector<std::string> NodeProcesses::NodesOf(const Child& child) const {
  const Part* part = PartOf(child.name());
  if (part == nullptr) return {};
  std::vector<std::string> names;
  for (const lockstep::NodeIndex n : part->process.nodes) names.push_back(launch_.node(n).name);
  std::ranges::stable_partition(names, [&](const std::string& name) { return name == child.crash_node(); });
  return names;
}

std::string NodeProcesses::FateOf(const Child& child) const {
  const Part* part = PartOf(child.name());
  if (part == nullptr || !part->process.is_shared()) return child.Fate();
  return fmt::format("of process '{}' {}", part->process.name, child.Fate());
}

std::uint32_t NodeProcesses::incarnation(const std::string& name) const {
  const auto found = incarnations_.find(name);
  return found == incarnations_.end() ? 0 : found->second;
}

void NodeProcesses::Poll() {
  for (Child& child : children_) child.Poll();
}

void NodeProcesses::EndAll(bool orderly, std::optional<WallClock::time_point> interrupted_at) {
  for (Child& child : children_) {
    child.Poll();
    if (!orderly) child.Signal(SIGTERM);
    if (child.stopped() || (!orderly && &child == &children_.front())) child.Signal(SIGKILL);
  }
  auto until = WallClock::now() + 1500ms;
  if (interrupted_at) until = std::min(until, *interrupted_at + 1700ms);
  while (WallClock::now() < until &&
         std::any_of(children_.begin(), children_.end(), [](const Child& child) { return !child.ended(); })) {
    std::this_thread::sleep_for(5ms);
    for (Child& child : children_) child.Poll();
  }
  for (Child& child : children_) child.Signal(SIGKILL);
  for (int i = 0; i < 200; ++i) {
    bool all = true;
    for (Child& child : children_) {
      child.Poll();
      all = all && child.ended();
    }
    if (all) return;
    std::this_thread::sleep_for(5ms);
  }
}

}  // namespace rodeira::cli
