// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/csv_tables.hpp"

#include "common/core/base/append_format.hpp"

namespace rodeira::csv {
namespace {

void AppendValue(const decode::Value& value, std::string& out) {
  if (const auto* number = std::get_if<double>(&value); number != nullptr && *number == *number) {
    base::AppendFormat(out, "{}", *number);  // most values are: no text of their own
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    AppendCell(*text, out);
  } else {
    out += decode::Text(value);
  }
}

}  // namespace

WideTable::WideTable(const decode::Type& type, Layout layout, CsvFile file)
    : TableWriter(type, std::move(layout)), file_(std::move(file)) {
  const Layout& all = this->layout();
  std::string& out = file_.buffer();
  out += all.has_header ? "time_s,step,source" : "time_s,source";
  for (const Slot& slot : all.slots) {
    if (!IsWritten(slot)) continue;
    out += ',';
    AppendCell(slot.name.empty() ? "value" : slot.name, out);
  }
  out += all.has_header && all.writes_digest ? ",state_digest\n" : "\n";
}

void WideTable::StartMessage() {
  before_.clear();
  row_cells_.clear();
  after_.clear();
}

std::string& WideTable::CellsOf(Part part) {
  return part == Part::kRow ? row_cells_.back() : part == Part::kBefore ? before_ : after_;
}

void WideTable::PutValue(Part part, const Slot&, const decode::Value& value) {
  std::string& cells = CellsOf(part);
  cells += ',';
  AppendValue(value, cells);
}

void WideTable::PutList(Part part, const Slot&, const std::string& list) {
  std::string& cells = CellsOf(part);
  cells += ',';
  AppendCell(list, cells);
}

base::Result<std::uint64_t> WideTable::EndMessage(std::string_view source) {
  std::string& out = file_.buffer();
  const std::size_t rows = layout().rows.empty() ? 1 : row_cells_.size();
  for (std::size_t row = 0; row < rows; ++row) {
    AppendSeconds(time_ns(), out);
    out += ',';
    if (layout().has_header) base::AppendFormat(out, "{},", step());
    AppendCell(source, out);
    out += before_;
    if (!layout().rows.empty()) out += row_cells_[row];
    out += after_;
    if (layout().has_header && layout().writes_digest) base::AppendFormat(out, ",{:016x}", digest());
    out += '\n';
  }
  if (auto status = file_.Drain(); !status) return status.error();
  return rows;
}

LongTable::LongTable(const decode::Type& type, Layout layout, CsvFile file)
    : TableWriter(type, std::move(layout)), file_(std::move(file)) {
  file_.buffer() +=
      this->layout().has_header ? "time_s,step,source,row,column,value\n" : "time_s,source,row,column,value\n";
}

void LongTable::StartMessage() {
  before_.clear();
  row_cells_.clear();
  after_.clear();
}

LongTable::Cells& LongTable::CellsOf(Part part) {
  return part == Part::kRow ? row_cells_.back() : part == Part::kBefore ? before_ : after_;
}

void LongTable::PutValue(Part part, const Slot& slot, const decode::Value& value) {
  AppendValue(value, CellsOf(part).emplace_back(&slot, std::string()).second);
}

void LongTable::PutList(Part part, const Slot& slot, const std::string& list) {
  AppendCell(list, CellsOf(part).emplace_back(&slot, std::string()).second);
}

void LongTable::PutLines(const std::string& head, const std::string& row, const Cells& cells) {
  std::string& out = file_.buffer();
  for (const auto& [slot, cell] : cells) {
    out += head;
    out += row;
    out += ',';
    AppendCell(slot->name.empty() ? "value" : slot->name, out);
    out += ',';
    out += cell;
    out += '\n';
    ++lines_;
  }
}

base::Result<std::uint64_t> LongTable::EndMessage(std::string_view source) {
  lines_ = 0;
  std::string head;
  AppendSeconds(time_ns(), head);
  head += ',';
  if (layout().has_header) base::AppendFormat(head, "{},", step());
  AppendCell(source, head);
  head += ',';
  PutLines(head, "", before_);
  for (std::size_t row = 0; row < row_cells_.size(); ++row) PutLines(head, fmt::format("{}", row), row_cells_[row]);
  PutLines(head, "", after_);
  if (layout().has_header && layout().writes_digest) {
    base::AppendFormat(file_.buffer(), "{},state_digest,{:016x}\n", head, digest());
    ++lines_;
  }
  if (auto status = file_.Drain(); !status) return status.error();
  return lines_;
}

}  // namespace rodeira::csv
