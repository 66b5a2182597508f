// SPDX-License-Identifier: Apache-2.0
// Files of MATLAB and long tables. SciPy and Octave read such files in tests/python/test_tables.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/data/csv/export.hpp"
#include "common/data/csv/mat_file.hpp"
#include "common/data/csv/mat_table.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::csv {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MatTest : public ::testing::Test {
 protected:
  MatTest() { fs::create_directories(folder_); }
  ~MatTest() override { fs::remove_all(folder_); }
  fs::path Out(const char* name) const { return folder_ / name; }
  // Three agents at one time, and a mark.
  record::McapReader Recording() {
    record::McapWriter writer =
        record::McapWriter::Open(std::make_unique<record::MemorySink>(&bytes_), record::WriterSettings()).value();
    const auto* info = idl::FindTopic(idl::topics::kTrafficState);
    const auto schema = writer.AddSchema(info->type, "omgidl", idl::IdlTextOf(info->subject)).value();
    const auto channel = writer.AddChannel(info->topic, schema, "cdr", {{"source", "traffic"}}).value();
    msg::TrafficState state;
    state.agents().resize(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
      state.agents()[i].id(i + 7);
      state.agents()[i].speed_mps(0.5 * i);
    }
    state.header().time_ns(1'500'000'000);
    EXPECT_TRUE(writer.Write(channel, 0, 1'500'000'000, 1'500'000'000, idl::Encode(state)).ok());
    EXPECT_TRUE(writer.Close().ok());
    return record::McapReader::OpenBytes(bytes_).value();
  }
  Selection Speeds() const {
    Selection selection;
    selection.columns = {"agents.id", "agents.speed_mps"};
    return selection;
  }

  base::Bytes bytes_;
  const fs::path folder_ = fs::temp_directory_path() / ("rodeira-mat-" + std::to_string(::getpid()));
};

TEST_F(MatTest, NamesAreThoseOfMatlab) {
  std::set<std::string> taken;
  EXPECT_EQ(MatName("position_w_m.x", taken), "position_w_m_x");
  EXPECT_EQ(MatName("wheels[2].load_n", taken), "wheels_2_load_n");
  EXPECT_EQ(MatName("wheels.2.load_n", taken), "wheels_2_load_n_2") << "each field has its own name";
  EXPECT_EQ(MatName("2nd", taken), "x2nd");
  EXPECT_EQ(MatName("..", taken), "x");
  EXPECT_EQ(MatName(std::string(100, 'a'), taken), std::string(63, 'a'));
  EXPECT_EQ(MatName(std::string(100, 'a'), taken), std::string(61, 'a') + "_2");
}

// The header and the first elements, byte by byte as the format's description has them.
TEST_F(MatTest, BytesAreThoseOfTheFormat) {
  auto file = MatFile::Create(Out("a.mat"));
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(file.value().Add({"t", {{"time_s", std::vector<double>{0.5, 1.5}}}}).ok());
  ASSERT_TRUE(file.value().Close().ok());
  const std::string text = base::ReadText(Out("a.mat")).value();
  EXPECT_EQ(file.value().written_bytes(), text.size());
  EXPECT_EQ(text.size() % 8, 0u);
  EXPECT_TRUE(text.starts_with("MATLAB 5.0 MAT-file"));
  EXPECT_EQ(text.substr(124, 4), std::string("\0\1IM", 4)) << "version 0x0100, little-endian";
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, text.data() + at, 4);
    return value;
  };
  EXPECT_EQ(number(128), 14u) << "miMATRIX";
  EXPECT_EQ(number(132), text.size() - 136) << "the one variable fills the file";
  EXPECT_EQ(number(136), 6u) << "miUINT32: flags";
  EXPECT_EQ(number(144), 2u) << "mxSTRUCT_CLASS";
  EXPECT_EQ(number(text.size() - 24), 9u) << "miDOUBLE";
  EXPECT_EQ(number(text.size() - 20), 16u) << "two numbers";
  double last = 0.0;
  std::memcpy(&last, text.data() + text.size() - 8, 8);
  EXPECT_EQ(last, 1.5);
}

TEST_F(MatTest, AVariableAboveTwoGigabytesIsRefused) {
  // Two texts stand for two million rows: little memory here, 2.2 GB in the file.
  PlainTable table{"big", {}};
  TextColumn texts;
  const std::string long_text(1000, 'x');
  for (int row = 0; row < 2'000'000; ++row) texts.Add(row % 2 == 0 ? std::string_view(long_text) : "y");
  table.columns.push_back({"words", texts});
  table.columns.push_back({"more", std::move(texts)});
  auto file = MatFile::Create(Out("a.mat"));
  ASSERT_TRUE(file.ok());
  const auto status = file.value().Add(table);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "table.too_large");
  EXPECT_EQ(status.error().context, "big");
  EXPECT_EQ(status.error().exit_status(), 2);
}

