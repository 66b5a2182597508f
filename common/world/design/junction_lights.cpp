// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_lights.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/world/design/section_reader.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

constexpr double kLine_m = 1.0;    // before the junction: the middle of the stop line, and the light
constexpr double kWide_m = 0.5;    // of the line
constexpr double kBeside_m = 0.5;  // of the outermost lane's edge

}  // namespace

std::optional<std::string> PutLight(network::RoadSpec& spec, network::End end) {
  const bool starts = end == network::End::kStart;
  const bool right_side = spec.left_hand ? starts : !starts;  // where oncoming traffic stands
  const network::LaneSection& section = starts ? spec.sections.front() : spec.sections.back();
  const int outermost = right_side ? -static_cast<int>(section.right.size()) : static_cast<int>(section.left.size());
  const double s = starts ? kLine_m : spec.length_m - kLine_m;
  bool has_incoming = false;
  for (const auto* side : {&section.left, &section.right}) {
    for (const network::Lane& lane : *side) {
      const int incoming = starts ? -1 : 1;
      const int usual = (lane.id < 0) != spec.left_hand ? 1 : -1;
      if (!network::IsDrivable(lane.type) || (lane.direction != 0 ? lane.direction : usual) != incoming) continue;
      const double inner = EdgeOf(spec, lane.id > 0 ? lane.id - 1 : lane.id + 1).Value(s),
                   outer = EdgeOf(spec, lane.id).Value(s);
      const double width = std::fabs(outer - inner);
      if (width < 1.0) continue;
      has_incoming = true;
      spec.lines.push_back(
          {s - 0.5 * kWide_m, s + 0.5 * kWide_m, Constant(0.5 * (inner + outer)), width - 0.2, 0.0, 0.0, "white"});
    }
  }
  if (!has_incoming) return std::nullopt;
  network::Signal signal;
  signal.id = fmt::format("{}-{}-light", spec.id, starts ? "start" : "end");
  signal.name = "light";
  signal.s_m = s;
  signal.t_m = EdgeOf(spec, outermost).Value(s) + (right_side ? -kBeside_m : kBeside_m);
  signal.z_offset_m = 2.2;
  signal.orientation.assign(1, starts ? '-' : '+');
  signal.dynamic = true;
  signal.country = "OpenDRIVE";
  signal.type = "1000001";
  signal.subtype = "-1";
  signal.height_m = 0.9;
  signal.width_m = 0.3;
  spec.signals.push_back(signal);
  return signal.id;
}

}  // namespace rodeira::design
