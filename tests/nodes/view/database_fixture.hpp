// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "nodes/view/visual_database/database.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"

namespace rodeira::nodes {

namespace fs = std::filesystem;

// A folder for the databases of a test.
class Database : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("rodeira_database_{}", ::getpid());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  DatabaseReport Write(const road::World& world, const std::string& name, unsigned threads = 2) {
    DatabaseOptions options;
    options.folder = folder_ / name;
    options.threads = threads;
    const auto report = WriteDatabase(world, options);
    EXPECT_TRUE(report.ok()) << report.error().Text();
    return report.ok() ? report.value() : DatabaseReport{};
  }

  std::map<std::string, std::string> Files(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      if (!entry.is_regular_file()) continue;
      std::ostringstream bytes;
      bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files[fs::relative(entry.path(), folder_ / name).string()] = bytes.str();
    }
    return files;
  }

  fs::path folder_;
};

// What stands below groups.
struct TilesBelow : osg::NodeVisitor {
  std::vector<osg::PagedLOD*> tiles;
  std::size_t groups = 0, most_children = 0;

  explicit TilesBelow(osg::Node& root) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { root.accept(*this); }
  void apply(osg::PagedLOD& tile) override { tiles.push_back(&tile); }
  void apply(osg::Group& group) override {
    ++groups;
    most_children = std::max<std::size_t>(most_children, group.getNumChildren());
    traverse(group);
  }
};

// With signs, trees and a rail beside the bend.
inline std::string BendWithThings(double sign_s_m = 90.0) {
  std::string text = scene::BendUnderBridge();
  text.insert(
      text.find("</road>"),
      fmt::format(
          "<objects><object id=\"t\" type=\"tree\" s=\"0\" t=\"-9\" zOffset=\"0\" radius=\"2\" height=\"7\"><repeat "
          "s=\"0\" length=\"156\" distance=\"13\" tStart=\"-9\" tEnd=\"-12\"/></object>"
          "<object id=\"r\" type=\"barrier\" subtype=\"guardRail\" s=\"0\" t=\"6\" height=\"0.75\" "
          "width=\"0.3\"><repeat s=\"0\" length=\"160\" distance=\"0\" tStart=\"6\" tEnd=\"6\"/></object></objects>"
          "<signals><signal id=\"a\" s=\"{}\" t=\"-6\" zOffset=\"2\" orientation=\"+\" dynamic=\"no\" type=\"274\" "
          "subtype=\"-1\" country=\"DE\" value=\"60\" unit=\"km/h\"/>"
          "<signal id=\"b\" s=\"80\" t=\"6\" zOffset=\"2\" orientation=\"-\" dynamic=\"no\" type=\"206\" "
          "subtype=\"-1\" country=\"DE\"/></signals>",
          sign_s_m));
  return text;
}

}  // namespace rodeira::nodes
