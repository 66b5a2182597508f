// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/data/csv/csv_tables.hpp"
#include "common/data/csv/mat_file.hpp"
#include "common/data/csv/mat_table.hpp"
#include "common/data/csv/workplace.hpp"
#include "common/data/decode/idl_reader.hpp"

namespace rodeira::csv {
namespace {

namespace fs = std::filesystem;

// The states of nodes as named octets: what they mean is known to the nodes alone.
constexpr const char* kSnapshotType = "rodeira::msg::Snapshot";
constexpr std::uint64_t kMessagesBetweenProgress = 4096;

struct Table {
  std::string topic;
  std::string file;
  decode::TypePtr type;
  std::unique_ptr<TableWriter> writer;
};

// "rodeira/vehicle_state" is "vehicle_state"; other characters than letters, digits, '-', '_' and '.' become '_'.
std::string FileName(std::string_view topic, std::set<std::string>& taken) {
  if (topic.starts_with("rodeira/")) topic.remove_prefix(8);
  std::string name(topic.substr(0, 100));
  for (char& c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '-' && c != '.') c = '_';
  }
  if (name.empty() || name[0] == '.') name.insert(0, "_");
  std::string free = name;
  for (int number = 2; !taken.insert(free).second; ++number) free = fmt::format("{}_{}", name, number);
  return free;
}

class Exporter {
 public:
  Exporter(const record::McapReader& reader, const ExportTarget& target, const decode::Aliases& aliases,
           const ExportProgress& progress, const Selection& selection)
      : reader_(reader),
        form_(target.form),
        aliases_(aliases),
        progress_(progress),
        selection_(selection),
        workplace_(target.path) {}

  base::Result<ExportReport> Run(std::span<const PlainTable> more) {
    const auto times = TimesOf(selection_, reader_);
    if (!times) return times.error();
    if (auto status = workplace_.Begin(); !status) return status.error();
    if (form_ == Form::kMat) {
      auto spill = SpillFile::Create(workplace_.path());
      if (!spill) return spill.error();
      spill_.emplace(std::move(spill).value());
    }
    report_.losses = reader_.condition().findings;
    for (const auto& [id, channel] : reader_.channels()) {
      if (auto status = Open(channel); !status) return status.error();
    }
    if (auto status = CheckNames(); !status) return status.error();
    if (auto status = Copy(times.value()); !status) return status.error();
    if (auto status = form_ == Form::kMat ? WriteMat(more) : WriteCsv(more); !status) return status.error();
    return std::move(report_);
  }

 private:
  using Form = ExportTarget::Form;
  static constexpr const char* kMatName = "tables.mat";

  base::Status WriteCsv(std::span<const PlainTable> more) {
    for (const auto& table : tables_) {
      if (auto status = table->writer->Close(); !status) return status;
      const TableWriter& writer = *table->writer;
      report_.tables.push_back({table->topic, table->file, writer.messages(), writer.rows(), writer.written_bytes()});
    }
    for (const PlainTable& table : more) {
      const std::string name = FileName(table.name, names_) + ".csv";
      auto file = CsvFile::Create(workplace_.path() / name);
      if (!file) return file.error();
      const auto rows = WritePlainTable(table, form_ == Form::kLong, file.value());
      if (!rows) return rows.error();
      if (auto status = file.value().Close(); !status) return status;
      report_.tables.push_back({"", name, table.rows(), rows.value(), file.value().written_bytes()});
    }
    return workplace_.Finish();
  }

  base::Status WriteMat(std::span<const PlainTable> more) {
    auto file = MatFile::Create(workplace_.path() / kMatName);
    if (!file) return file.error();
    for (const auto& table : tables_) {
      const auto& writer = dynamic_cast<const MatTable&>(*table->writer);
      if (auto status = writer.AddTo(file.value()); !status) return status;
      report_.tables.push_back({table->topic, table->file, writer.messages(), writer.rows(), writer.written_bytes()});
    }
    for (const PlainTable& table : more) {
      if (auto status = file.value().Add(table); !status) return status;
      const std::uint64_t bytes = kMatBytesPerNumber * table.rows() * table.columns.size();
      report_.tables.push_back({"", table.name, table.rows(), table.rows(), bytes});
    }
    if (auto status = file.value().Close(); !status) return status;
    return workplace_.Finish(kMatName);
  }

