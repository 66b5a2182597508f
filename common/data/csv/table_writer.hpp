// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/data/csv/csv_file.hpp"
#include "common/data/csv/layout.hpp"
#include "common/data/decode/walk.hpp"

namespace rodeira::csv {

// Turns the messages of one type into lines.
class TableWriter final : private decode::Visitor {
 public:
  // `type` outlives it.
  TableWriter(const decode::Type& type, Layout layout, CsvFile file);

  // time_s, step, source, the values, state_digest.
  void PutHeaderLine();
  // Appends the message's rows; `log_time_ns` and `source` (a name) stand for what a message without a header does not
  // say. Wrong input where the payload is no such message: then no row of it is written.
  base::Status Put(std::span<const std::byte> payload, std::uint64_t log_time_ns, std::string_view source);
  base::Status Close() { return file_.Close(); }

  std::uint64_t messages() const { return messages_; }
  std::uint64_t rows() const { return rows_; }
  std::uint64_t written_bytes() const { return file_.written_bytes(); }

 private:
  void OnValue(const decode::Path& path, decode::Value value) override;
  void OnSequence(const decode::Path& path, std::uint64_t length) override;
  void OnSequenceEnd(const decode::Path& path) override;
  void StartCell(bool in_row);
  void AddToList(const decode::Path& path, const decode::Value& value);
  // Slots are gone through again for each element of the row sequence.
  void EndRow();

  const decode::Type& type_;
  Layout layout_;
  CsvFile file_;
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
  std::string before_;                  // cells before the rows, each with a comma in front
  std::vector<std::string> row_cells_;  // of each row
  std::string after_;
};

}  // namespace rodeira::csv
