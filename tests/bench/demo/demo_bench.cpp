// SPDX-License-Identifier: Apache-2.0
// What the demo costs: how many times faster than real time, recorded and not, in turns in one run, and how large an
// hour's file would be. demo_bench [SECONDS] [ROUNDS]
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/system/command.hpp"

namespace {

using rodeira::system_test::Bin;
using rodeira::system_test::LaunchFile;

// Of a run, from its closing table: real-time factor, or nothing where the run failed.
double RealTimeFactor(const std::vector<std::string>& recording, const std::string& seconds,
                      const std::filesystem::path& folder) {
  std::vector<std::string> command{Bin("rodeira"),
                                   "run",
                                   LaunchFile("demo.yaml"),
                                   "--headless",
                                   "--for",
                                   seconds,
                                   "--pace",
                                   "max",
                                   "--set",
                                   "nodes.view.config.frames.folder=" + (folder / "frames").string()};
  command.insert(command.end(), recording.begin(), recording.end());
  const auto ended = rodeira::system_test::RunCommand(command);
  const auto line = ended.out.find("simulated ");
  const auto factor = ended.out.find('(', line);
  if (ended.status != 0 || line == std::string::npos || factor == std::string::npos) {
    fmt::print(stderr, "the demo failed:\n{}", ended.out);
    std::exit(1);
  }
  return std::strtod(ended.out.c_str() + factor + 1, nullptr);
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const std::string seconds = argc > 1 ? argv[1] : "60";
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-demo-bench-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto file = folder / "demo.mcap";
  std::vector<double> recorded, alone;
  double gigabytes_an_hour = 0.0;
  for (int round = 0; round < rounds; ++round) {
    std::filesystem::remove(file);
    recorded.push_back(RealTimeFactor({"--record", file.string()}, seconds, folder));
    gigabytes_an_hour =
        static_cast<double>(std::filesystem::file_size(file)) * 1e-9 * 3600.0 / std::strtod(seconds.c_str(), nullptr);
    alone.push_back(RealTimeFactor({"--no-record"}, seconds, folder));
    fmt::print("round {}: recorded {:.1f} x real time, not recorded {:.1f} x\n", round + 1, recorded.back(),
               alone.back());
    std::fflush(stdout);
  }
  std::filesystem::remove_all(folder);
  fmt::print("median: recorded {:.1f} x real time; wall time with the recorder {:.2f} x without; {:.2f} GB an hour\n",
             Median(recorded), Median(alone) / Median(recorded), gigabytes_an_hour);
}
