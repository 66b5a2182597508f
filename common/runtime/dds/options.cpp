// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "common/runtime/launch/pace.hpp"
#include "common/runtime/launch/segments.hpp"

namespace rodeira::dds {
namespace {

// A duration in seconds, over 0.
const CLI::Validator Positive(
    [](std::string& text) {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return end != text.c_str() && *end == '\0' && value > 0.0 && std::isfinite(value)
                 ? std::string()
                 : "'" + text + "' was found; a positive number of seconds was expected";
    },
    "SECONDS");

}  // namespace

ParsedOptions ParseOptions(const std::string& program, ProgramOf of, int argc, char** argv) {
  ParsedOptions parsed;
  ProcessOptions& options = parsed.options;
  CLI::App app{"One process of a Rodeira run; `rodeira run` starts all of them."};
  app.name(program);
  std::vector<std::string> sets, incarnations;
  std::string pace = "max";
  double duration_s = 0.0;
  app.add_option("--launch", options.launch_file, "launch file (the same for every process)")->required();
  app.add_option("--run", options.run, "name of the run: only processes of the same name meet");
  app.add_option("--domain", options.domain, "DDS domain, 0 to 232")->check(CLI::Range(0, 232));
  app.add_option("--set", sets, "KEY=VALUE: replaces a value of the launch file");
  if (of == ProgramOf::kClock) {
    app.add_option("--pace", pace, "max, real or a factor");
    app.add_option("--for", duration_s, "simulated seconds")->check(Positive);
    app.add_flag("--listen", options.listen, "take lines 'lost NODE TEXT' and 'do NUMBER COMMAND' from standard input");
    app.add_option("--incarnation", options.incarnation, "which incarnation of the clock");
    app.add_option("--clock-id", options.clock_id,
                   "number of the run's clock; another incarnation has that of the first");
    app.add_option("--begun-ns", options.begun_ns, "another incarnation: when the run began, on the monotonic clock");
    app.add_flag("--paused", options.paused, "another incarnation: begin paused");
    app.add_option("--follow", options.follow,
                   "name of this host: grant nothing, say what the run's clock on another host says");
  } else if (of == ProgramOf::kNodes) {
    app.add_option("--process", options.process, "name of the process in the launch file")->required();
    app.add_option("--incarnation", incarnations, "NODE=NUMBER: which incarnation of a node");
  } else {
    app.add_option("--node", options.node, "name of the node in the launch file")->required();
    app.add_option("--incarnation", options.incarnation, "which incarnation of the node");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    parsed.leave_with = app.exit(problem) == 0 ? 0 : 2;
    return parsed;
  }
  for (const std::string& set : sets) {
    const auto equals = set.find('=');
    if (equals == std::string::npos || equals == 0) {
      std::cerr << program << ": --set " << set << ": KEY=VALUE was expected\n";
      parsed.leave_with = 2;
      return parsed;
    }
    options.overrides.emplace_back(set.substr(0, equals), set.substr(equals + 1));
  }
  for (const std::string& text : incarnations) {
    const auto equals = text.find('=');
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    if (equals == std::string::npos || std::from_chars(text.data() + equals + 1, end, number).ptr != end ||
        equals + 1 == text.size()) {
      std::cerr << program << ": --incarnation " << text << ": NODE=NUMBER was expected\n";
      parsed.leave_with = 2;
      return parsed;
    }
    options.incarnations[text.substr(0, equals)] = number;
  }
  const auto factor = launch::ParsePace(pace);
  if (!factor) {
    std::cerr << program << ": " << factor.error().Text() << "\n";
    parsed.leave_with = 2;
    return parsed;
  }
  options.pace = factor.value();
  if (duration_s > 0.0) options.duration_s = duration_s;
  return parsed;
}

DomainSettings DomainOf(const ProcessOptions& options, const launch::Launch& launch, const std::string& name,
                        std::span<const lockstep::NodeIndex> nodes) {
  return {options.domain,
          options.run,
          name,
          launch.transport(),
          launch.discovery(),
          false,
          launch.keeps_for_restarts(),
          options.incarnation > 0 || !options.incarnations.empty(),
          launch.transport_settings().has_observers,
          launch::SegmentKibOf(launch, nodes),
          launch.transport_settings().segment_kib,
          launch.topics()};
}

}  // namespace rodeira::dds
