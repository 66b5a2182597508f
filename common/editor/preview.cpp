// SPDX-License-Identifier: Apache-2.0
#include "common/editor/preview.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/traffic/demand/map_demand.hpp"
#include "common/world/traffic_map/map_network.hpp"

namespace rodeira::editor {
namespace {

constexpr std::uint64_t kStepsALook = 10;  // at queues

}  // namespace

base::Result<Preview> Preview::Start(const Document& document, const PreviewSettings& settings) {
  const auto lanes = traffic_map::MakeLaneMap(document.map, document.companion, "map");
  if (!lanes) return lanes.error().WithContext("");
  const auto network = traffic_map::ToNetwork(lanes.value(), "map");
  if (!network) return network.error();
  traffic::TrafficSettings how;
  how.vehicles = settings.vehicles;
  how.seed = settings.seed;
  how.demand = traffic::DemandOf(document.companion, "map");
  auto model = traffic::TrafficModel::Make(how, network.value(), {});
  if (!model) return model.error();
  Preview preview;
  preview.model_ = std::make_unique<traffic::TrafficModel>(std::move(model).value());
  preview.statistics_ = std::make_unique<traffic::LaneStatistics>(*preview.model_);
  return preview;
}

void Preview::Run(double seconds) {
  left_over_s_ += seconds;
  for (; left_over_s_ >= kStep_s; left_over_s_ -= kStep_s) {
    model_->Step(kStep_s, {});
    statistics_->Add(*model_, kStep_s);
    if (++steps_ % kStepsALook == 0) statistics_->LookAtQueues(*model_);
  }
  time_s_ = static_cast<double>(steps_) * kStep_s;
}

std::vector<HeatPatch> Preview::Heat() const {
  const lanes::Graph& graph = model_->graph();
  std::vector<HeatPatch> patches;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const double length_m = statistics_->CellLength_m(track);
    const auto& cells = statistics_->CellsOf(track);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].time_s <= 0.0) continue;
      const double d_m = (static_cast<double>(i) + 0.5) * length_m;
      const lanes::CurvePoint at = graph[track].curve.At(d_m);
      const double share = cells[i].Speed_mps() / graph.SpeedLimit_mps(track, d_m);
      patches.push_back(
          {at.p_W.head<2>(), at.ahead_W, length_m, graph[track].curve.WidthAt(d_m), std::min(share, 1.0)});
    }
  }
  return patches;
}

}  // namespace rodeira::editor
