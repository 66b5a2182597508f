// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/data/csv/csv_file.hpp"
#include "common/data/csv/table_writer.hpp"

namespace rodeira::csv {

// One line a row: time_s, step, source, the values, state_digest.
class WideTable final : public TableWriter {
 public:
  // `type` outlives it.
  WideTable(const decode::Type& type, Layout layout, CsvFile file);
  base::Status Close() override { return file_.Close(); }
  std::uint64_t written_bytes() const override { return file_.written_bytes(); }

 private:
  void StartMessage() override;
  void PutValue(Part part, const Slot& slot, const decode::Value& value) override;
  void PutList(Part part, const Slot& slot, const std::string& list) override;
  void StartRow() override { row_cells_.emplace_back(); }
  void DropRow() override { row_cells_.pop_back(); }
  base::Result<std::uint64_t> EndMessage(std::string_view source) override;
  std::string& CellsOf(Part part);

  CsvFile file_;
  std::string before_;                  // cells before the rows, each with a comma in front
  std::vector<std::string> row_cells_;  // of each row
  std::string after_;
};

// One line a value: time_s, step, source, row (of the row sequence, from 0), column, value.
class LongTable final : public TableWriter {
 public:
  // `type` outlives it.
  LongTable(const decode::Type& type, Layout layout, CsvFile file);
  base::Status Close() override { return file_.Close(); }
  std::uint64_t written_bytes() const override { return file_.written_bytes(); }

 private:
  using Cells = std::vector<std::pair<const Slot*, std::string>>;
  void StartMessage() override;
  void PutValue(Part part, const Slot& slot, const decode::Value& value) override;
  void PutList(Part part, const Slot& slot, const std::string& list) override;
  void StartRow() override { row_cells_.emplace_back(); }
  void DropRow() override { row_cells_.pop_back(); }
  base::Result<std::uint64_t> EndMessage(std::string_view source) override;
  Cells& CellsOf(Part part);
  void PutLines(const std::string& head, const std::string& row, const Cells& cells);

  CsvFile file_;
  Cells before_, after_;
  std::vector<Cells> row_cells_;
  std::uint64_t lines_ = 0;  // of the message that is being written
};

}  // namespace rodeira::csv
