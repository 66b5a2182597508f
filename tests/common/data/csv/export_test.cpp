// SPDX-License-Identifier: Apache-2.0
// Tables against the messages that were recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/data/csv/export.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/names.hpp"

namespace rodeira::csv {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ExportTest : public ::testing::Test {
 protected:
  ExportTest() { fs::create_directories(folder_); }
  ~ExportTest() override { fs::remove_all(folder_); }

  // A writer into memory, with a channel for a topic of the project.
  struct Recording {
    base::Bytes bytes;
    record::McapWriter writer;
    explicit Recording(record::WriterSettings settings = {})
        : writer(record::McapWriter::Open(std::make_unique<record::MemorySink>(&bytes), settings).value()) {}
    record::ChannelId Channel(std::string_view topic, const std::string& source) {
      const auto* info = idl::FindTopic(topic);
      const auto schema = writer.AddSchema(info->type, "omgidl", idl::IdlTextOf(info->subject)).value();
      return writer.AddChannel(topic, schema, "cdr", {{"source", source}}).value();
    }
    template <class Message>
    void Put(record::ChannelId channel, Message message, std::int64_t step) {
      message.header().step(step);
      message.header().time_ns(step * 1'000'001);
      message.header().state_digest(0xabcdefull + static_cast<std::uint64_t>(step));
      const auto time = static_cast<std::uint64_t>(step * 1'000'001);
      EXPECT_TRUE(writer.Write(channel, 0, time, time, idl::Encode(message)).ok());
    }
    record::McapReader Reader() {
      EXPECT_TRUE(writer.Close().ok());
      return record::McapReader::OpenBytes(bytes).value();
    }
  };
  fs::path Out() const { return folder_ / "tables"; }
  std::string Table(const std::string& name) const { return base::ReadText(Out() / name).value(); }
  std::size_t Left() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("rodeira-csv-" + std::to_string(::getpid()));
};

std::vector<std::vector<std::string>> Cells(const std::string& table) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST_F(ExportTest, ControlsOfTwoSourcesInOneTable) {
  Recording recording;
  const auto a = recording.Channel(idl::topics::kControls, "driver");
  const auto b = recording.Channel(idl::topics::kControls, "other, one");
  msg::Controls controls;
  controls.steering_wheel_rad(-0.1);
  controls.throttle(1.0 / 3.0);
  controls.gear(-1);
  controls.indicators(2);
  recording.Put(a, controls, 0);
  recording.Put(b, controls, 1500);
  const auto reader = recording.Reader();
  const auto report = ExportCsv(reader, Out());
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_EQ(Table("controls.csv"),
            "time_s,step,source,steering_wheel_rad,throttle,brake,clutch,handbrake,gear,gearbox_mode,starter,"
            "indicators,headlights,horn,state_digest\n"
            "0,0,driver,-0.1,0.3333333333333333,0,0,0,-1,0,0,2,0,0,0000000000abcdef\n"
            "1.5000015,1500,\"other, one\",-0.1,0.3333333333333333,0,0,0,-1,0,0,2,0,0,0000000000abd3cb\n");
  ASSERT_EQ(report.value().tables.size(), 1u);
  EXPECT_EQ(report.value().tables[0].messages, 2u);
  EXPECT_EQ(report.value().tables[0].rows, 2u);
  EXPECT_EQ(report.value().tables[0].bytes, fs::file_size(Out() / "controls.csv"));
  EXPECT_TRUE(report.value().losses.empty());
}

TEST_F(ExportTest, TrafficIsOneRowAnAgentAndEventsOneRowAnEvent) {
  Recording recording;
  const auto traffic = recording.Channel(idl::topics::kTrafficState, "traffic");
  const auto story = recording.Channel(idl::topics::kScenarioEvents, "story");
  msg::TrafficState state;
  recording.Put(traffic, state, 0);  // no vehicle: no row
  state.agents().resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    state.agents()[i].id(i + 7);
    state.agents()[i].speed_mps(0.5 * i);
  }
  recording.Put(traffic, state, 10);
  msg::ScenarioEvents events;
  recording.Put(story, events, 0);
  events.events().resize(1);
  events.events()[0].name("mark");
  events.events()[0].argument("he said \"go\",\nand went");
  recording.Put(story, events, 10);
  const auto reader = recording.Reader();
  ASSERT_TRUE(ExportCsv(reader, Out()).ok());
  const auto rows = Cells(Table("traffic_state.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0][3], "agents.id");
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i][0], "0.01000001");
    EXPECT_EQ(rows[i][1], "10");
    EXPECT_EQ(rows[i][3], std::to_string(6 + i));
    const auto speed = std::find(rows[0].begin(), rows[0].end(), "agents.speed_mps") - rows[0].begin();
    EXPECT_EQ(rows[i][static_cast<std::size_t>(speed)], i == 1 ? "0" : i == 2 ? "0.5" : "1");
  }
  EXPECT_EQ(Table("scenario_events.csv"),
            "time_s,step,source,events.name,events.argument,events.value,events.index,state_digest\n"
            "0.01000001,10,story,mark,\"he said \"\"go\"\",\nand went\",0,0,0000000000abcdf9\n");
}

