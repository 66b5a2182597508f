// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "common/world/opendrive/import.hpp"
#include "tests/tree.hpp"

namespace rodeira::opendrive {

inline std::string Document(const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"8\"/>\n" + content + "</OpenDRIVE>\n";
}

// A road of one lane of 3.5 m on each side, or with what is given instead.
struct RoadText {
  std::string id = "1";
  double length = 100.0;
  std::string attributes = "junction=\"-1\"";
  std::string link;
  std::string geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"100\"><line/></geometry>";
  std::string elevation, lateral, offset;
  std::string left = "<lane id=\"1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  std::string right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  std::string more;

  std::string Text() const {
    return fmt::format(
        "<road id=\"{}\" length=\"{}\" "
        "{}>\n<link>{}</link>\n<planView>{}</planView>\n<elevationProfile>{}</elevationProfile>\n"
        "<lateralProfile>{}</lateralProfile>\n<lanes>{}<laneSection s=\"0\">\n<left>{}</left>\n<center><lane id=\"0\" "
        "type=\"none\"/></center>\n"
        "<right>{}</right></laneSection></lanes>\n{}</road>\n",
        id, length, attributes, link, geometry, elevation, lateral, offset, left, right, more);
  }
};

inline Import MustImport(const std::string& text, const Tolerance& tolerance = {}) {
  auto import = Read(text, "sample.xodr", tolerance);
  EXPECT_TRUE(import.ok()) << import.error().Text();
  if (!import) return {};
  for (const Finding& error : import.value().errors) ADD_FAILURE() << ToError(error, "sample.xodr").Text();
  return std::move(import).value();
}

inline std::shared_ptr<const network::Network> MustRead(const std::string& text) { return MustImport(text).network; }

// Real files lie beside the project's folder; nothing where they do not.
inline std::vector<std::filesystem::path> RealFiles(const std::string& below = "") {
  const std::filesystem::path root(SourceDir());
  std::vector<std::filesystem::path> files;
  for (const auto& shared : {root / "../shared", root / "../../shared"}) {
    const std::filesystem::path folder = shared / "data/road/xodr" / below;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      if (entry.path().extension() == ".xodr") files.push_back(entry.path());
    }
    if (!files.empty()) break;
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace rodeira::opendrive
