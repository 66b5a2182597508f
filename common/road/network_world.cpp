#include "common/road/network_world.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/angle.hpp"
#include "common/opendrive/import.hpp"
#include "common/road/surface_detail.hpp"

namespace rodeira::road {
namespace {

constexpr double kFromStart_m = 10.0;
constexpr double kNarrowest_m = 2.0;

// Where on a lane the car starts.
double StationIn(const network::Network& network, const network::LaneKey& key) {
  const network::LaneSection& section = network.Section(key);
  const double into = std::min(kFromStart_m, 0.5 * (section.end_s_m - section.s_m));
  return network.Find(key)->direction < 0 ? section.end_s_m - into : section.s_m + into;
}

StartPose StartOn(const network::Network& network) {
  const network::LaneKey* longest = nullptr;
  double length = 0.0;
  bool goes_on = false;
  const auto lanes = network.Lanes();
  for (const network::LaneKey& key : lanes) {
    const network::LaneSection& section = network.Section(key);
    if (!network::IsDrivable(network.Find(key)->type) || !network.roads()[key.road].spec().junction.empty()) continue;
    const auto span = network.Span(key, StationIn(network, key));
    if (span->width_m() < kNarrowest_m) continue;
    const bool leads_on = !network.Successors(key).empty();
    if (leads_on < goes_on || (leads_on == goes_on && section.end_s_m - section.s_m <= length)) continue;
    length = section.end_s_m - section.s_m, longest = &key, goes_on = leads_on;
  }
  StartPose start;
  if (longest == nullptr) return start;
  const bool against = network.Find(*longest)->direction < 0;
  start.lane = longest->lane;
  start.s_m = StationIn(network, *longest);
  const Eigen::Vector3d p = network.Centre(*longest, start.s_m);
  start.x_m = p.x();
  start.y_m = p.y();
  const double heading = network.roads()[longest->road].axis().Evaluate(start.s_m).heading_rad;
  start.heading_rad = geometry::WrapAngle(heading + (against ? geometry::kPi : 0.0));
  return start;
}

}  // namespace

bool IsOpenDrive(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return extension == ".xodr";
}

base::Result<WorldSpec> ReadNetworkWorld(const std::filesystem::path& file) {
  auto import = opendrive::Load(file);
  if (!import) return import.error();
  if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), file);
  WorldSpec spec;
  spec.name = file.stem().string();
  spec.network = import.value().network;
  spec.network_hash = import.value().content_hash;
  spec.start = StartOn(*spec.network);
  auto detail = SurfaceDetail::Load(*spec.network, file.parent_path());
  if (!detail) return detail.error();
  if (!detail.value().empty()) spec.detail = std::make_shared<const SurfaceDetail>(std::move(detail).value());
  return spec;
}

}  // namespace rodeira::road
