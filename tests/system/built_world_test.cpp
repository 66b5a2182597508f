// SPDX-License-Identifier: Apache-2.0
// A run on what `rodeira world build` has written: the road server and the car take its logical database, the view its
// tiles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "common/core/base/files.hpp"
#include "common/core/base/hash.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRoad = R"(<?xml version="1.0"?>
<OpenDRIVE><header revMajor="1" revMinor="7"/>
<road id="1" length="400" junction="-1"><planView><geometry s="0" x="0" y="0" hdg="0" length="400"><line/></geometry>
  </planView>
<elevationProfile><elevation s="0" a="2" b="0.02" c="0" d="0"/></elevationProfile>
<lanes><laneSection s="0">
<left><lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></left>
<center><lane id="0"><roadMark sOffset="0" type="broken" width="0.12"/></lane></center>
<right><lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right>
</laneSection></lanes></road></OpenDRIVE>
)";

struct Driven {
  Ended ended;
  std::string digest;
  std::map<std::string, base::Digest> frames;
};

class BuiltWorld : public ::testing::Test {
 protected:
  BuiltWorld() {
    EXPECT_TRUE(base::WriteWhole(folder_.path() / "town.xodr", std::string_view(kRoad)).ok());
    const Ended built = RunCommand(
        {Bin("rodeira"), "world", "build", (folder_.path() / "town.xodr").string(), "-o", out_.string(), "--quiet"});
    EXPECT_EQ(built.status, 0) << built.out;
  }
  // A second of driving, looked at twice, on the world file of that name.
  Driven Drive(const std::string& world, const std::string& name) const {
    const std::string configs = SourceDir() + "/configs/";
    const fs::path launch = folder_.path() / (name + ".yaml");
    const std::string text =
        "rodeira: launch/1\nname: built\nworld: " + world + "\nseed: 1\nduration_s: 1\nnodes:\n  road: {kind: road}\n" +
        "  driver: {kind: input, config: {source: autopilot, driver: " + configs +
        "drivers/default.yaml, vehicle: " + configs + "vehicles/default.yaml}}\n" +
        "  ego: {kind: vehicle, config: {vehicle: " + configs + "vehicles/default.yaml, ground: remote}}\n" +
        "  view: {kind: view, config: {width_px: 320, height_px: 180, window: never, frames: {times_s: [0.4, 0.8], "
        "folder: " +
        name + "}}}\n";
    EXPECT_TRUE(base::WriteWhole(launch, std::string_view(text)).ok());
    Driven driven{RunCommand({Bin("rodeira"), "run", launch.string(), "--pace", "max", "--no-record"}), "", {}};
    EXPECT_EQ(driven.ended.status, 0) << driven.ended.out;
    driven.digest = DigestIn(driven.ended.out);
    std::error_code none;
    for (const auto& frame : fs::directory_iterator(folder_.path() / name, none)) {
      driven.frames[frame.path().filename().string()] = base::Hash(base::ReadBytes(frame.path()).value());
    }
    EXPECT_EQ(driven.frames.size(), 2u);
    return driven;
  }
  // Puts other bytes into a file of the database; with `listed` the manifest knows them.
  void Put(const std::string& name, const std::string& bytes, bool listed) const {
    const fs::path manifest = out_ / "visual.txt";
    std::string text = base::ReadText(manifest).value();
    const std::string before = base::Hex(base::Hash(base::ReadText(out_ / name).value())),
                      after = base::Hex(base::Hash(bytes));
    ASSERT_NE(text.find(before), std::string::npos);
    if (listed) text.replace(text.find(before), before.size(), after);
    ASSERT_TRUE(base::WriteWhole(out_ / name, std::string_view(bytes)).ok());
    ASSERT_TRUE(base::WriteWhole(manifest, std::string_view(text)).ok());
  }

  const cli::TemporaryFolder folder_;
  const fs::path out_ = folder_.path() / "out";
};

TEST_F(BuiltWorld, IsDrivenAndSeenAsTheWorldItIsMadeFrom) {
  const Driven source = Drive("town.xodr", "source"), built = Drive("out/world.xodr", "built");
  ASSERT_EQ(source.digest.size(), 16u);
  EXPECT_EQ(built.digest, source.digest);
  EXPECT_EQ(built.frames, source.frames);
  EXPECT_EQ(built.ended.out.find("is not shown"), std::string::npos) << built.ended.out;
  // The tiles are what is seen: with another one's content in the place of the one under the car the picture is
  // another.
  const std::string own = base::ReadText(out_ / "tiles/0_0_0.osgb").value();
  Put("tiles/0_0_0.osgb", base::ReadText(out_ / "tiles/1_0_0.osgb").value(), true);
  const Driven exchanged = Drive("out/world.xodr", "exchanged");
  EXPECT_EQ(exchanged.digest, source.digest);
  EXPECT_NE(exchanged.frames, source.frames);
  // A file that is not what was written is said, and the ground is built as without it.
  Put("tiles/0_0_0.osgb", own + "more", false);
  const Driven broken = Drive("out/world.xodr", "broken");
  EXPECT_THAT(broken.ended.out, HasLine("is not shown … 'tiles/0_0_0.osgb'"));
  EXPECT_EQ(broken.digest, source.digest);
  EXPECT_EQ(broken.frames, source.frames);
}

}  // namespace
}  // namespace rodeira::system_test
