// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/editor/document.hpp"

namespace rodeira::editor {

// One line before and after: nothing before where it was inserted, nothing after where it was taken out.
template <class Value>
struct LineChange {
  std::size_t index = 0;
  std::optional<traffic_map::Line<Value>> before, after;
};
// A value that stands once. Of a picture, which is large, only the one that the document does not hold is kept here.
struct ScaleChange {
  traffic_map::Line<traffic_map::Scale> before, after;
};
// The picture's bytes before or after, whichever the document does not hold.
struct PictureChange {
  std::string other;
};
// All that the companion says.
struct CompanionChange {
  traffic_map::Heights before, after;
};
using Change = std::variant<LineChange<traffic_map::Curve>, LineChange<traffic_map::Lane>,
                            LineChange<traffic_map::Connection>, ScaleChange, PictureChange, CompanionChange>;

// What one action of a person did to a document: the command that undo takes back and redo does again.
class Edit {
 public:
  const std::string& what() const { return what_; }
  bool empty() const { return changes_.empty(); }
  // The document must be as the edit left it, or, for Redo, as it found it.
  void Undo(Document& document);
  void Redo(Document& document);

 private:
  friend class Recorder;
  std::string what_;  // "lane 3 made"
  std::vector<Change> changes_;
};

// Changes a document and writes down how. A command first finds out whether it can be done, then does it all.
class Recorder {
 public:
  // The document outlives it.
  explicit Recorder(Document& document) : document_(document) {}

  // An index is that of the element in its list of the document.
  void Add(const traffic_map::Curve& curve) { Insert(document_.map.curves, curve); }
  void Add(const traffic_map::Lane& lane) { Insert(document_.map.lanes, lane); }
  void Add(const traffic_map::Connection& connection) { Insert(document_.map.connections, connection); }
  void SetCurve(std::size_t index, const traffic_map::Curve& curve) { Set(document_.map.curves, index, curve); }
  void SetLane(std::size_t index, const traffic_map::Lane& lane) { Set(document_.map.lanes, index, lane); }
  void SetConnection(std::size_t index, const traffic_map::Connection& connection) {
    Set(document_.map.connections, index, connection);
  }
  void RemoveCurve(std::size_t index) { Remove(document_.map.curves, index); }
  void RemoveLane(std::size_t index) { Remove(document_.map.lanes, index); }
  void RemoveConnection(std::size_t index) { Remove(document_.map.connections, index); }
  // The same value again is no change.
  void SetScale(float value);
  void SetPicture(std::string bytes);
  // To be changed freely; what became of it is written down by Finish.
  traffic_map::Heights& companion();
  const Document& document() const { return document_; }

  // Once, at the end.
  Edit Finish(std::string what) &&;

 private:
  template <class Value>
  void Insert(std::vector<traffic_map::Line<Value>>& lines, const Value& value);
  template <class Value>
  void Set(std::vector<traffic_map::Line<Value>>& lines, std::size_t index, const Value& value);
  template <class Value>
  void Remove(std::vector<traffic_map::Line<Value>>& lines, std::size_t index);

  Document& document_;
  std::optional<traffic_map::Heights> companion_before_;
  Edit edit_;
};

}  // namespace rodeira::editor
