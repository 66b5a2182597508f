// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/mat_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace rodeira::csv {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

// Data types and array classes of the format.
enum DataType : std::uint32_t {
  kInt8 = 1,
  kInt32 = 5,
  kUint32 = 6,
  kDouble = 9,
  kUint64 = 13,
  kMatrix = 14,
  kUtf8 = 16
};
enum ArrayClass : std::uint32_t {
  kCellClass = 1,
  kStructClass = 2,
  kCharClass = 4,
  kDoubleClass = 6,
  kUint64Class = 15
};

constexpr std::size_t kNameBytes = 64;  // of a field, with the zero behind it
constexpr std::uint64_t kTagBytes = 8;

std::uint64_t Padded(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

void AppendUint32(std::string& out, std::uint64_t value) {
  for (int byte = 0; byte < 4; ++byte) out += static_cast<char>(value >> (8 * byte));
}
void AppendTag(std::string& out, DataType type, std::uint64_t bytes) {
  AppendUint32(out, type);
  AppendUint32(out, bytes);
}
void AppendData(std::string& out, DataType type, std::string_view data) {
  AppendTag(out, type, data.size());
  out += data;
  out.append(Padded(data.size()) - data.size(), '\0');
}

// Everything of an array before its values: flags, dimensions, name.
std::uint64_t HeadBytes(std::string_view name) { return 2 * (kTagBytes + 8) + kTagBytes + Padded(name.size()); }
void AppendHead(std::string& out, ArrayClass array_class, std::uint64_t rows, std::uint64_t columns,
                std::string_view name) {
  AppendTag(out, kUint32, 8);
  AppendUint32(out, array_class);
  AppendUint32(out, 0);
  AppendTag(out, kInt32, 8);
  AppendUint32(out, rows);
  AppendUint32(out, columns);
  AppendData(out, kInt8, name);
}

std::uint64_t CodePoints(std::string_view text) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// A text without a name, as an array; the bytes behind its tag.
std::uint64_t TextBytes(std::string_view text) { return HeadBytes("") + kTagBytes + Padded(text.size()); }
void AppendText(std::string& out, std::string_view text) {
  AppendTag(out, kMatrix, TextBytes(text));
  AppendHead(out, kCharClass, text.empty() ? 0 : 1, CodePoints(text), "");
  AppendData(out, kUtf8, text);
}

// The bytes behind the tag of a column's array.
std::uint64_t ColumnBytes(const PlainColumn& column) {
  const auto* texts = std::get_if<TextColumn>(&column.values);
  if (texts == nullptr) return HeadBytes("") + kTagBytes + kMatBytesPerNumber * column.size();
  if (texts->distinct.size() == 1) return TextBytes(texts->distinct[0]);
  std::uint64_t bytes = HeadBytes("");
  for (const std::uint32_t i : texts->index) bytes += kTagBytes + TextBytes(texts->distinct[i]);
  return bytes;
}

base::Status AppendNumbers(CsvFile& file, DataType type, const char* values, std::uint64_t bytes) {
  AppendTag(file.buffer(), type, bytes);
  constexpr std::uint64_t kPart = 1u << 20;
  for (std::uint64_t done = 0; done < bytes; done += kPart) {
    file.buffer().append(values + done, std::min(kPart, bytes - done));
    if (auto status = file.Drain(); !status) return status;
  }
  return {};
}

base::Status AppendColumn(const PlainColumn& column, CsvFile& file) {
  std::string& out = file.buffer();
  const std::uint64_t rows = column.size();
  if (const auto* texts = std::get_if<TextColumn>(&column.values)) {
    if (texts->distinct.size() == 1) {
      AppendText(out, texts->distinct[0]);
      return file.Drain();
    }
    AppendTag(out, kMatrix, ColumnBytes(column));
    AppendHead(out, kCellClass, rows, 1, "");
    for (const std::uint32_t i : texts->index) {
      AppendText(out, texts->distinct[i]);
      if (auto status = file.Drain(); !status) return status;
    }
    return {};
  }
  AppendTag(out, kMatrix, ColumnBytes(column));
  if (const auto* whole = std::get_if<std::vector<std::uint64_t>>(&column.values)) {
    AppendHead(out, kUint64Class, rows, 1, "");
    return AppendNumbers(file, kUint64, reinterpret_cast<const char*>(whole->data()), kMatBytesPerNumber * rows);
  }
  const auto& numbers = std::get<std::vector<double>>(column.values);
  AppendHead(out, kDoubleClass, rows, 1, "");
  return AppendNumbers(file, kDouble, reinterpret_cast<const char*>(numbers.data()), kMatBytesPerNumber * rows);
}

std::uint64_t SpilledBytes(const SpilledColumn& column) {
  if (column.one_text() != nullptr) return TextBytes(*column.one_text());
  return HeadBytes("") + (column.kind() == SpilledColumn::Kind::kTexts ? 0 : kTagBytes) + column.bytes();
}

base::Status AppendSpilled(const SpilledColumn& column, const SpillFile& spill, CsvFile& file) {
  std::string& out = file.buffer();
  if (column.one_text() != nullptr) {
    AppendText(out, *column.one_text());
    return file.Drain();
  }
  const bool texts = column.kind() == SpilledColumn::Kind::kTexts;
  const bool whole = column.kind() == SpilledColumn::Kind::kWhole;
  AppendTag(out, kMatrix, SpilledBytes(column));
  AppendHead(out, texts ? kCellClass : whole ? kUint64Class : kDoubleClass, column.rows(), 1, "");
  if (!texts) AppendTag(out, whole ? kUint64 : kDouble, column.bytes());
  return column.EachPart(spill, [&](std::string_view part) {
    out += part;
    return file.Drain();
  });
}

}  // namespace

