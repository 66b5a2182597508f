// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::dds {

// The command line of every process of a run; `rodeira run` writes it, a person may.
struct ProcessOptions {
  std::string launch_file;
  std::string node;  // name in the roster; empty for the clock
  std::string run = "default";
  std::uint32_t domain = 0;
  std::uint32_t incarnation = 0;
  launch::Overrides overrides;
  // For a process of several nodes alone.
  std::string process;                                // its name in the launch file
  std::map<std::string, std::uint32_t> incarnations;  // of its nodes that were started again
  // For the clock alone.
  double pace = 0.0;  // 0: as fast as possible
  std::optional<double> duration_s;
  bool listen = false;         // take lines from standard input: a parent saw a process die, an operator asks
  std::uint64_t clock_id = 0;  // 0: random; another incarnation of a clock keeps that of the first
  std::int64_t begun_ns =
      -1;               // another incarnation: when the run began, as std::chrono::steady_clock counts; -1: it has not
  bool paused = false;  // another incarnation: begin paused
  std::string follow;   // name of this host: grant nothing, say what the run's clock elsewhere says
};

// The options, or the status to leave with (0 after --help, 2 after a wrong option); what a person should read has been
// printed then.
struct ParsedOptions {
  ProcessOptions options;
  std::optional<int> leave_with;
};
enum class ProgramOf { kClock, kNode, kNodes };
// `program`: its name in help and errors; `of`: which options it has.
ParsedOptions ParseOptions(const std::string& program, ProgramOf of, int argc, char** argv);

// In place of the clock where options.follow is set (run_follower.cpp); the exit status comes back.
int FollowClock(const launch::Launch& launch, const ProcessOptions& options);

// Of the process of these nodes; without nodes: of the clock or a follower. `name`: of the participant, for people.
DomainSettings DomainOf(const ProcessOptions& options, const launch::Launch& launch, const std::string& name,
                        std::span<const lockstep::NodeIndex> nodes = {});

}  // namespace rodeira::dds
