// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>

#include "common/world/network/network.hpp"
#include "common/world/opendrive/import.hpp"

namespace rodeira::measures {

// A road from the origin to the east with lanes of 3.5 m, two (-1, -2) and a shoulder of 2 m (-3) on the right, one (1)
// on the left; straight for 1000 m, or an arc to the left of `radius_m` that closes to a circle. Driven on the right,
// or on the left.
inline std::shared_ptr<const network::Network> OneRoad(double radius_m = 0.0, bool left_hand = false) {
  const double length = radius_m > 0.0 ? 2.0 * std::numbers::pi * radius_m : 1000.0;
  const std::string shape = radius_m > 0.0 ? fmt::format("<arc curvature='{}'/>", 1.0 / radius_m) : "<line/>";
  const std::string link = radius_m > 0.0 ? "<link><predecessor elementType='road' elementId='1' contactPoint='end'/>"
                                            "<successor elementType='road' elementId='1' contactPoint='start'/></link>"
                                          : "";
  const auto lane = [&](int id, const char* type, double width) {
    const std::string to =
        radius_m > 0.0 ? fmt::format("<link><predecessor id='{0}'/><successor id='{0}'/></link>", id) : "";
    return fmt::format("<lane id='{}' type='{}' level='false'>{}<width sOffset='0' a='{}' b='0' c='0' d='0'/></lane>",
                       id, type, to, width);
  };
  const std::string text = fmt::format(
      "<?xml version='1.0'?><OpenDRIVE><header revMajor='1' revMinor='6' name='one'/>"
      "<road name='' length='{0}' id='1' junction='-1' rule='{1}'>{2}"
      "<type s='0' type='rural'><speed max='25' unit='m/s'/></type>"
      "<planView><geometry s='0' x='0' y='0' hdg='0' length='{0}'>{3}</geometry></planView>"
      "<lanes><laneSection s='0'><left>{4}</left><center><lane id='0' type='none' level='false'/></center>"
      "<right>{5}{6}{7}</right></laneSection></lanes></road></OpenDRIVE>",
      length, left_hand ? "LHT" : "RHT", link, shape, lane(1, "driving", 3.5), lane(-1, "driving", 3.5),
      lane(-2, "driving", 3.5), lane(-3, "shoulder", 2.0));
  auto made = opendrive::Read(text, "one.xodr");
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().Text());
  return made.value().network;
}

}  // namespace rodeira::measures
