// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/mat_table.hpp"

#include <type_traits>
#include <utility>

namespace rodeira::csv {

MatTable::MatTable(const decode::Type& type, Layout layout, std::string name, SpillFile& spill)
    : TableWriter(type, std::move(layout)), name_(std::move(name)), spill_(spill) {
  columns_.emplace_back("time_s", SpilledColumn::Kind::kNumbers);
  if (this->layout().has_header) columns_.emplace_back("step", SpilledColumn::Kind::kNumbers);
  columns_.emplace_back("source", SpilledColumn::Kind::kTexts);
  values_ = columns_.size();
  for (const Slot& slot : this->layout().slots) {
    if (IsWritten(slot)) columns_.emplace_back(slot.name.empty() ? "value" : slot.name, SpilledColumn::Kind::kNumbers);
  }
  if (this->layout().has_header && this->layout().writes_digest)
    columns_.emplace_back("state_digest", SpilledColumn::Kind::kWhole);
}

std::uint64_t MatTable::written_bytes() const { return kMatBytesPerNumber * columns_.front().rows() * columns_.size(); }

std::size_t MatTable::bytes_in_memory() const {
  std::size_t bytes = 0;
  for (const SpilledColumn& column : columns_) bytes += column.bytes_in_memory();
  return bytes;
}

void MatTable::StartMessage() {
  before_.clear();
  row_cells_.clear();
  after_.clear();
}

std::vector<MatTable::Cell>& MatTable::CellsOf(Part part) {
  return part == Part::kRow ? row_cells_.back() : part == Part::kBefore ? before_ : after_;
}

void MatTable::PutValue(Part part, const Slot&, const decode::Value& value) {
  std::vector<Cell>& cells = CellsOf(part);
  std::visit(
      [&](const auto& v) {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::string>)
          cells.emplace_back(v);
        else if constexpr (std::is_arithmetic_v<T>)
          cells.emplace_back(static_cast<double>(v));
        else
          cells.emplace_back(decode::Text(value));
      },
      value);
}

void MatTable::PutList(Part part, const Slot&, const std::string& list) { CellsOf(part).emplace_back(list); }

base::Status MatTable::AddCells(const std::vector<Cell>& cells, std::size_t& column) {
  for (const Cell& cell : cells) {
    SpilledColumn& values = columns_[column++];
    const auto* number = std::get_if<double>(&cell);
    if (number == nullptr && values.rows() == 0) values.BecomeTexts();
    auto status = number != nullptr ? values.Add(*number, spill_)
                                    : values.Add(std::string_view(std::get<std::string>(cell)), spill_);
    if (!status) return status;
  }
  return {};
}

base::Status MatTable::AddRow(std::string_view source, const std::vector<Cell>* row) {
  if (auto status = columns_[0].Add(static_cast<double>(time_ns()) / 1e9, spill_); !status) return status;
  if (layout().has_header) {
    if (auto status = columns_[1].Add(static_cast<double>(step()), spill_); !status) return status;
  }
  if (auto status = columns_[values_ - 1].Add(source, spill_); !status) return status;
  std::size_t column = values_;
  if (auto status = AddCells(before_, column); !status) return status;
  if (row != nullptr) {
    if (auto status = AddCells(*row, column); !status) return status;
  }
  if (auto status = AddCells(after_, column); !status) return status;
  if (!layout().has_header || !layout().writes_digest) return {};
  return columns_[column].Add(digest(), spill_);
}

base::Result<std::uint64_t> MatTable::EndMessage(std::string_view source) {
  const bool has_rows = !layout().rows.empty();
  const std::size_t rows = has_rows ? row_cells_.size() : 1;
  for (std::size_t row = 0; row < rows; ++row) {
    if (auto status = AddRow(source, has_rows ? &row_cells_[row] : nullptr); !status) return status.error();
  }
  if (written_bytes() > kMaxMatBytes) return TooLargeForMat(name_);
  return rows;
}

}  // namespace rodeira::csv
