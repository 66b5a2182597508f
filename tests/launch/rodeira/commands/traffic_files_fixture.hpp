// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {

// Ten cars for a minute and a half on the ramp's map, with a name that XML has to spell otherwise.
class TrafficFilesTest : public testing::Test {
 protected:
  using Rows = std::vector<std::map<std::string, std::string>>;

  static Said RunWith(const TrafficOptions& options) { return SaidBy(TrafficRun, options); }

  // A table by the names in its first line.
  static Rows Table(const std::filesystem::path& file, const std::string& header) {
    std::istringstream text(base::ReadText(file).value());
    const auto fields = [](const std::string& line) {
      std::vector<std::string> all{""};
      bool quoted = false;
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') {
          if (quoted && i + 1 < line.size() && line[i + 1] == '"')
            all.back() += line[++i];
          else
            quoted = !quoted;
        } else if (line[i] == ',' && !quoted) {
          all.emplace_back();
        } else {
          all.back() += line[i];
        }
      }
      return all;
    };
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, header);
    const auto names = fields(line);
    Rows rows;
    while (std::getline(text, line)) {
      const auto values = fields(line);
      EXPECT_EQ(values.size(), names.size()) << line;
      rows.emplace_back();
      for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) rows.back()[names[i]] = values[i];
    }
    return rows;
  }

  static double Number(const std::map<std::string, std::string>& row, const std::string& key) {
    return std::stod(row.at(key));
  }

  static constexpr const char* kLanes =
      "road,lane,s_m,x_m,y_m,length_m,flow_vehph,density_vehpkm,speed_mps,fuel_mlpkm,free_mps";
  static constexpr const char* kTrips =
      "vehicle,kind,from,to,entered_s,travel_time_s,fuel_ml,delay_s,flow,left,left_s,way_m,waiting_s";
  static constexpr const char* kIntervals =
      "from_s,to_s,road,section,lane,in,out,flow_vehph,density_vehpkm,speed_mps,queue_longest,queue_mean";

  TrafficFilesTest() {
    options_.map = folder_.path() / "a & <b>.motors";
    std::filesystem::copy_file(SourceDir() + "/configs/maps/ramp.motors", options_.map);
    options_.vehicles = 10;
    options_.duration_s = 90.0;
    options_.step_s = 0.05;
  }
  std::string In(const char* name) const { return folder_.path() / name; }

  const TemporaryFolder folder_;
  TrafficOptions options_;
};

}  // namespace rodeira::cli
