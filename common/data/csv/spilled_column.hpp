// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::csv {

// A file without a name, in a folder: what is put into it goes with the object.
class SpillFile {
 public:
  // Failed where the folder takes no file.
  static base::Result<SpillFile> Create(const std::filesystem::path& folder);
  SpillFile(SpillFile&& other) noexcept;
  SpillFile& operator=(SpillFile&&) = delete;
  ~SpillFile();

  // Some bytes of the file.
  struct Piece {
    std::uint64_t offset = 0, bytes = 0;
  };
  // Failed where the disk refuses.
  base::Result<Piece> Append(std::string_view data);
  // Appends the piece to a text.
  base::Status Read(const Piece& piece, std::string& out) const;

 private:
  SpillFile(int file, std::filesystem::path folder) : file_(file), folder_(std::move(folder)) {}

  int file_;
  std::filesystem::path folder_;
  std::uint64_t size_ = 0;
};

// A column of a table that is written as a .mat file, with its values as they lie there. At most kPartBytes and one
// value are in memory, the rest is in the spill file.
class SpilledColumn {
 public:
  enum class Kind { kNumbers, kWhole, kTexts };
  static constexpr std::size_t kPartBytes = std::size_t{1} << 16;

  SpilledColumn(std::string name, Kind kind) : name_(std::move(name)), kind_(kind) {}
  // Precondition: of that kind. The spill file is the same one for all calls.
  base::Status Add(double value, SpillFile& spill);
  base::Status Add(std::uint64_t value, SpillFile& spill);
  base::Status Add(std::string_view text, SpillFile& spill);
  // A column without rows becomes one of texts.
  void BecomeTexts() { kind_ = Kind::kTexts; }

  const std::string& name() const { return name_; }
  Kind kind() const { return kind_; }
  std::uint64_t rows() const { return rows_; }
  std::uint64_t bytes() const { return spilled_ + newest_.size(); }  // of its values
  // The text that all rows have; null where they differ, or there is none.
  const std::string* one_text() const { return kind_ == Kind::kTexts && is_one_ && rows_ > 0 ? &first_ : nullptr; }
  std::size_t bytes_in_memory() const;
  // Hands the values' bytes to `take`, part by part; it returns a Status.
  template <class Take>
  base::Status EachPart(const SpillFile& spill, const Take& take) const {
    std::string part;
    for (const SpillFile::Piece& piece : pieces_) {
      part.clear();
      if (auto status = spill.Read(piece, part); !status) return status;
      if (auto status = take(std::string_view(part)); !status) return status;
    }
    return take(std::string_view(newest_));
  }

 private:
  base::Status Spill(SpillFile& spill);
  base::Status AddElement(std::string_view text, SpillFile& spill);

  std::string name_;
  Kind kind_;
  std::uint64_t rows_ = 0, spilled_ = 0;
  std::string newest_;  // values behind the pieces
  std::vector<SpillFile::Piece> pieces_;
  std::string first_;  // text
  bool is_one_ = true;
};

}  // namespace rodeira::csv
