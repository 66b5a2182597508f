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
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

base::Status MakeSureItIsDead(Child& child) {
  child.Signal(SIGKILL);
  for (int i = 0; i < 20'000 && !child.ended(); ++i) {
    child.Poll();
    if (!child.ended()) ::usleep(1000);
  }
  return child.ended() ? base::Status()
                       : base::Failed("system.cannot_end_process",
                                      fmt::format("process {} of '{}' cannot be ended", child.pid(), child.name()));
}

}  // namespace

NodeProcesses::NodeProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
                             launch::Overrides overrides)
    : options_(options),
      placement_(placement),
      launch_(launch),
      overrides_(std::move(overrides)),
      domain_(options.domain.value()) {}

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
    log = std::make_unique<PartLog>(plain(name), base::UserDataFolder() / "logs" / plain(launch_.name()));
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
  for (const launch::LaunchNode& node : launch_.nodes()) {
    if (!placement_.Has(node)) continue;
    std::vector<std::string> command = Command(std::string(node.kind->program));
    command.insert(command.end(), {"--node", node.name});
    auto started = Child::Start(node.name, command, false, MakeLog(node.name));
    if (!started) return started.error();
    children_.push_back(std::move(started).value());
  }
  return {};
}

base::Result<bool> NodeProcesses::RestartNode(const std::string& name, std::uint32_t incarnation) {
  const auto child =
      std::find_if(children_.begin() + 1, children_.end(), [&](const Child& one) { return one.name() == name; });
  if (child == children_.end()) return false;
  if (auto status = MakeSureItIsDead(*child); !status) return status.error();
  std::vector<std::string> command = Command(std::string(launch_.node(launch_.roster().Find(name)).kind->program));
  command.insert(command.end(), {"--node", name, "--incarnation", std::to_string(incarnation)});
  auto started = Child::Start(name, command, false, MakeLog(name));
  if (!started) return started.error();
  *child = std::move(started).value();
  incarnations_[name] = incarnation;
  return true;
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
