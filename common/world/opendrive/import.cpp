// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/import.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/file_text.hpp"
#include "common/world/opendrive/read.hpp"
#include "common/world/opendrive/repair.hpp"
#include "common/world/opendrive/rule_ids.hpp"

namespace rodeira::opendrive {
namespace {

void ReadHeader(const Node& root, Import& import, network::NetworkSpec& spec) {
  const Node header = root.Child("header");
  if (!header) {
    root.Wrong("core.header", "<OpenDRIVE> has no <header>",
               {RepairKind::kVersionAssumed, "it is read as OpenDRIVE 1.8"});
    return;
  }
  const int major = header.Integer("revMajor"), minor = header.Integer("revMinor");
  import.version = fmt::format("{}.{}", major, minor);
  if (major != 1 || minor < 1)
    header.Wrong("core.version", fmt::format("this is OpenDRIVE {}; 1.4 to 1.8 was expected", import.version),
                 {RepairKind::kVersionAssumed, "it is read as if it were 1.8"});
  if (major == 1 && (minor < 4 || minor > 8)) {
    import.warnings.push_back({"core.version",
                               fmt::format("this is OpenDRIVE {}; it is read as if it were 1.4 to 1.8", import.version),
                               header.line(),
                               "",
                               {},
                               {}});
  }
  spec.name = header.Text("name", "");
  spec.geo_reference = header.Child("geoReference").xml().text().get();
  const std::size_t first = spec.geo_reference.find_first_not_of(" \t\r\n");
  spec.geo_reference =
      first == std::string::npos
          ? ""
          : spec.geo_reference.substr(first, spec.geo_reference.find_last_not_of(" \t\r\n") - first + 1);
  const Node offset = header.Child("offset");
  spec.geo_offset = {offset.Number("x", 0.0), offset.Number("y", 0.0), offset.Number("hdg", 0.0)};
}

void Finish(Import& import) {
  for (auto* list : {&import.errors, &import.warnings}) {
    std::stable_sort(list->begin(), list->end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  }
}

// Whether a reading ends with these errors: without repair with any, otherwise with those that change the text, or that
// nothing is done about.
bool MustStop(const std::vector<Finding>& errors, const Tolerance& tolerance) {
  if (!tolerance.repair) return !errors.empty();
  return std::any_of(errors.begin(), errors.end(),
                     [](const Finding& error) { return error.repair.done.empty() || !error.repair.edits.empty(); });
}

// What is done about an error that nothing else is done about.
Repair LeaveOut(const Finding& error, const Node& root) {
  for (const Node& road : root.Children("road")) {
    if (!error.road.empty() && road.Text("id", "") == error.road)
      return {RepairKind::kRoadLeftOut, kLeftOut, {road.Remove()}};
  }
  return {};
}

// For networks of other kinds that are called .xml, too.
std::string_view HowToImport(std::string_view root) {
  if (root == "net" || root == "osm") return ": `rodeira world import` makes a world of it";
  return "";
}

constexpr std::size_t kMaxRepairs = 100000;  // in one reading

}  // namespace

base::Result<Import> ReadOnce(const std::string& text, const std::filesystem::path& path, const Tolerance& tolerance,
                              const Edited* edited) {
  Import import;
  import.content_hash = base::Hash(text);
  auto parsed = Source::Parse(text, path, edited);
  if (!parsed) return parsed.error();
  Source& source = *parsed.value();
  if (tolerance.repair) source.most_findings = kMaxRepairs;
  const Node root = source.root();
  if (root.name() != "OpenDRIVE") {
    return base::WrongInput(
        "opendrive.not_opendrive",
        fmt::format("the outermost element is <{}>; <OpenDRIVE> was expected{}", root.name(), HowToImport(root.name())),
        fmt::format("{}:{}", path.string(), root.line()));
  }
  source.PassOverTemporaryLanes();
  network::NetworkSpec spec;
  ReadHeader(root, import, spec);
  std::vector<RoadReading> readings;
  for (const Node& road : root.Children("road")) readings.push_back(ReadRoad(road));
  std::vector<JunctionReading> junctions;
  for (const Node& junction : root.Children("junction")) junctions.push_back(ReadJunction(junction));
  for (const Node& controller : root.Children("controller")) spec.controllers.push_back(ReadController(controller));
  TellIncludes(root);
  TellUnread(root);
  TellUnknown(root);
  CheckStations(root);
  CheckMeasures(root);
  if (readings.empty()) root.Wrong("core.roads", "there is no <road> in the file");
  import.errors = source.errors;
  import.surface_files = edited == nullptr ? nullptr : edited->surface_files;
  import.warnings.insert(import.warnings.end(), source.warnings.begin(), source.warnings.end());
  Finish(import);
  if (MustStop(import.errors, tolerance)) return import;

  Findings findings;
  findings.errors = std::move(import.errors);
  findings.source = &source;
  import.errors.clear();
  const auto stop = [&](bool always = false) {
    for (Finding& error : findings.errors) {
      if (error.repair.done.empty()) error.repair = LeaveOut(error, root);
    }
    if (!always && !MustStop(findings.errors, tolerance)) return false;
    import.errors = std::move(findings.errors);
    import.warnings.insert(import.warnings.end(), findings.warnings.begin(), findings.warnings.end());
    if (!tolerance.repair && !import.errors.empty()) import.network = nullptr;
    Finish(import);
    return true;
  };
  const auto on_foot = PathsOnFoot(readings, junctions);
  CutAtMiddles(readings, on_foot, findings);
  TurnLights(spec.controllers, readings, findings);
  RaiseLights(readings, findings);
  for (const RoadReading& road : readings) {
    CheckPlan(road, tolerance, findings);
    CheckBorders(road, tolerance, findings);
    CheckJumps(road, tolerance, findings);
  }
  if (tolerance.repair && stop()) return import;
  std::vector<RoadLines> lines;
  for (RoadReading& road : readings) {
    auto axis = geometry::PlanAxis::Make(std::move(road.elements));
    spec.roads.emplace_back(std::move(road.spec), std::move(*axis));
    lines.push_back(std::move(road.lines));
  }
  for (const JunctionReading& junction : junctions) spec.junctions.push_back(junction.junction);
  LayJunctionGrounds(junctions, tolerance, spec, findings);
  LayJunctionObjects(junctions, on_foot, spec, lines, findings);
  TakeTurns(spec, findings);
  import.network = std::make_shared<const network::Network>(std::move(spec));
  if (tolerance.repair) import.before = ReachOf(*import.network);
  CheckRoadLinks(*import.network, lines, tolerance, findings);
  if (tolerance.repair && stop()) return import;
  CheckLaneLinks(*import.network, lines, tolerance, findings);
  CheckSurfaces(*import.network, lines, tolerance, findings);
  TellCurvatureJumps(*import.network, lines, findings);
  TellSignLimits(*import.network, lines, findings);
  stop(true);
  return import;
}

namespace {

base::Result<Import> ReadFile(FileText file, const std::filesystem::path& path, const Tolerance& tolerance) {
  if (tolerance.repair) return ReadRepaired(std::move(file), path, tolerance);
  auto import = ReadOnce(file.text, path, tolerance, &file.edited);
  if (import) {
    for (auto* list : {&import.value().errors, &import.value().warnings}) {
      for (Finding& finding : *list) finding.repair = {};
    }
  }
  return import;
}

}  // namespace

base::Result<Import> Read(std::string text, const std::filesystem::path& path, const Tolerance& tolerance) {
  FileText file{std::move(text), {}};
  file.edited.line_starts = LineStarts(file.text);
  return ReadFile(std::move(file), path, tolerance);
}

base::Result<Import> Load(const std::filesystem::path& path, const Tolerance& tolerance) {
  auto file = ReadFileText(path);
  if (!file) return file.error();
  return ReadFile(std::move(file).value(), path, tolerance);
}

base::Result<std::string> LoadText(const std::filesystem::path& path) {
  auto file = ReadFileText(path);
  if (!file) return file.error();
  return std::move(file).value().text;
}

base::Error ToError(const Finding& finding, const std::filesystem::path& path) {
  const base::ErrorId id = IdOfRule(finding.rule);
  return base::WrongInput(id, finding.Text(),
                          finding.line == 0 ? path.string() : fmt::format("{}:{}", path.string(), finding.line));
}

base::Result<std::shared_ptr<const network::Network>> LoadNetwork(const std::filesystem::path& path,
                                                                  const Tolerance& tolerance) {
  auto import = Load(path, tolerance);
  if (!import) return import.error();
  if (!import.value().errors.empty()) return ToError(import.value().errors.front(), path);
  return import.value().network;
}

std::string Describe(const Import& import) {
  if (import.network == nullptr) return "";
  const network::Network& network = *import.network;
  double length = 0.0, connecting = 0.0, lane_length = 0.0;
  std::size_t sections = 0, lanes = 0, drivable = 0, signals = 0, objects = 0;
  for (const network::Road& road : network.roads()) {
    length += road.length_m();
    if (!road.spec().junction.empty()) connecting += road.length_m();
    sections += road.spec().sections.size();
    signals += road.spec().signals.size();
    objects += road.spec().objects.size();
  }
  for (const network::LaneKey& key : network.Lanes()) {
    const network::LaneSection& section = network.Section(key);
    ++lanes;
    if (!network::IsDrivable(network.Find(key)->type)) continue;
    ++drivable;
    lane_length += section.end_s_m - section.s_m;
  }
  std::string text = fmt::format("OpenDRIVE: {}\n", import.version);
  text +=
      fmt::format("roads: {}, {:.3f} m, of which {:.3f} m in junctions\n", network.roads().size(), length, connecting);
  text +=
      fmt::format("lanes: {} in {} sections, of which {} drivable, {:.3f} m\n", lanes, sections, drivable, lane_length);
  text += fmt::format("junctions: {}\nsignals: {}\nobjects: {}\n", network.junctions().size(), signals, objects);
  const Reach reach = ReachOf(network);
  text += fmt::format(
      "driving lanes that are reached and lead on: {:.1f} % of {:.3f} m as drawn, {:.1f} % of {:.3f} m as read\n",
      100.0 * import.before.value_or(reach).share(), import.before.value_or(reach).lanes_m, 100.0 * reach.share(),
      reach.lanes_m);
  if (!network.geo_reference().empty()) text += fmt::format("geoReference: {}\n", network.geo_reference());
  return text + fmt::format("warnings: {}\n", import.warnings.size());
}

}  // namespace rodeira::opendrive
