// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/mat_table.hpp"

#include <type_traits>
#include <utility>

#include "common/data/csv/mat_file.hpp"

namespace rodeira::csv {

MatTable::MatTable(const decode::Type& type, Layout layout, std::string name) : TableWriter(type, std::move(layout)) {
  table_.name = std::move(name);
  table_.columns.push_back({"time_s", {}});
  if (this->layout().has_header) table_.columns.push_back({"step", {}});
  table_.columns.push_back({"source", TextColumn{}});
  values_ = table_.columns.size();
  for (const Slot& slot : this->layout().slots) {
    if (IsWritten(slot)) table_.columns.push_back({slot.name.empty() ? "value" : slot.name, {}});
  }
  if (this->layout().has_header && this->layout().writes_digest)
    table_.columns.push_back({"state_digest", std::vector<std::uint64_t>()});
}

std::uint64_t MatTable::written_bytes() const { return kMatBytesPerNumber * table_.rows() * table_.columns.size(); }

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

void MatTable::AddCells(const std::vector<Cell>& cells, std::size_t& column) {
  for (const Cell& cell : cells) {
    auto& values = table_.columns[column++].values;
    if (const auto* number = std::get_if<double>(&cell)) {
      std::get<std::vector<double>>(values).push_back(*number);
      continue;
    }
    if (!std::holds_alternative<TextColumn>(values)) values = TextColumn{};  // at the first row
    std::get<TextColumn>(values).Add(std::get<std::string>(cell));
  }
}

base::Result<std::uint64_t> MatTable::EndMessage(std::string_view source) {
  const std::size_t rows = layout().rows.empty() ? 1 : row_cells_.size();
  for (std::size_t row = 0; row < rows; ++row) {
    std::get<std::vector<double>>(table_.columns[0].values).push_back(static_cast<double>(time_ns()) / 1e9);
    if (layout().has_header)
      std::get<std::vector<double>>(table_.columns[1].values).push_back(static_cast<double>(step()));
    std::get<TextColumn>(table_.columns[values_ - 1].values).Add(source);
    std::size_t column = values_;
    AddCells(before_, column);
    if (!layout().rows.empty()) AddCells(row_cells_[row], column);
    AddCells(after_, column);
    if (layout().has_header && layout().writes_digest)
      std::get<std::vector<std::uint64_t>>(table_.columns[column].values).push_back(digest());
  }
  if (written_bytes() > kMaxMatBytes) return TooLargeForMat(table_.name);
  return rows;
}

}  // namespace rodeira::csv
