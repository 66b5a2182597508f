// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::lanes {

// Two ways that come together, and part the other way round, each cut into lane sections of `cut_m` at that end, two of
// the one and one of the other, as files from drawing programs have them: road 1, straight through road 4, and road 2,
// in a bend of 3 m through road 5, lead into road 3 in (0, 0). The right lanes come together there, the left ones part.
inline std::shared_ptr<const network::Network> ShortSections(double cut_m) {
  const auto lane = [](int id) {
    return fmt::format(
        "<lane id=\"{0}\" type=\"driving\"><link><predecessor id=\"{0}\"/><successor id=\"{0}\"/></link><width "
        "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>"
        "<speed sOffset=\"0\" max=\"14\" unit=\"m/s\"/></lane>",
        id);
  };
  const auto road = [&](const std::string& id, double x, double y, double heading, double length, double curvature,
                        const std::string& link, const std::vector<double>& sections) {
    const std::string shape = curvature == 0.0 ? "<line/>" : fmt::format("<arc curvature=\"{}\"/>", curvature);
    std::string text = fmt::format(
        "<road id=\"{}\" length=\"{:.17g}\" junction=\"{}\">\n<link>{}</link>\n<planView><geometry s=\"0\" x=\"{}\" "
        "y=\"{}\" hdg=\"{:.17g}\" length=\"{:.17g}\">{}</geometry></planView>\n<lanes>",
        id, length, sections.size() > 1 ? "9" : "-1", link, x, y, heading, length, shape);
    for (const double s : sections) {
      text += fmt::format(
          "<laneSection s=\"{}\"><left>{}</left><center><lane id=\"0\" "
          "type=\"none\"/></center><right>{}</right></laneSection>\n",
          s, lane(1), lane(-1));
    }
    return text + "</lanes></road>\n";
  };
  const auto road_link = [](const std::string& which, const std::string& id, const std::string& contact) {
    return "<" + which + " elementType=\"road\" elementId=\"" + id + "\" contactPoint=\"" + contact + "\"/>";
  };
  const std::string into = "<successor elementType=\"junction\" elementId=\"9\"/>",
                    from = "<predecessor elementType=\"junction\" elementId=\"9\"/>";
  const auto connection = [](int id, const std::string& incoming, const std::string& by, const std::string& contact,
                             int lane_id) {
    return fmt::format(
        "<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" contactPoint=\"{}\"><laneLink from=\"{}\" "
        "to=\"{}\"/></connection>",
        id, incoming, by, contact, lane_id, lane_id);
  };
  constexpr double kRadius_m = 3.0, kNorth_rad = 1.5707963267948966, kBend_m = kRadius_m * kNorth_rad;
  return opendrive::MustRead(opendrive::Document(
      road("1", -320.0, 0.0, 0.0, 300.0, 0.0, into, {0.0}) +
      road("2", -kRadius_m, -kRadius_m - 300.0, kNorth_rad, 300.0, 0.0, into, {0.0}) +
      road("3", 0.0, 0.0, 0.0, 300.0, 0.0, from, {0.0}) +
      road("4", -20.0, 0.0, 0.0, 20.0, 0.0, road_link("predecessor", "1", "end") + road_link("successor", "3", "start"),
           {0.0, 20.0 - 2.0 * cut_m, 20.0 - cut_m}) +
      road("5", -kRadius_m, -kRadius_m, kNorth_rad, kBend_m, -1.0 / kRadius_m,
           road_link("predecessor", "2", "end") + road_link("successor", "3", "start"), {0.0, kBend_m - cut_m}) +
      "<junction id=\"9\" name=\"together\">" + connection(0, "1", "4", "start", -1) +
      connection(1, "2", "5", "start", -1) + connection(2, "3", "4", "end", 1) + connection(3, "3", "5", "end", 1) +
      "</junction>"));
}

}  // namespace rodeira::lanes