  base::Result<std::unique_ptr<TableWriter>> MakeWriter(const Table& table, Layout layout) {
    if (form_ == Form::kMat)
      return std::unique_ptr<TableWriter>(
          std::make_unique<MatTable>(*table.type, std::move(layout), table.file, *spill_));
    auto file = CsvFile::Create(workplace_.path() / table.file);
    if (!file) return file.error();
    if (form_ == Form::kLong)
      return std::unique_ptr<TableWriter>(
          std::make_unique<LongTable>(*table.type, std::move(layout), std::move(file).value()));
    return std::unique_ptr<TableWriter>(
        std::make_unique<WideTable>(*table.type, std::move(layout), std::move(file).value()));
  }

  // Channels of one topic and schema share a table.
  base::Status Open(const record::Channel& channel) {
    const std::string topic(aliases_.Topic(channel.topic));
    topics_.insert(topic);
    if (!selection_.topics.empty() && !HasTopic(selection_.topics, topic)) return {};
    for (const auto& [key, table] : table_of_) {
      if (key.first == channel.topic && key.second == channel.schema) {
        of_channel_[channel.id] = table;
        return {};
      }
    }
    const auto schema = reader_.schemas().find(channel.schema);
    if (schema == reader_.schemas().end() || schema->second.encoding != "omgidl" || channel.message_encoding != "cdr") {
      LeaveOut(channel.topic, "its messages are not CDR with an IDL schema");
      return {};
    }
    if (schema->second.name == kSnapshotType) {
      LeaveOut(channel.topic, "snapshots are the states of nodes, no measurements");
      return {};
    }
    const auto recorded = decode::ReadType(schema->second.text, schema->second.name);
    if (!recorded) return recorded.error().In(channel.topic);
    const decode::TypePtr type = aliases_.Renamed(recorded.value());
    auto layout = LayoutOf(*type);
    if (!layout) return layout.error().In(channel.topic);
    for (std::string& name : ColumnsOf(layout.value())) columns_.insert(std::move(name));
    if (KeepColumns(selection_.columns, layout.value()) == 0 && !selection_.columns.empty()) return {};
    auto table = std::make_shared<Table>();
    table->topic = topic;
    table->file = FileName(table->topic, names_) + (form_ == Form::kMat ? "" : ".csv");
    table->type = type;
    auto writer = MakeWriter(*table, std::move(layout).value());
    if (!writer) return writer.error();
    table->writer = std::move(writer).value();
    tables_.push_back(table);
    table_of_.emplace_back(std::pair(channel.topic, channel.schema), table);
    of_channel_[channel.id] = table;
    return {};
  }

  // Every name of the selection names something.
  base::Status CheckNames() const {
    for (const std::string& name : selection_.topics) {
      if (std::ranges::any_of(topics_, [&](const auto& topic) { return HasTopic({name}, topic); })) continue;
      std::vector<std::string> known;
      for (const std::string& topic : topics_) known.emplace_back(ShortTopic(topic));
      return base::WrongInput("table.unknown_topic",
                              fmt::format("unknown topic '{}'{}", name, base::DidYouMean(name, known)), "--topics");
    }
    for (const std::string& name : selection_.columns) {
      if (std::ranges::any_of(columns_, [&](const auto& column) { return Names(name, column); })) continue;
      const std::vector<std::string> known(columns_.begin(), columns_.end());
      return base::WrongInput("table.unknown_column",
                              fmt::format("unknown column '{}'{}", name, base::DidYouMean(name, known)), "--columns");
    }
    return {};
  }

