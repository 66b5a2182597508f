// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/editor/export.hpp"
#include "nodes/editor/work.hpp"

namespace rodeira::nodes {
namespace {

using editor::Document;

std::filesystem::path Start(const Work& work, const char* default_value) {
  if (!work.session.path().empty()) return work.session.path();
  std::error_code problem;
  return std::filesystem::current_path(problem) / default_value;
}

}  // namespace

void NewCurve(Work& work) {
  // A third of the view long, through its middle; below the last one where that one lies there still.
  const double third_m = work.view.width_m() / 6.0, below_m = 30.0 * work.view.metres_per_px;
  Eigen::Vector2d middle = work.view.middle_W;
  const auto taken = [&](const Eigen::Vector2d& at) {
    return editor::HandleAt(work.session.document(), at - Eigen::Vector2d(third_m, 0.0), 0.4 * below_m).has_value();
  };
  for (int i = 0; i < 20 && taken(middle); ++i) middle.y() -= below_m;
  editor::Points points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = middle + Eigen::Vector2d((static_cast<double>(i) - 1.5) * third_m * 2.0 / 3.0, 0.0);
  if (!work.session.Do([&](Document& document) { return editor::NewCurve(document, points); })) return;
  work.session.selection = {};
  work.session.selection.curves.insert(work.session.document().map.curves.back().value.id);
}

void DeleteChosen(Work& work) {
  editor::Selection chosen = work.session.selection;
  if (work.session.Do([&](Document& document) { return editor::Remove(document, chosen); }))
    work.session.selection = {};
}

void ChooseAll(Work& work) {
  constexpr double kEverything_m = 2e6;
  work.session.selection =
      editor::Inside(work.session.document(), {-kEverything_m, -kEverything_m}, {kEverything_m, kEverything_m});
  work.session.Say(fmt::format("{} curves, {} lanes and {} connections chosen", work.session.selection.curves.size(),
                               work.session.selection.lanes.size(), work.session.selection.connections.size()));
}

void ShowAll(Work& work) {
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const auto& line : work.session.document().map.curves) {
    for (const auto& point : editor::CubicOf(line.value).p_W) low = low.cwiseMin(point), high = high.cwiseMax(point);
  }
  const auto& picture = work.picture.picture();
  if (picture != nullptr) {
    const double half_y = 5.0 * static_cast<double>(work.session.document().map.scale.value.value);
    const double half_x = half_y * picture->width_px() / picture->height_px();
    low = low.cwiseMin(Eigen::Vector2d(-half_x, -half_y)), high = high.cwiseMax(Eigen::Vector2d(half_x, half_y));
  }
  if (low.x() <= high.x()) work.view.Show(low, high);
}

void ProposeConnections(Work& work) {
  const auto missing = editor::MissingConnections(work.session.document());
  work.session.Do([&](Document& document) { return editor::Connect(document, missing); });
}

void SaveOrAsk(Work& work, const Action& then) {
  if (work.session.path().empty()) return AskToSave(work, false, then);
  if (work.session.Save(work.session.path()) && then) then(work);
}

void UnlessUnsaved(Work& work, Action act) {
  if (!work.session.unsaved()) return act(work);
  work.after = std::move(act);
  work.Open(Form::kUnsaved);
}

void NewMap(Work& work) {
  StopTraffic(work);
  work.session.New();
}

void AskToOpen(Work& work) {
  work.files.Open("Open a map", {".motors"}, false, Start(work, ""), [&work](const std::filesystem::path& path) {
    StopTraffic(work);
    if (work.session.Open(path)) ShowAll(work);
  });
}

void AskToSave(Work& work, bool despite_errors, const Action& then) {
  work.files.Open(despite_errors ? "Save a draft" : "Save the map", {".motors"}, true, Start(work, "map.motors"),
                  [&work, despite_errors, then](const std::filesystem::path& path) {
                    if (work.session.Save(path, despite_errors) && then) then(work);
                  });
}

void AskToImport(Work& work) {
  work.files.Open("Import a background", {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"}, false,
                  Start(work, "").parent_path() / "", [&work](const std::filesystem::path& path) {
                    auto bytes = editor::ImportPicture(path);
                    if (!bytes) return work.session.Say(bytes.error().Text(), false);
                    work.session.SetPicture(std::move(bytes).value(), work.session.document().map.scale.value.value);
                  });
}

void AskToExport(Work& work) {
  std::filesystem::path start = Start(work, "map.motors");
  start.replace_extension(".yaml");
  work.files.Open("Export as a world", {".yaml", ".xodr"}, true, start, [&work](const std::filesystem::path& path) {
    const auto exported = editor::Export(work.session.document(), path);
    work.session.Say(exported ? exported.value() : "not exported: " + exported.error().Text(), exported.ok());
  });
}

void AskToClose(Work& work) {
  UnlessUnsaved(work, [](Work& w) { w.closing = true; });
}

void RunOrPause(Work& work) {
  Traffic& traffic = work.traffic;
  if (traffic.preview && traffic.of_state == work.session.state()) {
    traffic.runs = !traffic.runs;
    return work.session.Say(traffic.runs ? "traffic runs" : "traffic pauses");
  }
  auto preview = editor::Preview::Start(work.session.document(), {static_cast<std::uint32_t>(traffic.vehicles), 1});
  if (!preview) {
    for (const traffic_map::Finding& finding : work.session.Findings()) {
      if (finding.severity != traffic_map::Severity::kError) continue;
      work.session.selection = editor::Chosen(finding);
      break;
    }
    return work.session.Say("no traffic: " + preview.error().Text(), false);
  }
  traffic.preview.emplace(std::move(preview).value());
  traffic.of_state = work.session.state();
  traffic.runs = true;
  traffic.heat.clear();
  traffic.heat_of_s = -1.0;
  work.session.Say(fmt::format("traffic runs with {} vehicles", traffic.vehicles));
}

void StopTraffic(Work& work) {
  work.traffic.preview.reset();
  work.traffic.heat.clear();
  work.traffic.runs = false;
}

}  // namespace rodeira::nodes
