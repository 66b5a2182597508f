// SPDX-License-Identifier: Apache-2.0
#include "common/editor/edit.hpp"

#include "common/core/base/assert.hpp"
#include "common/world/traffic_map/companion_text.hpp"

namespace rodeira::editor {
namespace {

std::vector<traffic_map::Line<traffic_map::Curve>>& LinesOf(Document& document, const traffic_map::Curve*) {
  return document.map.curves;
}
std::vector<traffic_map::Line<traffic_map::Lane>>& LinesOf(Document& document, const traffic_map::Lane*) {
  return document.map.lanes;
}
std::vector<traffic_map::Line<traffic_map::Connection>>& LinesOf(Document& document, const traffic_map::Connection*) {
  return document.map.connections;
}

// A change done forward or backward.
class Carry {
 public:
  Carry(Document& document, bool forward) : document_(document), forward_(forward) {}

  template <class Value>
  void operator()(LineChange<Value>& change) const {
    auto& lines = LinesOf(document_, static_cast<const Value*>(nullptr));
    const auto& from = forward_ ? change.before : change.after;
    const auto& to = forward_ ? change.after : change.before;
    const auto at = lines.begin() + static_cast<std::ptrdiff_t>(change.index);
    RODEIRA_ASSERT(change.index < lines.size() + (from ? 0 : 1));
    if (!from)
      lines.insert(at, *to);
    else if (!to)
      lines.erase(at);
    else
      *at = *to;
  }
  void operator()(ScaleChange& change) const { document_.map.scale = forward_ ? change.after : change.before; }
  void operator()(PictureChange& change) const { std::swap(document_.map.picture, change.other); }
  void operator()(CompanionChange& change) const { document_.companion = forward_ ? change.after : change.before; }

 private:
  Document& document_;
  bool forward_;
};

}  // namespace

void Edit::Undo(Document& document) {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change)
    std::visit(Carry(document, false), *change);
}

void Edit::Redo(Document& document) {
  for (Change& change : changes_) std::visit(Carry(document, true), change);
}

template <class Value>
void Recorder::Insert(std::vector<traffic_map::Line<Value>>& lines, const Value& value) {
  lines.push_back({value, "", 0});
  edit_.changes_.push_back(LineChange<Value>{lines.size() - 1, std::nullopt, lines.back()});
}

template <class Value>
void Recorder::Set(std::vector<traffic_map::Line<Value>>& lines, std::size_t index, const Value& value) {
  if (lines[index].value == value) return;
  traffic_map::Line<Value> before = lines[index];
  lines[index].value = value;
  edit_.changes_.push_back(LineChange<Value>{index, std::move(before), lines[index]});
}

template <class Value>
void Recorder::Remove(std::vector<traffic_map::Line<Value>>& lines, std::size_t index) {
  edit_.changes_.push_back(LineChange<Value>{index, std::move(lines[index]), std::nullopt});
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(index));
}

template void Recorder::Insert(std::vector<traffic_map::Line<traffic_map::Curve>>&, const traffic_map::Curve&);
template void Recorder::Insert(std::vector<traffic_map::Line<traffic_map::Lane>>&, const traffic_map::Lane&);
template void Recorder::Insert(std::vector<traffic_map::Line<traffic_map::Connection>>&,
                               const traffic_map::Connection&);
template void Recorder::Set(std::vector<traffic_map::Line<traffic_map::Curve>>&, std::size_t,
                            const traffic_map::Curve&);
template void Recorder::Set(std::vector<traffic_map::Line<traffic_map::Lane>>&, std::size_t, const traffic_map::Lane&);
template void Recorder::Set(std::vector<traffic_map::Line<traffic_map::Connection>>&, std::size_t,
                            const traffic_map::Connection&);
template void Recorder::Remove(std::vector<traffic_map::Line<traffic_map::Curve>>&, std::size_t);
template void Recorder::Remove(std::vector<traffic_map::Line<traffic_map::Lane>>&, std::size_t);
template void Recorder::Remove(std::vector<traffic_map::Line<traffic_map::Connection>>&, std::size_t);

void Recorder::SetScale(float value) {
  if (document_.map.scale.value.value == value) return;
  ScaleChange change{document_.map.scale, document_.map.scale};
  change.after.value.value = value;
  document_.map.scale = change.after;
  edit_.changes_.emplace_back(std::move(change));
}

void Recorder::SetPicture(std::string bytes) {
  std::swap(document_.map.picture, bytes);
  edit_.changes_.emplace_back(PictureChange{std::move(bytes)});
}

traffic_map::Heights& Recorder::companion() {
  if (!companion_before_) companion_before_ = document_.companion;
  return document_.companion;
}

Edit Recorder::Finish(std::string what) && {
  if (companion_before_ &&
      traffic_map::CompanionText(*companion_before_) != traffic_map::CompanionText(document_.companion))
    edit_.changes_.emplace_back(CompanionChange{std::move(*companion_before_), document_.companion});
  edit_.what_ = std::move(what);
  return std::move(edit_);
}

}  // namespace rodeira::editor
