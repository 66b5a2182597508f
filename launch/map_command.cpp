#include "launch/map_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "common/base/files.hpp"
#include "common/map/lane_map.hpp"
#include "common/map/map_plot.hpp"
#include "common/map/map_report.hpp"
#include "common/map/open_drive.hpp"

namespace rodeira::front {
namespace {

int Complain(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

int Check(const std::string& path) {
  const auto file = map::LoadMap(path);
  if (!file) return Complain(file.error());
  const auto heights = map::LoadHeightsOf(path);
  if (!heights) return Complain(heights.error());
  const auto findings = map::CheckMap(file.value(), heights.value());
  int status = 0;
  for (const map::Finding& finding : findings) {
    const bool is_error = finding.severity == map::Severity::kError;
    fmt::print(stderr, "rodeira: {}: {}{}\n", base::Printable(finding.Place(path)), is_error ? "" : "warning: ", finding.Text());
    if (is_error) status = 2;
  }
  fmt::print("{}", map::DescribeMap(file.value(), heights.value(), findings));
  return status;
}

int Write(const MapOptions& options, std::string_view text, std::string_view remark) {
  if (auto status = base::WriteWhole(options.out, text); !status) return Complain(status.error());
  fmt::print("wrote {}{}\n", options.out, remark);
  return 0;
}

int Convert(const MapOptions& options) {
  const std::string kind = std::filesystem::path(options.out).extension();
  if (kind != ".svg" && kind != ".xodr") {
    return Complain(
        base::WrongInput(fmt::format("the file's name ends with '{}'; .svg or .xodr was expected", kind), options.out));
  }
  const auto made = map::LoadLaneMap(options.file);
  if (!made) return Complain(made.error());
  if (kind == ".svg") return Write(options, map::PlotMap(made.value()), "");
  const auto written = map::ToOpenDrive(made.value(), std::filesystem::path(options.file).stem());
  if (!written) return Complain(base::WrongInput(written.error().message, options.file));
  const map::OpenDrive& drive = written.value();
  return Write(
      options, drive.xml,
      fmt::format(
          ": {} roads in {} pieces, {} junctions; off by at most {:.2f} mm (middle), {:.2f} mm (borders), {:.2f} mm (height)",
          drive.roads, drive.pieces, drive.junctions, 1e3 * drive.middle_error_m, 1e3 * drive.border_error_m,
          1e3 * drive.height_error_m));
}

}  // namespace

int MapCommand(const MapOptions& options) { return options.command == "check" ? Check(options.file) : Convert(options); }

}  // namespace rodeira::front
