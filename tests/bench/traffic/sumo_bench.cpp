// SPDX-License-Identifier: Apache-2.0
// What a step costs SUMO on the same streets: netconvert reads the OpenDRIVE that is written of the same map, and
// `sumo` drives as many vehicles over it, from random places and by random turns, in steps of the same 10 ms. Where
// SUMO is not installed the benchmark says so.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/bench/traffic/grid.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kWarm_s = 20.0, kMeasured_s = 30.0;
constexpr int kEdges = 60;  // of a route: more than is driven in that time

double ChildrensCpu_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Streets of a net file and what each leads to.
std::map<std::string, std::vector<std::string>> Streets(const std::string& net) {
  pugi::xml_document document;
  document.load_file(net.c_str());
  std::map<std::string, std::vector<std::string>> next;
  for (const pugi::xml_node edge : document.child("net").children("edge")) {
    if (!edge.attribute("function")) next[edge.attribute("id").value()];
  }
  for (const pugi::xml_node link : document.child("net").children("connection")) {
    const auto from = next.find(link.attribute("from").value());
    const std::string to = link.attribute("to").value();
    if (from != next.end() && next.contains(to)) from->second.push_back(to);
  }
  return next;
}

// Each vehicle begins on a random street and turns at random.
void WriteRoutes(const std::map<std::string, std::vector<std::string>>& next, std::int64_t vehicles,
                 const std::string& file) {
  std::vector<std::string> streets;
  for (const auto& [street, links] : next) {
    if (!links.empty()) streets.push_back(street);
  }
  const auto drawn = [](std::size_t of, std::uint64_t vehicle, std::uint64_t edge) {
    return static_cast<std::size_t>(base::RandomUniform({7, vehicle, edge}) * static_cast<double>(of));
  };
  std::ofstream out(file);
  out << "<routes>\n";
  for (std::uint64_t vehicle = 0; vehicle < static_cast<std::uint64_t>(vehicles); ++vehicle) {
    std::string at = streets[drawn(streets.size(), vehicle, 0)], route = at;
    for (std::uint64_t edge = 1; edge < kEdges && !next.at(at).empty(); ++edge) {
      at = next.at(at)[drawn(next.at(at).size(), vehicle, edge)];
      route += " " + at;
    }
    out << "  <vehicle id=\"" << vehicle << "\" depart=\"0\" departPos=\"random_free\"><route edges=\"" << route
        << "\"/></vehicle>\n";
  }
  out << "</routes>\n";
}

// Vehicles that drive in each step of a run from a time on, summed up, and how many steps those are.
struct Driven {
  double updates = 0.0, steps = 0.0;
};

// Nothing where the run failed.
std::optional<Driven> Drive(const std::string& folder, double until_s, double from_s) {
  const std::string summary = folder + "/summary.xml";
  const std::string command = "sumo -n " + folder + "/net.xml -r " + folder + "/routes.xml --step-length 0.01 --end " +
                              std::to_string(until_s) + " --seed 7 --no-step-log --no-warnings --summary-output " +
                              summary + " >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  pugi::xml_document document;
  if (!document.load_file(summary.c_str())) return std::nullopt;
  Driven driven;
  for (const pugi::xml_node step : document.child("summary").children("step")) {
    if (step.attribute("time").as_double() < from_s - 1e-6) continue;
    driven.updates += step.attribute("running").as_double();
    driven.steps += 1.0;
  }
  return driven;
}

// Arguments as of BM_PlanarStep. What the first seconds cost, with reading the net, is taken off by running them alone
// as well.
void BM_Sumo(benchmark::State& state) {
  if (std::system("command -v netconvert sumo >/dev/null") != 0)
    return state.SkipWithError("SUMO is not installed (package sumo)");
  ::setenv("SUMO_HOME", "/usr/share/sumo",
           0);  // where Debian puts the types without which netconvert reads no OpenDRIVE
  const auto map = traffic_map::LoadLaneMap(Grid(state.range(0)));
  if (!map) return state.SkipWithError(kNoGrids);
  const auto drawn = traffic_map::ToOpenDrive(map.value(), "grid");
  const auto scratch = base::TemporaryFolder::Make("sumo");
  if (!drawn || !scratch) return state.SkipWithError("no OpenDRIVE of the grid could be written");
  const std::string folder = scratch.value().path().string();
  std::ofstream(folder + "/grid.xodr") << drawn.value().xml;
  const std::string convert =
      "netconvert --opendrive-files " + folder + "/grid.xodr -o " + folder + "/net.xml >/dev/null 2>&1";
  if (std::system(convert.c_str()) != 0) return state.SkipWithError("netconvert refused the grid's OpenDRIVE");
  WriteRoutes(Streets(folder + "/net.xml"), state.range(1), folder + "/routes.xml");
  for (auto _ : state) {
    const double before = ChildrensCpu_s();
    if (!Drive(folder, kWarm_s, 0.0)) return state.SkipWithError("sumo failed");
    const double warm = ChildrensCpu_s();
    const auto driven = Drive(folder, kWarm_s + kMeasured_s, kWarm_s);
    if (!driven || driven->steps <= 0.0) return state.SkipWithError("sumo failed");
    const double first = warm - before, cost = ChildrensCpu_s() - warm - first;
    // A difference of two runs that is small beside them is their spread.
    if (cost < 0.5 * first) return state.SkipWithError("the seconds measured cost less than half of those before them");
    state.counters["updates_a_cpu_second"] = driven->updates / cost;
    state.counters["on_road"] = driven->updates / driven->steps;
  }
}
BENCHMARK(BM_Sumo)->Args({4, 100})->Args({10, 1000})->Args({32, 10000})->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace rodeira::traffic
