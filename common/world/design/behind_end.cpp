// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/behind_end.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace rodeira::design {
namespace {

using config::List;
using config::Map;

constexpr double kSlack_m = 1.0, kGradeSlack_m = 100.0;

class Lists {
 public:
  Lists(std::string id, double length_m, std::vector<std::string>& warnings)
      : id_(std::move(id)), length_m_(length_m), warnings_(warnings) {}

  void Check(const Map& map, const char* key, double slack_m = kSlack_m) {
    const List points = map.OptionalItems(key);
    if (points.size() == 0) return;
    const double s_m = std::strtod(points.At(points.size() - 1).Peek({"s_m"}).value_or("0").c_str(), nullptr);
    if (!(s_m > length_m_ + slack_m)) return;
    warnings_.push_back(fmt::format("{}: '{}' has a point at s = {} m; road '{}' is {:.1f} m long",
                                    points.Place(points.size() - 1), key, s_m, id_, length_m_));
  }

 private:
  std::string id_;
  double length_m_;
  std::vector<std::string>& warnings_;
};

}  // namespace

void WarnBehindEnd(const Map& road, double length_m, std::vector<std::string>& warnings) {
  Lists lists(road.Peek({"id"}).value_or(""), length_m, warnings);
  lists.Check(road, "vertical", kGradeSlack_m);
  for (const char* key : {"superelevation", "speed_limits"}) lists.Check(road, key);
  const Map section = road.OptionalChild("section");
  for (const char* key : {"offsets", "crossfalls"}) lists.Check(section, key);
  const List lanes = section.OptionalItems("lanes");
  for (std::size_t i = 0; i < lanes.size(); ++i) lists.Check(lanes.At(i), "widths");
  for (const char* side : {"left", "right"})
    lists.Check(section.OptionalChild("shoulders").OptionalChild(side), "widths");
  lists.Check(section.OptionalChild("verge"), "widths");
}

}  // namespace rodeira::design
