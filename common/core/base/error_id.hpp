// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The identity of an error: a short stable name.

#include <array>
#include <cstddef>
#include <string_view>

namespace rodeira::base {

/// What an error is about: the first part of its id.
inline constexpr std::array<std::string_view, 30> kErrorScopes = {
    "command",   "config",  "dds",    "device",    "edit",     "file",      "fmu",    "launch",  "map",      "measure",
    "mechanism", "message", "node",   "opendrive", "polyline", "recording", "replay", "run",     "scenario", "snapshot",
    "sumo",      "surface", "system", "table",     "terrain",  "traffic",   "tyre",   "vehicle", "view",     "world"};

/// The id of an error: "scope.what_happened", such as "config.unknown_key". An id is stable: programs may compare it,
/// the sentence beside it may change. One id stands for one kind of failure, wherever it is found.
class ErrorId {
 public:
  /// Makes the id of an error without one: "error.unnamed".
  constexpr ErrorId() = default;
  /// Makes an id from a literal, at compile time. A text that is not an id does not compile: the scope is one of
  /// kErrorScopes, what happened is lower-case words and digits that are joined by '_'.
  /// @param text a literal, such as "file.cannot_open"
  consteval ErrorId(const char* text) : text_(text) {  // NOLINT: implicit by design
    if (!IsId(text_)) throw "an error's id is scope.what_happened, its scope is one of kErrorScopes";
  }
  /// Gives the id.
  /// @return "scope.what_happened"
  constexpr std::string_view text() const { return text_; }
  /// Gives the scope.
  /// @return the part before the dot
  constexpr std::string_view scope() const { return text_.substr(0, text_.find('.')); }
  /// Compares two ids by their texts.
  /// @return true for the same id
  constexpr bool operator==(const ErrorId&) const = default;

  /// Says whether a text has the form of an id and a known scope.
  /// @param text any text
  /// @return true for "config.unknown_key", false for a sentence
  static constexpr bool IsId(std::string_view text) {
    const std::size_t dot = text.find('.');
    if (dot == std::string_view::npos) return false;
    bool is_known = false;
    for (const std::string_view scope : kErrorScopes) is_known = is_known || scope == text.substr(0, dot);
    if (!is_known) return false;
    bool in_word = false;
    for (const char c : text.substr(dot + 1)) {
      const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
      if (!is_letter && (c != '_' || !in_word)) return false;
      in_word = is_letter;
    }
    return in_word;
  }

 private:
  std::string_view text_ = "error.unnamed";
};

}  // namespace rodeira::base