std::string MatName(std::string_view name, std::set<std::string>& taken) {
  std::string plain;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter)
      plain += c;
    else if (!plain.empty() && plain.back() != '_')
      plain += '_';
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  if (plain.empty() || (plain[0] >= '0' && plain[0] <= '9')) plain.insert(0, "x");
  constexpr std::size_t kMaxLength = kNameBytes - 1;
  plain = plain.substr(0, kMaxLength);
  std::string free = plain;
  for (int number = 2; !taken.insert(free).second; ++number) {
    const std::string suffix = fmt::format("_{}", number);
    free = plain.substr(0, kMaxLength - suffix.size()) + suffix;
  }
  return free;
}

base::Error TooLargeForMat(std::string_view table) {
  return base::WrongInput("table.too_large",
                          "as a variable of a .mat file this table would have more than 2 GB, which no program reads; "
                          "fewer columns, a lower --rate, or --from and --to were expected",
                          table);
}

base::Result<MatFile> MatFile::Create(const std::filesystem::path& path) {
  auto file = CsvFile::Create(path);
  if (!file) return file.error();
  MatFile mat(std::move(file).value());
  std::string head = "MATLAB 5.0 MAT-file, written by rodeira";
  head.resize(116, ' ');
  head.resize(124, '\0');  // no data of subsystems
  head += '\0';
  head += '\1';  // version 0x0100
  head += "IM";  // little-endian
  mat.file_.buffer() += head;
  return mat;
}

void AppendMatText(std::string& out, std::string_view text) { AppendText(out, text); }

base::Status MatFile::Add(const PlainTable& table) {
  std::vector<Field> fields;
  for (const PlainColumn& column : table.columns)
    fields.push_back({column.name, ColumnBytes(column), [&column, this] { return AppendColumn(column, file_); }});
  return AddStructure(table.name, fields);
}

base::Status MatFile::Add(const std::string& name, std::span<const SpilledColumn> columns, const SpillFile& spill) {
  std::vector<Field> fields;
  for (const SpilledColumn& column : columns)
    fields.push_back(
        {column.name(), SpilledBytes(column), [&column, &spill, this] { return AppendSpilled(column, spill, file_); }});
  return AddStructure(name, fields);
}

base::Status MatFile::AddStructure(const std::string& table, std::span<const Field> fields) {
  const std::string variable = MatName(table, names_);
  std::set<std::string> taken;
  std::string names;
  std::uint64_t bytes = HeadBytes(variable) + kTagBytes + kTagBytes + kNameBytes * fields.size();
  for (const Field& field : fields) {
    std::string name = MatName(field.name, taken);
    name.resize(kNameBytes, '\0');
    names += name;
    bytes += kTagBytes + field.bytes;
  }
  if (bytes > kMaxMatBytes) return TooLargeForMat(table);
  std::string& out = file_.buffer();
  AppendTag(out, kMatrix, bytes);
  AppendHead(out, kStructClass, 1, 1, variable);
  AppendUint32(out, kInt32 | (std::uint64_t{4} << 16));  // a small element: its value lies in the tag
  AppendUint32(out, kNameBytes);
  AppendData(out, kInt8, names);
  for (const Field& field : fields) {
    if (auto status = field.write(); !status) return status;
  }
  return file_.Drain();
}

}  // namespace rodeira::csv
