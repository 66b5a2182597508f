// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/plain_table.hpp"

#include <cmath>

#include "common/core/base/append_format.hpp"

namespace rodeira::csv {
namespace {

bool IsMissing(const PlainColumn& column, std::size_t row) {
  const auto* numbers = std::get_if<std::vector<double>>(&column.values);
  return numbers != nullptr && std::isnan((*numbers)[row]);
}

void AppendPlain(const PlainColumn& column, std::size_t row, std::string& out) {
  if (IsMissing(column, row)) return;
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    base::AppendFormat(out, "{}", (*numbers)[row]);
  } else if (const auto* whole = std::get_if<std::vector<std::uint64_t>>(&column.values)) {
    base::AppendFormat(out, "{}", (*whole)[row]);
  } else {
    AppendCell(std::get<TextColumn>(column.values)[row], out);
  }
}

}  // namespace

void TextColumn::Add(std::string_view text) {
  if (!index.empty() && distinct[index.back()] == text) {
    index.push_back(index.back());
    return;
  }
  auto found = number.find(text);
  if (found == number.end()) {
    found = number.emplace(std::string(text), static_cast<std::uint32_t>(distinct.size())).first;
    distinct.emplace_back(text);
  }
  index.push_back(found->second);
}

std::size_t PlainColumn::size() const {
  if (const auto* texts = std::get_if<TextColumn>(&values)) return texts->index.size();
  if (const auto* whole = std::get_if<std::vector<std::uint64_t>>(&values)) return whole->size();
  return std::get<std::vector<double>>(values).size();
}

base::Result<std::uint64_t> WritePlainTable(const PlainTable& table, bool long_form, CsvFile& file) {
  std::string& out = file.buffer();
  std::uint64_t lines = 0;
  if (long_form) {
    out += "time_s,column,value\n";
  } else {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) out += ',';
      AppendCell(table.columns[c].name, out);
    }
    out += '\n';
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t c = long_form ? 1 : 0; c < table.columns.size(); ++c) {
      if (long_form && IsMissing(table.columns[c], row)) continue;
      if (long_form) {
        AppendPlain(table.columns[0], row, out);
        out += ',';
        AppendCell(table.columns[c].name, out);
      }
      if (c > 0) out += ',';
      AppendPlain(table.columns[c], row, out);
      if (!long_form) continue;
      out += '\n';
      ++lines;
    }
    if (!long_form) {
      out += '\n';
      ++lines;
    }
    if (auto status = file.Drain(); !status) return status.error();
  }
  return lines;
}

}  // namespace rodeira::csv
