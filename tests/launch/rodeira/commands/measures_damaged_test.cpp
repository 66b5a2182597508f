// SPDX-License-Identifier: Apache-2.0
// `rodeira measures` on recordings with another world, a hole, names of before, and damaged files.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "tests/launch/rodeira/commands/measures_fixture.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

// A recording that says another world than it embeds, and one with a hole.
TEST_F(MeasuresCommand, AnotherWorldAndAHole) {
  const std::string drive = Drive(2.0);
  MeasuresOptions options;
  options.recordings = {Copied(
      drive,
      [](const std::string& name, record::TextMap& entries) {
        if (name == "rodeira") entries["world_hash"] = "0123456789abcdef";
      },
      [](const std::string&, const record::Message&, base::Bytes&) { return true; })};
  const Said other = Of(options);
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.errors, HasSubstr("the recording says world_hash 0123456789abcdef"));

  std::uint64_t seen = 0;
  options.recordings = {Copied(
      drive, [](const std::string&, record::TextMap&) {},
      [&](const std::string& topic, const record::Message&, base::Bytes&) {
        return topic != idl::topics::kVehicleState || ++seen < 500 || seen > 1000;
      })};
  options.out = Path("hole.csv");
  options.long_format = true;
  ASSERT_EQ(Of(options).status, 0);
  for (const auto& row : Rows(ReadBack("hole.csv"))) {
    if (row.at("measure") != "throttle_mean") continue;
    EXPECT_NEAR(std::stod(row.at("valid_share")), 0.75, 0.01) << "half a second of two is missing";
  }
}

// Names of before in the recording's IDL, and no embedded world: the first is read, the second a sentence.
TEST_F(MeasuresCommand, AVersionBeforeAndAWorldThatDoesNotLoad) {
  const std::string drive = Drive(2.0);
  const std::string before = Path("before.mcap");
  const auto all = [](const std::string&, const record::Message&, base::Bytes&) { return true; };
  CopyRecording(
      drive, before, [](const std::string&, record::TextMap&) {}, all, [](const std::string&) { return true; }, {},
      [](const std::string&, std::string& idl) {
        for (const auto& [now, then] : {std::pair("SampleHeader", "Header"), std::pair("fuel_used_kg", "fuel_kg")}) {
          for (auto at = idl.find(now); at != std::string::npos; at = idl.find(now)) idl.replace(at, strlen(now), then);
        }
      });
  const auto table = [&](const std::string& file) {
    MeasuresOptions options;
    options.recordings = {file};
    options.out = Path("table.csv");
    const Said said = Of(options);
    EXPECT_EQ(said.status, 0) << said.errors;
    auto row = Rows(ReadBack("table.csv")).at(0);
    row.erase("file");
    return row;
  };
  EXPECT_EQ(table(before), table(drive));

  MeasuresOptions options;
  options.recordings = {Copied(
      drive, [](const std::string&, record::TextMap&) {}, all,
      [](const std::string& name) { return name.find("worlds/") == std::string::npos; })};
  const Said none = Of(options);
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(std::count(none.errors.begin(), none.errors.end(), '\n'), 1) << none.errors;
  EXPECT_THAT(none.errors, HasSubstr("worlds/"));
}

// An embedded world with a wrong key, one that is no YAML, and one with bytes that do not unpack.
TEST_F(MeasuresCommand, AnEmbeddedWorldThatIsDamaged) {
  const std::string drive = Drive(2.0);
  struct Damage {
    std::string text, media_type, said;
  };
  for (const Damage& damage :
       {Damage{"rodeira: world/2\nrods: []\n", "application/octet-stream", "plane.yaml:1: key 'name'"},
        Damage{"rodeira: [world/2", "application/octet-stream", "plane.yaml:1: this is no YAML"},
        Damage{"no archive", "application/x-rodeira-zstd", "worlds/"}}) {
    SCOPED_TRACE(damage.text);
    const std::string copy = Path("damaged.mcap");
    int worlds = 0;
    CopyRecording(
        drive, copy, [](const std::string&, record::TextMap&) {},
        [](const std::string&, const record::Message&, base::Bytes&) { return true; },
        [](const std::string&) { return true; }, {}, [](const std::string&, std::string&) {},
        [&](const std::string& name, std::string& media_type, base::Bytes& data) {
          if (name.find("worlds/") == std::string::npos) return;
          ++worlds;
          media_type = damage.media_type;
          const auto bytes = std::as_bytes(std::span(damage.text));
          data.assign(bytes.begin(), bytes.end());
        });
    ASSERT_GE(worlds, 1);
    MeasuresOptions options;
    options.recordings = {copy};
    const Said said = Of(options);
    EXPECT_EQ(said.status, 2);
    EXPECT_EQ(std::count(said.errors.begin(), said.errors.end(), '\n'), 1) << said.errors;
    EXPECT_THAT(said.errors, HasSubstr("damaged.mcap"));
    EXPECT_THAT(said.errors, HasSubstr(damage.said));
  }
}

}  // namespace
}  // namespace rodeira::cli
