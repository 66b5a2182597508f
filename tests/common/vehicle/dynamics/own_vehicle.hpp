// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "tests/tree.hpp"

// A folder with the vehicle of examples/own_vehicle and the tests' other shared objects.
namespace rodeira::dynamics {

class OwnVehicleFolder {
 public:
  OwnVehicleFolder()
      : path_(std::filesystem::temp_directory_path() / ("rodeira-own-vehicle-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    for (const char* name : {"kinematic_car", "odd_vehicle", "vehicle_of_another_build", "no_vehicle"}) {
      const auto link = path_ / (std::string(name) + ".so");
      std::filesystem::remove(link);
      std::filesystem::create_symlink(
          std::filesystem::path(BinaryDir()) / "bin" / (std::string("rodeira-test-") + name + ".so"), link);
    }
  }
  ~OwnVehicleFolder() { std::filesystem::remove_all(path_); }
  OwnVehicleFolder(const OwnVehicleFolder&) = delete;
  OwnVehicleFolder& operator=(const OwnVehicleFolder&) = delete;

  // The example's vehicle file with the first `from` replaced by `to`.
  std::filesystem::path Write(const std::string& from = "", const std::string& to = "") const {
    std::string text =
        base::ReadText(std::filesystem::path(SourceDir()) / "examples/own_vehicle/kinematic_car.yaml").value();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    const auto file = path_ / "car.yaml";
    EXPECT_TRUE(base::WriteWhole(file, text).ok());
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace rodeira::dynamics
