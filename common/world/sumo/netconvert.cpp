// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/netconvert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <pugixml.hpp>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "common/core/base/run_program.hpp"

namespace rodeira::sumo {
namespace {

constexpr const char* kHome = "/usr/share/sumo";  // of Debian's packages
constexpr std::chrono::seconds kLimit{1800};

// How maps are read: roads for cars, one junction where several nodes are one, lights that stand before a junction as
// that junction's, turns that a car can drive. Where a road ends, vehicles enter and leave: they do not turn round.
constexpr std::pair<const char*, const char*> kOfMaps[] = {
    {"--keep-edges.by-vclass", "passenger"},
    {"--geometry.remove", "true"},
    {"--junctions.join", "true"},
    {"--default.junctions.radius", "6"},
    {"--roundabouts.guess", "true"},
    {"--ramps.guess", "true"},
    {"--tls.guess-signals", "true"},
    {"--tls.discard-simple", "true"},
    {"--tls.join", "true"},
    {"--no-turnarounds", "true"},
    {"--osm.lane-access", "true"},
    {"--osm.turn-lanes", "true"},
};

std::filesystem::path Home() {
  const char* home = std::getenv("SUMO_HOME");
  return home == nullptr || *home == '\0' ? kHome : home;
}

// Types of roads: OpenStreetMap's, with German defaults in towns.
base::Result<std::string> TypeFiles(const std::string& said) {
  std::string list;
  for (const char* name : {"osmNetconvert.typ.xml", "osmNetconvertUrbanDe.typ.xml"}) {
    const std::filesystem::path file = Home() / "data" / "typemap" / name;
    std::error_code problem;
    if (!std::filesystem::is_regular_file(file, problem))
      return base::WrongInput(
          "sumo.not_installed",
          fmt::format("netconvert's road types '{}' are missing; `apt install sumo-tools` installs them, another "
                      "folder of SUMO is named by SUMO_HOME",
                      file.string()),
          said);
    list += (list.empty() ? "" : ",") + file.string();
  }
  return list;
}

// The first error that netconvert names, without its "Error: ".
std::string FirstError(std::string_view text) {
  constexpr std::string_view kError = "Error: ";
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(kError)) return std::string(line.substr(kError.size()));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

// The class of vehicles of a newer SUMO that this netconvert does not know; empty where it complains of something else.
std::string UnknownClass(std::string_view error) {
  constexpr std::string_view kBefore = "Unknown vehicle class '", kAfter = "' encountered";
  const std::size_t begin = error.find(kBefore);
  if (begin == std::string_view::npos) return {};
  const std::size_t from = begin + kBefore.size(), end = error.find(kAfter, from);
  return end == std::string_view::npos ? std::string() : std::string(error.substr(from, end - from));
}

// A list of classes without one of them.
std::string Without(std::string_view list, const std::string& vehicle_class) {
  std::string kept;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    const std::string_view word = list.substr(0, end);
    if (!word.empty() && word != vehicle_class) kept += (kept.empty() ? "" : " ") + std::string(word);
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return kept;
}

// Takes a class out of all lists of a network. A lane for that class alone is then for none: all are denied.
bool ForgetClass(const std::filesystem::path& file, const std::string& vehicle_class) {
  pugi::xml_document document;
  if (!document.load_file(file.c_str())) return false;
  for (const pugi::xml_node& edge : document.child("net").children()) {
    for (pugi::xml_node lane : edge.children()) {
      for (const char* list : {"allow", "disallow"}) {
        pugi::xml_attribute attribute = lane.attribute(list);
        if (!attribute) continue;
        const std::string kept = Without(attribute.value(), vehicle_class);
        attribute = kept.c_str();
        if (!kept.empty()) continue;
        lane.remove_attribute(attribute);
        if (std::string_view(list) == "allow") lane.append_attribute("disallow") = "all";
      }
    }
    for (const char* list : {"allow", "disallow"}) {
      pugi::xml_node node = edge;
      if (pugi::xml_attribute attribute = node.attribute(list))
        attribute = Without(attribute.value(), vehicle_class).c_str();
    }
  }
  return document.save_file(file.c_str());
}

}  // namespace

base::Result<Converted> RunNetconvert(const std::filesystem::path& file, SourceKind kind,
                                      const std::filesystem::path& folder, const std::string& said,
                                      const std::function<bool()>& stop) {
  const auto program = base::FindInPath("netconvert");
  if (!program)
    return base::WrongInput("sumo.not_installed",
                            "SUMO's netconvert, which reads such files, is not in PATH; `apt install sumo` installs it",
                            said);
  const Converted converted{folder / "it.net.xml", folder / "it.xodr"};
  base::ProgramRun run;
  run.program = *program;
  run.environment = {{"SUMO_HOME", Home().string()}};
  run.limit = kLimit;
  run.stop = stop;
  if (kind == SourceKind::kOpenStreetMap) {
    const auto types = TypeFiles(said);
    if (!types) return types.error();
    run.arguments = {"--osm-files", file.string(), "--type-files", types.value()};
    for (const auto& [option, value] : kOfMaps) run.arguments.insert(run.arguments.end(), {option, value});
  } else {
    run.arguments = {"--sumo-net-file", file.string()};
  }
  for (const char* argument : {"--output.street-names", "true", "--xml-validation", "never", "--xml-validation.net",
                               "never", "--precision", "6"})
    run.arguments.emplace_back(argument);
  run.arguments.insert(run.arguments.end(),
                       {"--output-file", converted.net.string(), "--opendrive-output", converted.drive.string()});
  auto end = base::RunProgram(run);
  constexpr int kMaxClasses = 16;  // that are new in newer versions
  for (int known = 0; known < kMaxClasses && kind == SourceKind::kNet && end; ++known) {
    const std::string unknown = UnknownClass(FirstError(end.value().text));
    if (unknown.empty() || !ForgetClass(file, unknown)) break;
    end = base::RunProgram(run);
  }
  if (!end) return end.error();
  if (end.value().stopped) return base::Failed("run.interrupted", "interrupted; nothing is written", said);
  if (end.value().too_long)
    return base::Failed("sumo.netconvert_failed",
                        fmt::format("netconvert has not come to an end after {} min", kLimit.count() / 60), said);
  if (end.value().signal != 0)
    return base::Failed(
        "sumo.netconvert_failed",
        fmt::format("netconvert crashed (signal {}, {})", end.value().signal, ::strsignal(end.value().signal)), said);
  if (end.value().status != 0) {
    const std::string error = FirstError(end.value().text);
    return base::WrongInput(
        "sumo.netconvert_failed",
        "netconvert refuses it: " + (error.empty() ? fmt::format("exit status {}", end.value().status) : error), said);
  }
  std::error_code problem;
  if (!std::filesystem::exists(converted.net, problem) || !std::filesystem::exists(converted.drive, problem))
    return base::WrongInput("world.no_road", "netconvert finds no road in it", said);
  return converted;
}

}  // namespace rodeira::sumo