// Columns that lie in the spill file are written as the table in memory is, byte by byte: numbers, whole numbers, one
// text for all rows, different texts, and no rows at all.
TEST_F(MatTest, SpilledColumnsAreTheSameBytes) {
  using Kind = SpilledColumn::Kind;
  for (const std::uint64_t rows : {0, 1, 2, 30'000}) {
    auto spill = SpillFile::Create(folder_);
    ASSERT_TRUE(spill.ok());
    EXPECT_TRUE(fs::is_empty(folder_)) << "it has no name";
    std::vector<SpilledColumn> columns;
    columns.emplace_back("time_s", Kind::kNumbers);
    columns.emplace_back("source", Kind::kTexts);
    columns.emplace_back("word", Kind::kTexts);
    columns.emplace_back("late", Kind::kTexts);
    columns.emplace_back("state_digest", Kind::kWhole);
    std::vector<double> time;
    std::vector<std::uint64_t> digest;
    TextColumn source, word, late;
    for (std::uint64_t row = 0; row < rows; ++row) {
      time.push_back(0.001 * static_cast<double>(row));
      digest.push_back(row * 0x9e3779b97f4a7c15);
      source.Add("ego");
      word.Add(std::string(row % 13, 'a'));
      late.Add(row < 20'000 ? "first" : "second");
      ASSERT_TRUE(columns[0].Add(time.back(), spill.value()).ok());
      ASSERT_TRUE(columns[1].Add(source[row], spill.value()).ok());
      ASSERT_TRUE(columns[2].Add(word[row], spill.value()).ok());
      ASSERT_TRUE(columns[3].Add(late[row], spill.value()).ok());
      ASSERT_TRUE(columns[4].Add(digest.back(), spill.value()).ok());
    }
    const PlainTable whole{
        "t", {{"time_s", time}, {"source", source}, {"word", word}, {"late", late}, {"state_digest", digest}}};
    auto plain = MatFile::Create(Out("plain.mat")), spilled = MatFile::Create(Out("spilled.mat"));
    ASSERT_TRUE(plain.ok() && spilled.ok());
    ASSERT_TRUE(plain.value().Add(whole).ok());
    ASSERT_TRUE(spilled.value().Add("t", columns, spill.value()).ok());
    ASSERT_TRUE(plain.value().Close().ok() && spilled.value().Close().ok());
    EXPECT_EQ(base::ReadText(Out("plain.mat")).value(), base::ReadText(Out("spilled.mat")).value()) << rows;
    fs::remove(Out("plain.mat"));
    fs::remove(Out("spilled.mat"));
  }
}

// A column's memory does not grow with its rows: 4 MB of numbers, 20 MB of texts.
TEST_F(MatTest, MemoryIsBoundedByAPartOfAColumn) {
  using Kind = SpilledColumn::Kind;
  auto spill = SpillFile::Create(folder_);
  ASSERT_TRUE(spill.ok());
  SpilledColumn numbers("x", Kind::kNumbers), words("word", Kind::kTexts);
  std::size_t most = 0;
  for (int row = 0; row < 500'000; ++row) {
    ASSERT_TRUE(numbers.Add(0.5 * row, spill.value()).ok());
    if (row % 10 == 0) {
      ASSERT_TRUE(words.Add(std::string(300, row % 20 == 0 ? 'a' : 'b'), spill.value()).ok());
    }
    most = std::max({most, numbers.bytes_in_memory(), words.bytes_in_memory()});
  }
  EXPECT_EQ(numbers.bytes(), 4'000'000u);
  EXPECT_GT(words.bytes(), 15'000'000u);
  // The part, what its buffer has room for beyond it, and the list of the pieces.
  EXPECT_LT(most, 2 * SpilledColumn::kPartBytes + 100'000);
  EXPECT_GT(most, SpilledColumn::kPartBytes / 2);
}

TEST_F(MatTest, RowsOfASequenceBecomeColumns) {
  const auto reader = Recording();
  const PlainTable marks{"marks", {{"time_s", std::vector<double>{2.0}}, {"name", TextColumn{{"x"}, {0}, {{"x", 0}}}}}};
  const auto report = ExportTables(reader, {ExportTarget::Form::kMat, Out("a.mat")}, {}, {}, Speeds(), {&marks, 1});
  ASSERT_TRUE(report.ok()) << report.error().Text();
  ASSERT_EQ(report.value().tables.size(), 2u);
  EXPECT_EQ(report.value().tables[0].file, "traffic_state");
  EXPECT_EQ(report.value().tables[0].rows, 3u);
  EXPECT_TRUE(fs::is_regular_file(Out("a.mat")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "nothing else is left";
  const auto again = ExportTables(reader, {ExportTarget::Form::kMat, Out("a.mat")}, {}, {}, Speeds(), {});
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().id.text(), "file.exists");
}

TEST_F(MatTest, ALongTableHasALineAValue) {
  const auto reader = Recording();
  const PlainTable derived{
      "derived", {{"time_s", std::vector<double>{0.0, 0.01}}, {"gap_m", std::vector<double>{std::nan(""), 12.5}}}};
  const auto report = ExportTables(reader, {ExportTarget::Form::kLong, Out("long")}, {}, {}, Speeds(), {&derived, 1});
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_EQ(base::ReadText(Out("long") / "traffic_state.csv").value(),
            "time_s,step,source,row,column,value\n"
            "1.5,0,traffic,0,agents.id,7\n"
            "1.5,0,traffic,0,agents.speed_mps,0\n"
            "1.5,0,traffic,1,agents.id,8\n"
            "1.5,0,traffic,1,agents.speed_mps,0.5\n"
            "1.5,0,traffic,2,agents.id,9\n"
            "1.5,0,traffic,2,agents.speed_mps,1\n");
  EXPECT_EQ(base::ReadText(Out("long") / "derived.csv").value(), "time_s,column,value\n0.01,gap_m,12.5\n");
}

TEST_F(MatTest, ATableInMemoryIsALineARow) {
  const auto reader = Recording();
  const PlainTable derived{
      "derived", {{"time_s", std::vector<double>{0.0, 0.01}}, {"gap_m", std::vector<double>{std::nan(""), 12.5}}}};
  ASSERT_TRUE(ExportTables(reader, {ExportTarget::Form::kWide, Out("wide")}, {}, {}, Speeds(), {&derived, 1}).ok());
  EXPECT_EQ(base::ReadText(Out("wide") / "derived.csv").value(), "time_s,gap_m\n0,\n0.01,12.5\n");
}

}  // namespace
}  // namespace rodeira::csv
