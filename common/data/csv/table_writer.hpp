// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/data/csv/layout.hpp"
#include "common/data/decode/walk.hpp"

namespace rodeira::csv {

// Turns the messages of one type into rows. A subclass says what becomes of the values.
class TableWriter : private decode::Visitor {
 public:
  // `type` outlives it.
  TableWriter(const decode::Type& type, Layout layout);
  ~TableWriter() override = default;

  // Appends the message's rows; `log_time_ns` and `source` (a name) stand for what a message without a header does not
  // say. Wrong input where the payload is no such message: then no row of it is written.
  base::Status Put(std::span<const std::byte> payload, std::uint64_t log_time_ns, std::string_view source);
  // After the last message. Failed where the disk refuses.
  virtual base::Status Close() = 0;

  std::uint64_t messages() const { return messages_; }
  std::uint64_t rows() const { return rows_; }
  virtual std::uint64_t written_bytes() const = 0;

 protected:
  // Values lie in the rows of the row sequence, or before or behind it.
  enum class Part { kBefore, kRow, kAfter };
  // These are called in the order of the message's bytes, from StartMessage to EndMessage.
  virtual void StartMessage() = 0;
  virtual void PutValue(Part part, const Slot& slot, const decode::Value& value) = 0;
  // A sequence that fills one cell, as its text.
  virtual void PutList(Part part, const Slot& slot, const std::string& list) = 0;
  virtual void StartRow() = 0;
  virtual void DropRow() = 0;  // the newest row, which has no values
  // The message is whole: its rows are written. Returns how many there are.
  virtual base::Result<std::uint64_t> EndMessage(std::string_view source) = 0;

  const Layout& layout() const { return layout_; }
  // Of the message's header.
  std::int64_t step() const { return step_; }
  std::int64_t time_ns() const { return time_ns_; }
  std::uint64_t digest() const { return digest_; }

 private:
  void OnValue(const decode::Path& path, decode::Value value) override;
  void OnSequence(const decode::Path& path, std::uint64_t length) override;
  void OnSequenceEnd(const decode::Path& path) override;
  Part PartNow() const { return in_rows_ ? Part::kRow : slot_ < row_slot_ ? Part::kBefore : Part::kAfter; }
  void AddToList(const decode::Path& path, const decode::Value& value);
  // Slots are gone through again for each element of the row sequence.
  void EndRow();

  const decode::Type& type_;
  Layout layout_;
  std::uint64_t messages_ = 0;
  std::uint64_t rows_ = 0;

  // Of the message that is being read:
  std::size_t slot_ = 0;
  std::size_t row_slot_ = 0;   // the first of the row sequence
  std::size_t row_slots_ = 0;  // how many there are; 0 without one
  bool in_rows_ = false;
  std::size_t list_depth_ = 0;  // length of the path of the sequence that fills one cell; 0: none
  std::size_t lists_open_ = 0;
  std::string list_;
  std::int64_t step_ = 0;
  std::int64_t time_ns_ = 0;
  std::uint64_t digest_ = 0;
};

// The columns of a layout, in the order in which they are written.
bool IsWritten(const Slot& slot);

}  // namespace rodeira::csv
