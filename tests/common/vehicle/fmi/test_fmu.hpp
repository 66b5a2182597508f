// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <zip.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "tests/tree.hpp"

// The FMU of tests/data/fmu, whole or spoilt, in a folder of the test's own.
namespace rodeira::fmi {

using Entries = std::vector<std::pair<std::string, std::string>>;  // name and bytes

inline void WriteZip(const std::filesystem::path& path, const Entries& entries) {
  zipFile file = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
  ASSERT_NE(file, nullptr);
  for (const auto& [name, bytes] : entries) {
    ASSERT_EQ(zipOpenNewFileInZip64(file, name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 1, 0),
              ZIP_OK);
    ASSERT_EQ(zipWriteInFileInZip(file, bytes.data(), static_cast<unsigned>(bytes.size())), ZIP_OK);
    ASSERT_EQ(zipCloseFileInZip(file), ZIP_OK);
  }
  ASSERT_EQ(zipClose(file, nullptr), ZIP_OK);
}

class FmuFolder {
 public:
  FmuFolder() : path_(std::filesystem::temp_directory_path() / ("rodeira-test-fmu-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~FmuFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  static std::string Description() {
    return base::ReadText(std::filesystem::path(SourceDir()) / "tests/data/fmu/modelDescription.xml").value();
  }
  // `name`: "car"; "crashing" for one that crashes when it is loaded; "addresses" and "pointers" for states with
  // addresses that are of no use, or used; "forgetful" for states without the solver's history; "once" for one that
  // allows one instance a process.
  static std::string Binary(const std::string& name) {
    return base::ReadText(std::filesystem::path(RODEIRA_TEST_FMU_FOLDER) / (name + ".so")).value();
  }

  // Replaces each first text by the second in the description.
  static std::string Changed(const std::vector<std::pair<std::string, std::string>>& changes) {
    std::string text = Description();
    for (const auto& [from, to] : changes) {
      const auto at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      if (at != std::string::npos) text.replace(at, from.size(), to);
    }
    return text;
  }
  std::filesystem::path Pack(const std::vector<std::pair<std::string, std::string>>& changes = {},
                             const std::string& platform = "linux64", const std::string& binary = "car") const {
    const auto file = path_ / "car.fmu";
    WriteZip(file, {{"modelDescription.xml", Changed(changes)},
                    {"binaries/" + platform + "/car.so", Binary(binary)},
                    {"resources/note.txt", "of no use"}});
    return file;
  }
  // A vehicle file that drives what is packed, beside it; `more`: further lines.
  std::filesystem::path WriteCar(const std::string& more = "") const {
    const auto file = path_ / "car.yaml";
    EXPECT_TRUE(
        base::WriteWhole(
            file, "rodeira: vehicle/1\nmodel: fmu\nfmu: car.fmu\nnames: {heading_rad: body.yaw}\n" + more +
                      "dimensions: {wheelbase_m: 2.5, track_front_m: 1.4, track_rear_m: 1.4, wheel_radius_m: 0.3, "
                      "wheel_width_m: 0.2,\n"
                      "  front_m: 2, rear_m: 1.9, width_m: 1.7, height_m: 1.4, mass_kg: 1000, steering_ratio: 16,\n"
                      "  steering_wheel_limit_rad: 8, forward_gears: 1}\n")
            .ok());
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace rodeira::fmi
