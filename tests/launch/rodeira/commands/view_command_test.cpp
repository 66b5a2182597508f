// SPDX-License-Identifier: Apache-2.0
// `rodeira view LAUNCH.yaml --screen NAME --headset`: which run that is.
#include "launch/rodeira/commands/view_command.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

const std::string kThreeScreens = SourceDir() + "/launch/three_screens.yaml";

ViewOptions Options(const std::string& file, const std::string& screen, bool headset = false) {
  ViewOptions options;
  options.launch_file = file;
  options.screen = screen;
  options.headset = headset;
  return options;
}

// The views that a run has, each with its screen.
std::string ViewsOf(const RunOptions& run) {
  const auto launch = launch::Launch::Load(run.launch_file, run.overrides);
  if (!launch) return launch.error().Text();
  std::string views;
  for (const launch::LaunchNode& node : launch.value().nodes()) {
    if (node.kind->name == "view")
      views += node.name + ":" + node.config->Peek({"config", "screen"}).value_or("") + ":" +
               node.config->Peek({"config", "headset"}).value_or("false") + " ";
  }
  return views;
}

TEST(ViewCommand, OnOnePcItIsTheRunWithThatScreenAlone) {
  const auto right = RunOf(Options(kThreeScreens, "right"));
  ASSERT_TRUE(right.ok()) << right.error().Text();
  EXPECT_EQ(ViewsOf(right.value()), "right:right:false ");
  EXPECT_EQ(right.value().host, "");
  const auto all = RunOf(Options(kThreeScreens, ""));
  ASSERT_TRUE(all.ok()) << all.error().Text();
  EXPECT_EQ(ViewsOf(all.value()), "left:left:false centre:centre:false right:right:false ");
  const auto headset = RunOf(Options(kThreeScreens, "centre", true));
  ASSERT_TRUE(headset.ok()) << headset.error().Text();
  EXPECT_EQ(ViewsOf(headset.value()), "centre:centre:true ");
}

TEST(ViewCommand, WithAHostItIsThatHostsPartUnchanged) {
  std::ifstream in(kThreeScreens);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  for (const std::string& folder : {std::string("configs/labs"), std::string("configs/worlds"),
                                    std::string("configs/drivers"), std::string("configs/vehicles")}) {
    for (std::size_t at = text.find("../" + folder); at != std::string::npos; at = text.find("../" + folder))
      text.replace(at, 3, SourceDir() + "/");
  }
  const std::string left = "left: {kind: view, ";
  text.replace(text.find(left), left.size(), "left: {kind: view, host: west, ");
  const TemporaryFolder folder;
  const auto file = folder.path() / "lab.yaml";
  std::ofstream(file) << text;
  const auto run = RunOf(Options(file.string(), "left"));
  ASSERT_TRUE(run.ok()) << run.error().Text();
  EXPECT_EQ(run.value().host, "west");
  EXPECT_TRUE(run.value().overrides.empty()) << "every PC must have the same launch file";
  const auto headset = RunOf(Options(file.string(), "left", true));
  ASSERT_FALSE(headset.ok());
  EXPECT_NE(headset.error().Text().find("'headset: true' at the view was expected"), std::string::npos);
}

TEST(ViewCommand, WhatIsNotThereIsRefused) {
  const auto screen = RunOf(Options(kThreeScreens, "rigth"));
  ASSERT_FALSE(screen.ok());
  EXPECT_EQ(screen.error().exit_status(), 2);
  EXPECT_NE(screen.error().Text().find("no view looks through a screen 'rigth'; did you mean 'right'?"),
            std::string::npos)
      << screen.error().Text();
  const auto none = RunOf(Options(SourceDir() + "/launch/empty.yaml", ""));
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().Text().find("no node of kind view was found"), std::string::npos) << none.error().Text();
  EXPECT_EQ(View(Options("", "left")), 2);
}

}  // namespace
}  // namespace rodeira::cli
