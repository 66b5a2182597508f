// SPDX-License-Identifier: Apache-2.0
// The format as the thesis prints it: figure 18 and appendix A.15 to A.17 load, and come back to the byte.
#include "common/world/traffic_map/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"
#include "tests/names.hpp"

namespace rodeira::traffic_map {
namespace {

using testing::HasSubstr;

MapFile Read(const std::string& bytes) {
  auto map = ParseMap(bytes, "x.motors");
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().Text());
  return map.ok() ? std::move(map).value() : MapFile{};
}

std::string Refused(const std::string& bytes) {
  const auto map = ParseMap(bytes, "x.motors");
  EXPECT_FALSE(map.ok());
  if (map.ok()) return "";
  EXPECT_EQ(map.error().exit_status(), 2);
  return map.error().Text();
}

std::string With(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

// Lines as A.16 takes them apart (split at commas, the first field is the letter), the picture as A.17 finds it:
// everything from two bytes behind the first byte 0x69.
std::string PictureAsA17(const std::string& bytes) { return bytes.substr(bytes.find('\x69') + 2); }

TEST(MapFile, Figure18IsReadAsPrinted) {
  const MapFile map = Read(Figure18());
  ASSERT_EQ(map.curves.size(), 12u);
  EXPECT_EQ(map.curves[0].value.id, 1);
  EXPECT_EQ(map.curves[0].value.points[0], (ControlPoint{63.5616f, 14.70026f, 2.129805f}));
  EXPECT_EQ(map.curves[11].value.id, 15);
  EXPECT_EQ(map.curves[11].value.points[0], (ControlPoint{10.66854f, 14.70026f, -18.65211f}));
  EXPECT_EQ(map.curves[11].value.points[3], (ControlPoint{10.66854f, 14.70026f, -80.125f}));
  ASSERT_EQ(map.lanes.size(), 6u);
  EXPECT_EQ(map.lanes[0].value,
            (Lane{1, {1, false, BorderType::kBoundary}, {2, false, BorderType::kDashedSame}, LaneMode::kStart}));
  EXPECT_EQ(map.lanes[3].value, (Lane{4, {5, true, BorderType::kNone}, {6, true, BorderType::kNone}, LaneMode::kNone}));
  EXPECT_EQ(map.lanes[5].value,
            (Lane{8, {15, false, BorderType::kBoundary}, {14, false, BorderType::kBoundary}, LaneMode::kEnd}));
  ASSERT_EQ(map.connections.size(), 4u);
  EXPECT_EQ(map.connections[0].value, (Connection{1, 4, false, {0.0f, 0.0f, 0.0f}}));
  EXPECT_EQ(map.connections[3].value, (Connection{6, 3, false, {0.0f, 0.0f, 0.0f}}));
  EXPECT_EQ(map.scale.value.value, 10.0f);
  EXPECT_EQ(map.picture, kPng2x1);
  EXPECT_EQ(map.lanes[5].number, 18u);
}

TEST(MapFile, AppendixA15HasFourFieldsAConnection) {
  const MapFile map = Read(AppendixA15());
  ASSERT_EQ(map.connections.size(), 4u);
  EXPECT_EQ(map.connections[1].value, (Connection{2, 4, true, {}}));
}

TEST(MapFile, UneditedComesBackToTheByte) {
  const std::string odd =
      "s,7.50\r\nc,3,4,True\np,-7,1e0,0.50,-0,1E+02,1,1,2,2,2,3,3,3\r\nl,9,-7,True,7,8,False,0,2\nc,3,5,False,1,2.50,"
      "3\np,8,1,1,"
      "1,2,2,2,3,3,3,4,4,4\ni\n";
  for (const std::string& bytes :
       {Figure18(), AppendixA15(), GoodMap(), odd, odd + "i\ni\n", odd + std::string(3, '\0') + "\xff\xd8\xff\r\ni"}) {
    EXPECT_EQ(WriteMap(Read(bytes)), bytes);
  }
}

TEST(MapFile, OnlyEditedLinesChange) {
  const std::string bytes = With(With(Figure18(), "l,1,1", "l,01,1"), "s,10", "s,10.0");
  MapFile map = Read(bytes);
  map.curves[1].value.points[2].x_m = 0.1f;
  map.connections[0].value.stop = true;
  EXPECT_EQ(WriteMap(map),
            With(With(bytes, "34.5,14.70026,5.7", "0.1,14.70026,5.7"), "c,1,4,False,0,0,0", "c,1,4,True,0,0,0"));
  map = Read(AppendixA15());
  map.connections[0].value.to = 8;  // written anew: as figure 18 has it
  map.scale.value.value = 12.5f;
  EXPECT_EQ(WriteMap(map), With(With(AppendixA15(), "c,1,4,False\n", "c,1,8,False,0,0,0\n"), "s,10\n", "s,12.5\n"));
}

TEST(MapFile, NewLinesStandBehindTheirKind) {
  MapFile map = Read(GoodMap());
  map.curves.push_back(
      {{7, {ControlPoint{1.0f, 2.0f, 3.0f}, {100000.0f, 1e-7f, -0.25f}, {}, {16777216.0f / 64.0f, 1e6f, -1e6f}}},
       "",
       0});
  map.connections.push_back({{2, 3, false, {}}, "", 0});
  map.lanes.erase(map.lanes.begin() + 1);
  const std::string expected =
      With(With(With(GoodMap(), "l,1,1", "p,7,1,2,3,100000,1e-07,-0.25,0,0,0,262144,1000000,-1000000\nl,1,1"), "s,10",
                "c,2,3,False,0,0,0\ns,10"),
           "l,2,3,True,3,4,False,1,2\n", "");
  EXPECT_EQ(WriteMap(map), expected);
  const MapFile again = Read(expected);
  EXPECT_EQ(again.curves.back().value, map.curves.back().value);
}

TEST(MapFile, EveryLineWrittenAnewReadsTheSame) {
  const MapFile map = Read(Figure18());
  MapFile bare = map;
  for (auto& line : bare.curves) line.text.clear(), line.number = 0;
  for (auto& line : bare.lanes) line.text.clear(), line.number = 0;
  for (auto& line : bare.connections) line.text.clear(), line.number = 0;
  bare.scale.text.clear(), bare.scale.number = 0;
  EXPECT_EQ(WriteMap(bare), Figure18());  // figure 18's own numbers are the shortest ones
}

TEST(MapFile, TheOriginalProgramFindsThePicture) {
  MapFile map = Read(Figure18());
  EXPECT_EQ(PictureAsA17(WriteMap(map)), kPng2x1);
  map.curves.push_back({{7, {ControlPoint{1e-12f, -1e-30f, 3.0f}}}, "", 0});
  map.connections.push_back({{2, 3, true, {}}, "", 0});
  EXPECT_EQ(PictureAsA17(WriteMap(map)), kPng2x1);
}

TEST(MapFile, SavedAndLoaded) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("rodeira-map-" + std::to_string(::getpid()) + ".motors");
  ASSERT_TRUE(SaveMap(Read(Figure18()), path).ok());
  const auto again = LoadMap(path);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(WriteMap(again.value()), Figure18());
  EXPECT_EQ(base::ReadText(path).value(), Figure18());
  std::filesystem::remove(path);
  EXPECT_THAT(LoadMap(path).error().Text(), HasSubstr("there is no such file"));
}

// A picture of 300 MB behind the lines is not even read.
TEST(MapFile, AHugeFileIsRefused) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("huge-" + std::to_string(::getpid()) + ".motors");
  ASSERT_TRUE(base::WriteWhole(path, GoodMap()).ok());
  std::filesystem::resize_file(path, 300'000'000);  // a hole: no disk is used
  const auto map = LoadMap(path);
  std::filesystem::remove(path);
  ASSERT_FALSE(map.ok());
  EXPECT_EQ(map.error().exit_status(), 2);
  EXPECT_THAT(map.error().Text(), testing::AllOf(HasSubstr(path.string()), HasSubstr("268435456")));
}