// Every number of a table reads back to the recorded bits.
TEST_F(ExportTest, VehicleStatesReadBackToTheBit) {
  Recording recording;
  const auto ego = recording.Channel(idl::topics::kVehicleState, "ego");
  const std::vector<double> values = {
      0.1, 1e-300, -123456.789012345678, 5e-324, 1.7976931348623157e308, 0.30000000000000004};
  const std::vector<float> singles = {0.1F, 1e-38F, -123456.789F, 1e-45F, 3.4028235e38F, 0.30000001F};
  for (std::size_t i = 0; i < values.size(); ++i) {
    msg::VehicleState state;
    state.position_w_m().y(values[i]);
    state.velocity_w_mps().z(-values[i]);
    state.wheels()[2].contact_normal_w().z(singles[i]);
    recording.Put(ego, state, static_cast<std::int64_t>(i));
  }
  const auto reader = recording.Reader();
  ASSERT_TRUE(ExportCsv(reader, Out()).ok());
  const auto rows = Cells(Table("vehicle_state.csv"));
  ASSERT_EQ(rows.size(), values.size() + 1);
  const auto column = [&](const std::string& name) {
    const auto found = std::find(rows[0].begin(), rows[0].end(), name);
    EXPECT_NE(found, rows[0].end()) << name;
    return static_cast<std::size_t>(found - rows[0].begin());
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(std::strtod(rows[i + 1][column("position_w_m.y")].c_str(), nullptr), values[i]);
    EXPECT_EQ(std::strtod(rows[i + 1][column("velocity_w_mps.z")].c_str(), nullptr), -values[i]);
    EXPECT_EQ(std::strtof(rows[i + 1][column("wheels[2].contact_normal_w.z")].c_str(), nullptr), singles[i]);
  }
}

