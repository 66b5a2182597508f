// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/geometry/cubic.hpp"
#include "common/world/opendrive/edits.hpp"
#include "common/world/opendrive/finding.hpp"
#include "common/world/opendrive/surface_files.hpp"

namespace rodeira::opendrive {

class Source;

// An element of the file. It is asked for attributes, and says itself what is wrong with them.
class Node {
 public:
  // The source outlives it.
  Node(Source* source, pugi::xml_node node) : source_(source), node_(node) {}

  explicit operator bool() const { return static_cast<bool>(node_); }
  std::string_view name() const { return node_.name(); }
  std::size_t line() const;
  Source& source() const { return *source_; }
  pugi::xml_node xml() const { return node_; }

  bool Has(const char* attribute) const { return static_cast<bool>(node_.attribute(attribute)); }
  // Finite numbers; what is missing without `otherwise`, or is no number, is a finding, and 0 comes.
  double Number(const char* attribute) const;
  // The same with a value for a missing attribute.
  double Number(const char* attribute, double default_value) const;
  // 0 with a finding where it is no whole number within ±1e6.
  int Integer(const char* attribute) const;
  std::string Text(const char* attribute) const;  // a finding where missing or empty
  std::string Text(const char* attribute, std::string_view default_value) const;
  bool Flag(const char* attribute, bool default_value) const;  // true, false, 1, 0, yes, no
  // a, b, c, d and where they begin: origin + the named attribute.
  geometry::Cubic Cubic(const char* from, double origin) const;

  // The first child of this name; false where there is none.
  Node Child(const char* element) const { return {source_, node_.child(element)}; }
  // In the order of the file; only direct children.
  std::vector<Node> Children(const char* element) const;
  // Without a repair: the element is taken out, where a road can be read without it; else the road is.
  void Wrong(std::string_view rule, std::string message) const;
  void Wrong(std::string_view rule, std::string message, Repair repair) const;

  // What is changed in the file's text.
  std::string_view Text() const;  // of the whole element
  // Edits that delete the element, replace it by text, or set one of its attributes.
  Edit Remove() const;
  Edit Replace(std::string text) const;
  Edit Set(std::string_view attribute, std::string_view value) const;
  Edit Append(std::string_view xml) const;  // as its last child
  Edit Insert(std::string_view xml) const;  // as its first child, where it has any

 private:
  std::size_t Begin() const { return static_cast<std::size_t>(node_.offset_debug()) - 1; }
  std::optional<double> Read(const char* attribute, double most) const;
  Source* source_;
  pugi::xml_node node_;
};

// An original text's lines, and the edits since: first what was included, if anything was, then repairs.
struct Edited {
  std::vector<std::size_t> line_starts;
  std::vector<OffsetMap> maps;
  std::size_t includes = 0;                     // of the maps
  std::map<std::string, std::string> unread;    // included files that could not be read, as they are named: why
  std::shared_ptr<SurfaceFiles> surface_files;  // null: surfaces that the file names are not looked for
};

// An XML file as it is read: what is found wrong in it, and in which road, lane and s the reader is.
class Source {
 public:
  // Wrong input where the text is no XML. `edited`: what was done to the original text, in order.
  static base::Result<std::unique_ptr<Source>> Parse(std::string text, const std::filesystem::path& path,
                                                     const Edited* edited = nullptr);

  Node root() { return {this, document_.document_element()}; }
  std::string_view text() const { return text_; }
  std::size_t LineAt(std::ptrdiff_t offset) const;  // of the original text
  // How often it was repaired.
  std::size_t repairs() const { return edited_ == nullptr ? 0 : edited_->maps.size() - edited_->includes; }
  std::string WhyUnread(const std::string& include) const;  // a file that it includes; empty: not known
  // The surfaces that it names; null: they are not looked for.
  SurfaceFiles* surface_files() const { return edited_ == nullptr ? nullptr : edited_->surface_files.get(); }
  // Second <lanes> of a road, of works that come and go (OpenDRIVE 1.9), are told once and passed over.
  void PassOverTemporaryLanes();

  // Said with every finding from now on.
  struct Where {
    std::string road;
    std::optional<int> lane;
    std::optional<double> s_m;
  };
  Where where;
  std::vector<Finding> errors, warnings;

  // Adds an error at a line of the original text, in the road, lane and s of `where`; none beyond most_findings.
  void Wrong(std::string_view rule, std::string message, std::size_t line, Repair repair);
  std::size_t most_findings = 1000;

 private:
  Source() = default;
  std::string text_;
  const Edited* edited_ = nullptr;
  std::vector<std::size_t> line_starts_;
  pugi::xml_document document_;
};

inline constexpr const char* kLeftOut = "the road is left out";

// Offsets of the first byte of each line; the first is 0.
std::vector<std::size_t> LineStarts(std::string_view text);
// How an element is taken out of the file: alone where a road can be read without it, a curve for a line, otherwise
// with its road; with nothing done where none is possible.
Repair TakeOut(const Node& node);
// Elements that stand in the order of `order` (indices into `nodes`) from now on, each where one of them stood.
std::vector<Edit> Reorder(const std::vector<Node>& nodes, const std::vector<std::size_t>& order);

// Keeps `where` for as long as it lives.
class Within {
 public:
  explicit Within(Source& source) : source_(source), before_(source.where) {}
  ~Within() { source_.where = before_; }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  Source& source_;
  Source::Where before_;
};

// The records of one kind in ascending order. Others are a finding of `rule`, and are put in order.
geometry::CubicTable ReadCubics(const std::vector<Node>& records, const char* from, double origin,
                                std::string_view rule);

}  // namespace rodeira::opendrive
