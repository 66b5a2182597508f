// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/table_writer.hpp"

#include <utility>

namespace rodeira::csv {
namespace {

using decode::Value;

// A text within a list: in quotes, so that a semicolon in it separates nothing.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

bool IsRowUse(Slot::Use use) { return use == Slot::Use::kRowCell || use == Slot::Use::kRowList; }

}  // namespace

bool IsWritten(const Slot& slot) {
  return slot.use == Slot::Use::kCell || slot.use == Slot::Use::kList || IsRowUse(slot.use);
}

TableWriter::TableWriter(const decode::Type& type, Layout layout) : type_(type), layout_(std::move(layout)) {
  if (layout_.rows.empty()) return;
  // The row sequence's slots stand together; those that are dropped ("end") belong to it where they lie in its path.
  const std::string prefix = layout_.rows + ".";
  const auto belongs = [&](const Slot& slot) {
    return IsRowUse(slot.use) || (slot.use == Slot::Use::kDropped && slot.name.starts_with(prefix));
  };
  while (row_slot_ < layout_.slots.size() && !belongs(layout_.slots[row_slot_])) ++row_slot_;
  while (row_slot_ + row_slots_ < layout_.slots.size() && belongs(layout_.slots[row_slot_ + row_slots_])) ++row_slots_;
}

base::Status TableWriter::Put(std::span<const std::byte> payload, std::uint64_t log_time_ns, std::string_view source) {
  slot_ = 0;
  in_rows_ = false;
  list_depth_ = 0;
  lists_open_ = 0;
  time_ns_ = static_cast<std::int64_t>(log_time_ns);
  StartMessage();
  if (auto status = decode::Walk(type_, payload, *this); !status) return status;
  const auto rows = EndMessage(source);
  if (!rows) return rows.error();
  ++messages_;
  rows_ += rows.value();
  return {};
}

void TableWriter::OnValue(const decode::Path& path, Value value) {
  if (list_depth_ > 0) return AddToList(path, value);
  const Slot::Use use = layout_.slots[slot_].use;
  switch (use) {
    case Slot::Use::kStep:
      step_ = std::get<std::int64_t>(value);
      break;
    case Slot::Use::kTime:
      time_ns_ = std::get<std::int64_t>(value);
      break;
    case Slot::Use::kDigest:
      digest_ = std::get<std::uint64_t>(value);
      break;
    case Slot::Use::kSource:
    case Slot::Use::kIncarnation:
    case Slot::Use::kDropped:
      break;
    default:
      PutValue(PartNow(), layout_.slots[slot_], value);
  }
  ++slot_;
  EndRow();
}

void TableWriter::OnSequence(const decode::Path& path, std::uint64_t length) {
  if (list_depth_ > 0) {
    ++lists_open_;
    return;
  }
  const bool makes_rows = !in_rows_ && row_slots_ > 0 && slot_ == row_slot_ && !layout_.rows.empty();
  if (makes_rows) {
    in_rows_ = length > 0;
    if (in_rows_) StartRow();
    return;
  }
  list_depth_ = path.size();
  lists_open_ = 1;
  list_.clear();
}

void TableWriter::OnSequenceEnd(const decode::Path&) {
  if (list_depth_ > 0) {
    if (--lists_open_ > 0) return;
    list_depth_ = 0;
    if (layout_.slots[slot_].use != Slot::Use::kDropped) PutList(PartNow(), layout_.slots[slot_], list_);
    ++slot_;
    EndRow();
    return;
  }
  // Behind the last element a row was begun that does not come.
  if (in_rows_) DropRow();
  in_rows_ = false;
  slot_ = row_slot_ + row_slots_;
}

void TableWriter::AddToList(const decode::Path& path, const Value& value) {
  if (!list_.empty()) list_ += "; ";
  const decode::Path inner(path.begin() + static_cast<std::ptrdiff_t>(list_depth_), path.end());
  if (inner.size() > 1) list_ += decode::Text(inner) + "=";
  const auto* text = std::get_if<std::string>(&value);
  list_ += text != nullptr ? Quoted(*text) : decode::Text(value);
}

void TableWriter::EndRow() {
  if (!in_rows_ || slot_ < row_slot_ + row_slots_) return;
  slot_ = row_slot_;
  StartRow();
}

}  // namespace rodeira::csv
