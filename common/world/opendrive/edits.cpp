// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/edits.hpp"

#include <algorithm>
#include <set>

namespace rodeira::opendrive {
namespace {

// IndexAfter `what`, from `at` on; the text's end where it is not found.
std::size_t IndexAfter(std::string_view text, std::string_view what, std::size_t at) {
  const std::size_t found = text.find(what, at);
  return found == std::string_view::npos ? text.size() : found + what.size();
}

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::size_t TagEnd(std::string_view text, std::size_t begin) {
  for (std::size_t at = begin; at < text.size(); ++at) {
    if (text[at] == '"' || text[at] == '\'')
      at = std::min(text.size(), text.find(text[at], at + 1));
    else if (text[at] == '>')
      return at + 1;
  }
  return text.size();
}

std::size_t ElementEnd(std::string_view text, std::size_t begin) {
  std::size_t at = begin, open = 0;
  while (at < text.size()) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = IndexAfter(text, "-->", at);
    } else if (rest.starts_with("<![CDATA[")) {
      at = IndexAfter(text, "]]>", at);
    } else if (rest.starts_with("<?")) {
      at = IndexAfter(text, "?>", at);
    } else {
      const std::size_t end = TagEnd(text, at);
      const bool closes = rest.starts_with("</"), empty = end >= 2 && text[end - 2] == '/';
      if (closes)
        --open;
      else if (!empty)
        ++open;
      at = end;
      if (open == 0) return at;
    }
    at = std::min(text.size(), text.find('<', at));
  }
  return text.size();
}

Edit SetAttribute(std::string_view text, std::size_t begin, std::string_view name, std::string_view value) {
  const std::size_t end = TagEnd(text, begin);
  std::size_t at = begin + 1;
  while (at < end && !IsBlank(text[at]) && text[at] != '>' && text[at] != '/') ++at;
  const std::size_t behind_name = at;
  while (at < end) {
    while (at < end && IsBlank(text[at])) ++at;
    const std::size_t first = at;
    while (at < end && !IsBlank(text[at]) && text[at] != '=' && text[at] != '>') ++at;
    const std::string_view found = text.substr(first, at - first);
    while (at < end && text[at] != '"' && text[at] != '\'') ++at;
    if (at >= end) break;
    const std::size_t close = std::min(end, text.find(text[at], at + 1));
    if (found == name) return {at + 1, close, std::string(value)};
    at = close + 1;
  }
  return {behind_name, behind_name, " " + std::string(name) + "=\"" + std::string(value) + "\""};
}

Edit AppendChild(std::string_view text, std::size_t begin, std::string_view xml) {
  const std::size_t tag = TagEnd(text, begin);
  if (tag >= 2 && text[tag - 2] == '/') {
    std::size_t name_end = begin + 1;
    while (!IsBlank(text[name_end]) && text[name_end] != '/') ++name_end;
    const std::string name(text.substr(begin + 1, name_end - begin - 1));
    return {tag - 2, tag, ">" + std::string(xml) + "</" + name + ">"};
  }
  const std::size_t end = ElementEnd(text, begin), close = text.rfind("</", end - 1);
  return {close, close, std::string(xml)};
}

OffsetMap::OffsetMap(std::span<const Edit> edits) {
  std::size_t now = 0, before = 0;
  for (const Edit& edit : edits) {
    pieces_.push_back({now, before, true});
    now += edit.begin - before;
    pieces_.push_back({now, edit.begin, false});
    now += edit.text.size();
    before = edit.end;
  }
  pieces_.push_back({now, before, true});
}

std::size_t OffsetMap::Before(std::size_t offset) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), offset,
                                      [](std::size_t at, const Piece& piece) { return at < piece.now; });
  const Piece& piece = *std::prev(after);
  return piece.kept ? piece.before + (offset - piece.now) : piece.before;
}

std::vector<Edit> Compatible(std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.end - a.begin > b.end - b.begin; });
  const auto before = [](const Edit& a, const Edit& b) { return a.begin < b.begin; };
  std::multiset<Edit, decltype(before)> taken(before);
  for (const Edit& edit : edits) {
    const auto next = taken.lower_bound(edit);
    const bool meets_next = next != taken.end() && (next->begin < edit.end || next->begin == edit.begin);
    const bool meets_last = next != taken.begin() && std::prev(next)->end > edit.begin;
    if (!meets_next && !meets_last) taken.insert(edit);
  }
  return {taken.begin(), taken.end()};
}

std::string Apply(std::string_view text, std::span<const Edit> edits) {
  std::string edited;
  edited.reserve(text.size());
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    edited += text.substr(at, edit.begin - at);
    edited += edit.text;
    at = edit.end;
  }
  edited += text.substr(at);
  return edited;
}

}  // namespace rodeira::opendrive