TEST(MapFile, WhatIsWrongIsSaid) {
  const std::string good = GoodMap();
  EXPECT_THAT(Refused(""), HasSubstr("x.motors: the file ends at byte 0 without a line 'i'"));
  EXPECT_THAT(Refused(good.substr(0, 100)), HasSubstr("ends at byte 100"));
  EXPECT_THAT(Refused(good.substr(0, good.size() - 1)), HasSubstr("without a line 'i'"));
  EXPECT_THAT(Refused(With(good, "l,1", "k,1")), HasSubstr("x.motors:7: the line begins with 'k'"));
  EXPECT_THAT(Refused(With(good, "l,1", "L,1")), HasSubstr("in small letters"));
  EXPECT_THAT(Refused(With(good, "s,10\n", "")), HasSubstr("no line 's'"));
  EXPECT_THAT(Refused(With(good, "s,10\n", "s,10\ns,5\n")),
              HasSubstr("x.motors:13: a second line 's'; the first is line 12"));
  EXPECT_THAT(Refused(With(good, "s,10\n", "\n")), HasSubstr("x.motors:12: the line begins with ''"));
  EXPECT_THAT(Refused(With(good, "i\n", "i\r\n")), HasSubstr("'i' alone was expected"));
  EXPECT_THAT(Refused(With(good, "c,1,2,False,0,0,0", "c,1,2,False,0")),
              HasSubstr("a line 'c' with 5 fields; expected are 4 or 7"));
  EXPECT_THAT(Refused(With(good, "c,1,2,False,0,0,0", "c,1,2,false,0,0,0")),
              HasSubstr("x.motors:10: the STOP flag is 'false'; True or False was expected"));
  EXPECT_THAT(Refused(With(good, "l,1,1,False,3", "l,1,1,False,8")),
              Names("the left border's type is '8'; … from 0 to 7"));
  EXPECT_THAT(Refused(With(good, "2,False,1,1\n", "2,False,1,3\n")), HasSubstr("mode (none, start, end) is '3'"));
  EXPECT_THAT(Refused(With(good, "l,1,", "l,2147483648,")), HasSubstr("the lane's number is '2147483648'"));
  EXPECT_THAT(Refused(With(good, "20,1,1.5", "nan,1,1.5")),
              HasSubstr("x.motors:1: x of point 2 is 'nan'; a number with a decimal point from -1000000 to 1000000"));
  EXPECT_THAT(Refused(With(good, "20,1,1.5", "20,1,1e7")), HasSubstr("z of point 2 is '1e7'"));
  EXPECT_THAT(Refused(With(good, "p,1,0,1,1.5,10,1,1.5,20,1,1.5,30,1,1.5",
                           "p,1,0,0,1,0,1,5,10,0,1,0,1,5,20,0,1,0,1,5,30,0,1,0,1,5")),
              HasSubstr("decimal comma?"));
  EXPECT_THAT(Refused(With(good, "s,10", "s,0")), HasSubstr("the picture's scale is '0'"));
  EXPECT_THAT(Refused(With(good, "s,10", "s," + std::string(2000, '1'))),
              HasSubstr("x.motors:12: the line has more than 1000 bytes"));
  std::string many;
  for (std::size_t i = 0; i <= kMaxLines; ++i) many += "c,1,2,True\n";
  EXPECT_THAT(Refused(many), HasSubstr("more than 100000 lines"));
}

}  // namespace
}  // namespace rodeira::traffic_map
