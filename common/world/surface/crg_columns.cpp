// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rodeira::surface {
namespace {

constexpr double kNarrowest_m = 1e-6;  // of two sections

class ColumnFinder {
 public:
  ColumnFinder(const CrgHeader& header, std::string_view name, std::vector<std::string>& warnings)
      : header_(header), road_(header.road), name_(name), warnings_(warnings) {}

  base::Result<CrgColumns> Find() {
    std::vector<std::pair<double, std::size_t>> placed, counted;
    for (std::size_t i = 0; i < header_.channels.size(); ++i) {
      const CrgChannel& channel = header_.channels[i];
      int* place = nullptr;
      switch (channel.column) {
        case CrgColumn::kHeading:
          place = &found_.heading;
          break;
        case CrgColumn::kX:
          place = &found_.x;
          break;
        case CrgColumn::kY:
          place = &found_.y;
          break;
        case CrgColumn::kSlope:
          place = &found_.slope;
          break;
        case CrgColumn::kBanking:
          place = &found_.banking;
          break;
        case CrgColumn::kUnused:
          break;
        case CrgColumn::kHeight:
          if (channel.v_m)
            placed.emplace_back(*channel.v_m, i);
          else
            counted.emplace_back(channel.number, i);
      }
      if (place == nullptr) continue;
      if (*place >= 0) {
        return Wrong(fmt::format("columns {} and {} hold the same; each but the long sections may be there once",
                                 *place + 1, i + 1));
      }
      *place = static_cast<int>(i);
    }
    if ((found_.x >= 0) != (found_.y >= 0)) {
      return Wrong("of the reference line's x and y only one is there; both or none were expected");
    }
    if (!placed.empty() && !counted.empty()) {
      return Wrong("some long sections say 'at v =' and others are counted; one way for all was expected");
    }
    if (placed.size() + counted.size() < 2) {
      return Wrong(
          fmt::format("{} long sections were found; at least 2 were expected", placed.size() + counted.size()));
    }
    std::sort(placed.begin(), placed.end());
    std::sort(counted.begin(), counted.end());
    for (const auto& [v, column] : placed.empty() ? counted : placed) {
      found_.heights.push_back(column), found_.v_m.push_back(v);
    }
    if (const auto fine = placed.empty() ? CountedSections() : PlacedSections(); !fine) return fine.error();
    return std::move(found_);
  }

 private:
  base::Error Wrong(std::string_view message) const { return base::WrongInput("surface.wrong_header", message, name_); }

  base::Status PlacedSections() {
    const std::vector<double>& v = found_.v_m;
    for (std::size_t i = 1; i < v.size(); ++i) {
      if (v[i] - v[i - 1] < kNarrowest_m)
        return Wrong(fmt::format("two long sections lie at v = {} and {}", v[i - 1], v[i]));
    }
    const auto differs = [](const std::optional<double>& said, double is) {
      return said && std::fabs(*said - is) > 1e-4;
    };
    if (differs(road_.v_right_m, v.front()) || differs(road_.v_left_m, v.back())) {
      warnings_.push_back(
          fmt::format("the sections lie from v = {} to {}, which is not what LONG_SECTION_V_RIGHT and V_LEFT say",
                      v.front(), v.back()));
    }
    return {};
  }

  base::Status CountedSections() {
    std::vector<double>& v = found_.v_m;
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (v[i] != static_cast<double>(i + 1)) {
        return Wrong(fmt::format(
            "long section {} was found where {} was expected; they are counted from 1 at the right", v[i], i + 1));
      }
    }
    const double cells = static_cast<double>(v.size() - 1);
    double right = 0.0, step = 0.0;
    if (road_.v_right_m && road_.v_left_m) {
      right = *road_.v_right_m;
      step = (*road_.v_left_m - right) / cells;
      if (road_.v_increment_m && std::fabs(step - *road_.v_increment_m) > kIncrementTolerance * step) {
        return Wrong(
            fmt::format("{} long sections from v = {} to {} lie {:.6g} m apart; LONG_SECTION_V_INCREMENT says {}",
                        v.size(), right, *road_.v_left_m, step, *road_.v_increment_m));
      }
    } else if (road_.v_increment_m) {
      step = *road_.v_increment_m;
      right =
          road_.v_right_m ? *road_.v_right_m : (road_.v_left_m ? *road_.v_left_m - cells * step : -0.5 * cells * step);
    } else {
      return Wrong(
          "nothing says where the long sections lie: 'at v =', LONG_SECTION_V_RIGHT and V_LEFT, or V_INCREMENT was "
          "expected");
    }
    if (step < kNarrowest_m) return Wrong(fmt::format("the long sections lie {} m apart, from right to left", step));
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = right + static_cast<double>(i) * step;
    return {};
  }

  const CrgHeader& header_;
  const CrgRoadKeys& road_;
  std::string_view name_;
  std::vector<std::string>& warnings_;
  CrgColumns found_;
};

}  // namespace

base::Result<CrgColumns> FindCrgColumns(const CrgHeader& header, std::string_view name,
                                        std::vector<std::string>& warnings) {
  return ColumnFinder(header, name, warnings).Find();
}

}  // namespace rodeira::surface
