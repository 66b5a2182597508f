// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "common/data/csv/mat_file.hpp"
#include "common/data/csv/spilled_column.hpp"
#include "common/data/csv/table_writer.hpp"

namespace rodeira::csv {

// Collects the rows of a topic as columns: numbers and truth as double, texts, octets and lists as texts, state_digest
// as a whole number. Memory is bounded by the number of columns, not by rows; the rest is in the spill file. Refused
// where they would be too large for a variable of a .mat file.
class MatTable final : public TableWriter {
 public:
  // `type` and the spill file outlive it.
  MatTable(const decode::Type& type, Layout layout, std::string name, SpillFile& spill);
  base::Status Close() override { return {}; }
  std::uint64_t written_bytes() const override;
  std::size_t bytes_in_memory() const;  // of the columns
  // Once, after the last message. Wrong input where the variable would be larger than kMaxMatBytes.
  base::Status AddTo(MatFile& file) const { return file.Add(name_, columns_, spill_); }

 private:
  using Cell = std::variant<double, std::string>;
  void StartMessage() override;
  void PutValue(Part part, const Slot& slot, const decode::Value& value) override;
  void PutList(Part part, const Slot& slot, const std::string& list) override;
  void StartRow() override { row_cells_.emplace_back(); }
  void DropRow() override { row_cells_.pop_back(); }
  base::Result<std::uint64_t> EndMessage(std::string_view source) override;
  std::vector<Cell>& CellsOf(Part part);
  base::Status AddCells(const std::vector<Cell>& cells, std::size_t& column);
  base::Status AddRow(std::string_view source, const std::vector<Cell>* row);

  std::string name_;
  SpillFile& spill_;
  std::vector<SpilledColumn> columns_;
  std::size_t values_ = 0;  // the first column of the values
  std::vector<Cell> before_, after_;
  std::vector<std::vector<Cell>> row_cells_;
};

}  // namespace rodeira::csv