TEST_F(ExportTest, ForeignTypesListsAndClashingNames) {
  Recording recording;
  const char* idl =
      "struct P { double x; string s; }; struct A { sequence<double> v; sequence<P> a; sequence<P> b; octet raw[2]; };";
  const auto schema = recording.writer.AddSchema("A", "omgidl", idl).value();
  const auto plain = recording.writer.AddSchema("X", "jsonschema", "{}").value();
  const auto one = recording.writer.AddChannel("a/b", schema, "cdr").value();
  const auto two = recording.writer.AddChannel("a_b", schema, "cdr").value();
  const auto json = recording.writer.AddChannel("text", plain, "json").value();
  base::ByteWriter out;
  for (const std::uint8_t byte : {0, 1, 0, 0}) out.Put(byte);
  out.Put(std::uint32_t{2}), out.Put(std::uint32_t{0}), out.Put(1.5), out.Put(-2.0);  // v
  out.Put(std::uint32_t{1}), out.Put(std::uint32_t{0}), out.Put(0.25);                // a
  out.Put(std::uint32_t{5}), out.PutRaw(std::as_bytes(std::span("a\";b", 5)));
  for (int i = 0; i < 3; ++i) out.Put(std::uint8_t{0});
  out.Put(std::uint32_t{0});  // b
  out.Put(std::uint8_t{1}), out.Put(std::uint8_t{0xfe});
  for (const auto channel : {one, two})
    ASSERT_TRUE(recording.writer.Write(channel, 0, 2'500'000'000, 0, out.bytes()).ok());
  ASSERT_TRUE(recording.writer.Write(json, 0, 0, 0, out.bytes()).ok());
  const auto reader = recording.Reader();
  const auto report = ExportCsv(reader, Out());
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_EQ(Table("a_b.csv"),
            "time_s,source,v,a,b,raw\n2.5,channel 1,1.5; -2,\"[0].x=0.25; [0].s=\"\"a\\\"\";b\"\"\",,01fe\n");
  EXPECT_TRUE(fs::exists(Out() / "a_b_2.csv"));
  EXPECT_EQ(report.value().left_out, std::vector<std::string>{"text: its messages are not CDR with an IDL schema"});
}

TEST_F(ExportTest, AFolderThatIsThereIsRefusedAndStaysAsItIs) {
  Recording recording;
  recording.Put(recording.Channel(idl::topics::kControls, "driver"), msg::Controls(), 0);
  const auto reader = recording.Reader();
  fs::create_directory(Out());
  const auto report = ExportCsv(reader, Out());
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().exit_status(), 2);
  EXPECT_THAT(report.error().Text(), HasSubstr("the folder for the tables is there already"));
  EXPECT_TRUE(fs::is_empty(Out()));
  EXPECT_EQ(Left(), 1u);
}

TEST_F(ExportTest, NothingIsLeftOfAnExportThatFails) {
  Recording recording;
  const auto channel = recording.Channel(idl::topics::kControls, "driver");
  recording.Put(channel, msg::Controls(), 0);
  base::Bytes bytes = idl::Encode(msg::Controls());
  bytes.resize(50);
  ASSERT_TRUE(recording.writer.Write(channel, 1, 20'000'000, 0, bytes).ok());
  const auto reader = recording.Reader();
  const auto report = ExportCsv(reader, Out());
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().exit_status(), 2);
  EXPECT_THAT(report.error().Text(), rodeira::Names("rodeira/controls of 'driver' at 0.02 s: byte 4: … 46 bytes"));
  EXPECT_EQ(Left(), 0u);
  const auto stopped = ExportCsv(reader, Out(), {}, [](double) { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().exit_status(), 1);
  EXPECT_EQ(Left(), 0u);
  EXPECT_FALSE(ExportCsv(reader, "/proc/no/tables").ok());
}

TEST_F(ExportTest, OfADamagedRecordingTheRestIsWrittenAndTheLossSaid) {
  record::WriterSettings settings;
  settings.chunk_bytes = 4096;
  settings.compression = record::Compression::kNone;
  Recording recording(settings);
  const auto channel = recording.Channel(idl::topics::kControls, "driver");
  for (int step = 0; step < 200; ++step) recording.Put(channel, msg::Controls(), step);
  const auto whole = recording.Reader();
  const auto& chunks = whole.chunks();
  ASSERT_GT(chunks.size(), 5u);
  base::Bytes changed = recording.bytes;
  changed[chunks[3].offset + chunks[3].record_bytes - 3] ^= std::byte{1};
  const auto reader = record::McapReader::OpenBytes(changed);
  const auto report = ExportCsv(reader.value(), Out());
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_EQ(report.value().losses.size(), 1u);
  EXPECT_LT(report.value().tables[0].rows, 200u);
  EXPECT_GT(report.value().tables[0].rows, 100u);
}

}  // namespace
}  // namespace rodeira::csv