  base::Status Copy(record::Query query) {
    query.order = record::Query::Order::kFile;  // one chunk at a time
    query.channels.emplace();
    std::map<record::ChannelId, Thinning> thinned;
    for (const auto& [channel, table] : of_channel_) {
      query.channels->insert(channel);
      if (selection_.rate_hz > 0.0 && !selection_.events.contains(table->topic))
        thinned.emplace(channel, Thinning(selection_.rate_hz));
    }
    auto cursor = reader_.Messages(query);
    for (std::uint64_t count = 0;; ++count) {
      const auto message = cursor.Next();
      if (!message) {
        report_.losses.push_back(message.error().Text());
        continue;
      }
      if (!message.value()) return {};
      const auto thinning = thinned.find(message.value()->channel);
      const bool keeps = thinning == thinned.end() || thinning->second.Keeps(message.value()->log_time_ns);
      if (auto status = keeps ? Put(*message.value()) : base::Status(); !status) return status;
      if (count % kMessagesBetweenProgress != 0 || GoesOn(count)) continue;
      return base::Failed("run.interrupted", "export cancelled; partial output removed");
    }
  }
  bool GoesOn(std::uint64_t messages) const {
    const auto all = static_cast<double>(std::max<std::uint64_t>(1, reader_.statistics().messages));
    return !progress_ || progress_(std::min(1.0, static_cast<double>(messages) / all));
  }

  base::Status Put(const record::Message& message) {
    const record::Channel& channel = reader_.channels().at(message.channel);
    const auto source = channel.metadata.find("source");
    const std::string name = source != channel.metadata.end() ? source->second : fmt::format("channel {}", channel.id);
    auto status = of_channel_.at(message.channel)->writer->Put(message.data, message.log_time_ns, name);
    if (status || status.error().code == base::ErrorCode::kFailed) return status;
    std::string time;
    AppendSeconds(static_cast<std::int64_t>(message.log_time_ns), time);
    return status.error().In(fmt::format("{} of '{}' at {} s", channel.topic, name, time));
  }

  void LeaveOut(const std::string& topic, const char* why) {
    std::string sentence = fmt::format("{}: {}", topic, why);
    if (std::ranges::find(report_.left_out, sentence) == report_.left_out.end())
      report_.left_out.push_back(std::move(sentence));
  }

  const record::McapReader& reader_;
  Form form_;
  const decode::Aliases& aliases_;
  const ExportProgress& progress_;
  const Selection& selection_;
  Workplace workplace_;
  ExportReport report_;
  std::optional<SpillFile> spill_;  // of a .mat file
  std::set<std::string> names_;
  std::set<std::string> topics_;   // of the recording, by today's names
  std::set<std::string> columns_;  // of the chosen topics
  std::vector<std::shared_ptr<Table>> tables_;
  std::vector<std::pair<std::pair<std::string, record::SchemaId>, std::shared_ptr<Table>>> table_of_;
  std::map<record::ChannelId, std::shared_ptr<Table>> of_channel_;
};

}  // namespace

base::Result<ExportReport> ExportTables(const record::McapReader& reader, const ExportTarget& target,
                                        const decode::Aliases& aliases, const ExportProgress& progress,
                                        const Selection& selection, std::span<const PlainTable> more) {
  ExportTarget plain = target;
  plain.path = target.path.lexically_normal();  // "tables/" names the folder "tables"
  if (!plain.path.has_filename()) plain.path = plain.path.parent_path();
  return Exporter(reader, plain, aliases, progress, selection).Run(more);
}

base::Result<ExportReport> ExportCsv(const record::McapReader& reader, const fs::path& folder,
                                     const decode::Aliases& aliases, const ExportProgress& progress,
                                     const Selection& selection) {
  return ExportTables(reader, {ExportTarget::Form::kWide, folder}, aliases, progress, selection, {});
}

}  // namespace rodeira::csv
