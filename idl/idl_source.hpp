// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::idl {

// An IDL file with everything that it includes.
class IdlSource {
 public:
  using ReadFile = std::function<base::Result<std::string>(const std::filesystem::path&)>;

  // Wrong input, with FILE:LINE, for a file that cannot be read and for a preprocessor line other than an include or an
  // include guard. An included file is looked up beside the file that includes it, then among Rodeira's IDL.
  static base::Result<IdlSource> Read(const std::filesystem::path& path);
  // The same through a function that reads a file's text.
  static base::Result<IdlSource> Read(const std::filesystem::path& path, const ReadFile& read);

  // Self-contained, without preprocessor lines.
  const std::string& text() const { return text_; }
  // A type by its full name, "lab::Gaze". Wrong input with FILE:LINE if the text is not the IDL that Rodeira reads;
  // with the nearest name if it has no such type.
  base::Result<decode::TypePtr> Find(const std::string& name) const;

 private:
  friend class IdlJoiner;
  struct Line {
    std::size_t file = 0;
    std::size_t number = 0;
  };
  std::string text_;
  std::vector<std::string> files_;
  std::vector<Line> lines_;  // where each line of the text comes from
};

// The names in the include lines of an IDL text, in order.
std::vector<std::string> IncludesOf(std::string_view text);

// An IDL file that was compiled into this program. CMake's function rodeira_add_node makes one for each file; it lives
// as long as the program.
class CompiledIdl {
 public:
  CompiledIdl(const char* name, const char* text);
};

// A type of the IDL that was compiled into this program; null if there is none of this name.
decode::TypePtr CompiledType(const std::string& name);

}  // namespace rodeira::idl
