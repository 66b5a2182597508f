// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/map_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/core/base/json_text.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/printable.hpp"
#include "common/traffic/signals/map_lights.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "common/world/traffic_map/map_plot.hpp"
#include "common/world/traffic_map/map_report.hpp"
#include "common/world/traffic_map/world_files.hpp"

namespace rodeira::cli {
namespace {

// What only a network of the map shows: a shape that no road can have, lights that are green together where ways cross.
std::optional<traffic_map::Finding> CheckDriven(const traffic_map::MapFile& file, const traffic_map::Heights& companion,
                                                const std::string& path) {
  const auto wrong = [](const base::Error& error) {
    return traffic_map::Finding{
        traffic_map::Severity::kError, traffic_map::Element::kMap, 0, 0, 0, error.id, error.message};
  };
  const auto made = traffic_map::MakeLaneMap(file, companion, path);
  if (!made) return wrong(made.error());
  const auto network = traffic_map::ToNetwork(made.value(), path);
  if (!network) return wrong(network.error());
  return traffic::LightsTogether(made.value(), companion, *network.value());
}

// As an error, but "warning:" in front of the sentence, and the status 0 in JSON.
void PrintWarning(const traffic_map::Finding& finding, const std::string& path) {
  const std::string place = base::Printable(finding.Place(path)), text = finding.Text();
  if (base::ErrorsAreJson())
    fmt::print(stderr,
               R"({{"id":{},"message":{},"context":{},"status":0}})"
               "\n",
               base::JsonText(finding.id.text()), base::JsonText(text), base::JsonText(place));
  else
    fmt::print(stderr, "rodeira: {}: warning: {}\n", place, text);
}

int CheckMapFile(const std::string& path) {
  const auto file = traffic_map::LoadMap(path);
  if (!file) return base::PrintError("rodeira", file.error());
  const auto heights = traffic_map::LoadHeightsOf(path);
  if (!heights) return base::PrintError("rodeira", heights.error());
  auto findings = traffic_map::CheckMap(file.value(), heights.value());
  const bool whole = std::none_of(findings.begin(), findings.end(), [](const traffic_map::Finding& finding) {
    return finding.severity == traffic_map::Severity::kError;
  });
  if (auto driven = whole ? CheckDriven(file.value(), heights.value(), path) : std::nullopt)
    findings.push_back(std::move(*driven));
  int status = 0;
  for (const traffic_map::Finding& finding : findings) {
    if (finding.severity == traffic_map::Severity::kError)
      status = base::PrintError("rodeira", base::WrongInput(finding.id, finding.Text(), finding.Place(path)));
    else
      PrintWarning(finding, path);
  }
  fmt::print("{}", traffic_map::DescribeMap(file.value(), heights.value(), findings));
  return status;
}

int Convert(const MapOptions& options) {
  const std::filesystem::path out = options.out, from = options.file;
  const std::string kind = out.extension();
  if (kind != ".svg" && kind != ".xodr" && kind != ".yaml") {
    return base::PrintError(
        "rodeira",
        base::WrongInput(
            "command.wrong_value",
            fmt::format("the file's name ends with '{}'; .svg, .xodr or, for a world, .yaml was expected", kind),
            options.out));
  }
  const auto made = traffic_map::LoadLaneMap(options.file);
  if (!made) return base::PrintError("rodeira", made.error());
  if (kind == ".svg") {
    if (auto status = base::WriteWhole(out, traffic_map::PlotMap(made.value())); !status)
      return base::PrintError("rodeira", status.error());
    fmt::print("wrote {}\n", options.out);
    return 0;
  }
  const auto written = traffic_map::WriteWorld(made.value(), out, "made of " + from.filename().string());
  if (!written)
    return base::PrintError(
        "rodeira", written.error().context.empty() ? written.error().WithContext(options.file) : written.error());
  const auto companion = traffic_map::LoadHeightsOf(options.file);
  if (companion && !companion.value().flows.empty()) {
    fmt::print(stderr,
               "rodeira: warning: the flows beside {} are not in it: a world has none; a file of traffic settings "
               "takes them (`flows`)\n",
               from.filename().string());
  }
  if (!traffic_map::BeginsAndEndsAtItsEdge(made.value())) {
    fmt::print(stderr,
               "rodeira: warning: vehicles begin or end elsewhere than at the edge of {}; OpenDRIVE has no word for "
               "that: it stands in userData, which other programs pass over\n",
               from.filename().string());
  }
  const traffic_map::OpenDrive& drive = written.value();
  fmt::print(
      "wrote {}{}: {} roads in {} pieces, {} junctions; off by at most {:.2f} mm (middle), {:.2f} mm (borders), {:.2f} "
      "mm (height)\n",
      options.out, kind == ".yaml" ? " and " + std::filesystem::path(out).replace_extension(".xodr").string() : "",
      drive.roads, drive.pieces, drive.junctions, 1e3 * drive.middle_error_m, 1e3 * drive.border_error_m,
      1e3 * drive.height_error_m);
  return 0;
}

}  // namespace

int MapCommand(const MapOptions& options) {
  return options.command == "check" ? CheckMapFile(options.file) : Convert(options);
}

}  // namespace rodeira::cli
