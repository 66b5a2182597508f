// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/layout.hpp"

#include <fmt/format.h>

namespace rodeira::csv {
namespace {

using decode::Kind;
using decode::Type;
using Use = Slot::Use;

bool IsOctets(const Type& type) {
  return (type.kind == Kind::kSequence || type.kind == Kind::kArray) && type.element->kind == Kind::kOctet;
}

// The paths of all sequences of structures that lie in no other sequence.
void FindRows(const Type& type, const std::string& path, std::vector<std::string>& found) {
  if (found.size() > 1) return;
  if (type.kind == Kind::kStruct) {
    for (const auto& member : type.members)
      FindRows(*member.type, path.empty() ? member.name : path + "." + member.name, found);
  } else if (type.kind == Kind::kSequence && type.element->kind == Kind::kStruct) {
    found.push_back(path);
  } else if (type.kind == Kind::kArray && type.depth > 1) {
    const std::size_t before = found.size();
    FindRows(*type.element, path + "[0]", found);
    if (found.size() > before) found.emplace_back();  // each element of the array has one
  }
}

class Builder {
 public:
  explicit Builder(Layout& layout) : layout_(layout) {}

  bool Add(const Type& type, const std::string& path, bool in_rows) {
    if (layout_.slots.size() > kMaxColumns) return false;
    const bool one_value = IsOctets(type) || decode::IsPlain(type.kind) || type.kind == Kind::kString;
    if (one_value) return Put(in_rows ? Use::kRowCell : Use::kCell, path);
    if (type.kind == Kind::kStruct) return Members(type, path, in_rows);
    if (type.kind == Kind::kArray) {
      for (std::uint64_t i = 0; i < type.length; ++i) {
        if (!Add(*type.element, fmt::format("{}[{}]", path, i), in_rows)) return false;
      }
      return true;
    }
    if (!in_rows && path == layout_.rows) return Add(*type.element, path, true);
    return Put(in_rows ? Use::kRowList : Use::kList, path);
  }

 private:
  bool Members(const Type& type, const std::string& path, bool in_rows) {
    for (const auto& member : type.members) {
      const std::string inner = path.empty() ? member.name : path + "." + member.name;
      // Rodeira's types end on four bytes that are always 0.
      const bool filler =
          type.name.starts_with("rodeira::msg::") && member.name == "end" && member.type->kind == Kind::kUint32;
      const bool header = path.empty() && layout_.has_header && &member == &type.members.front();
      const bool good = filler ? Put(Use::kDropped, inner) : header ? Header() : Add(*member.type, inner, in_rows);
      if (!good) return false;
    }
    return true;
  }
  bool Header() {
    for (const Use use : {Use::kStep, Use::kTime, Use::kSource, Use::kIncarnation, Use::kDigest}) Put(use, "");
    return true;
  }
  bool Put(Use use, const std::string& name) {
    layout_.slots.push_back({use, name});
    return true;
  }

  Layout& layout_;
};

// The header of every sample of the lockstep (idl/sample_header.idl), member for member.
bool IsHeader(const Type& type) {
  if (type.kind != Kind::kStruct || type.name != "rodeira::msg::SampleHeader" || type.members.size() != 5) return false;
  const std::pair<const char*, Kind> expected[] = {{"step", Kind::kInt64},
                                                   {"time_ns", Kind::kInt64},
                                                   {"source", Kind::kUint32},
                                                   {"incarnation", Kind::kUint32},
                                                   {"state_digest", Kind::kUint64}};
  for (std::size_t i = 0; i < 5; ++i) {
    if (type.members[i].name != expected[i].first || type.members[i].type->kind != expected[i].second) return false;
  }
  return true;
}

}  // namespace

base::Result<Layout> LayoutOf(const Type& type) {
  if (type.kind != Kind::kStruct)
    return base::WrongInput("table.not_a_structure", "the type of a message is no structure");
  Layout layout;
  layout.has_header = IsHeader(*type.members.front().type);
  std::vector<std::string> rows;
  FindRows(type, "", rows);
  if (rows.size() == 1) layout.rows = rows.front();
  if (!Builder(layout).Add(type, "", false) || layout.slots.size() > kMaxColumns) {
    return base::WrongInput("table.too_many_columns",
                            fmt::format("'{}' would make a table of more than {} columns", type.name, kMaxColumns));
  }
  return layout;
}

}  // namespace rodeira::csv
