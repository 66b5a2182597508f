// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rodeira::nodes {

// Asks for a file: a folder's contents to click through, and a line to write a path into.
class FileDialog {
 public:
  using Chosen = std::function<void(const std::filesystem::path&)>;

  // `endings` (".motors") are what is listed beside folders; a name without one of them gets the first. `to_write`: the
  // file may be new, and a second look is asked for where it is there.
  void Open(std::string title, std::vector<std::string> endings, bool to_write, const std::filesystem::path& start,
            Chosen chosen);
  bool open() const { return open_; }
  // In each picture; nothing where it is not open. `chosen` is called from here.
  void Draw();

 private:
  void List();
  void Confirm();

  bool open_ = false, opens_ = false, focuses_ = false, to_write_ = false;
  std::string title_, why_not_;
  std::vector<std::string> endings_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> folders_, files_;
  std::array<char, 1024> name_{};
  std::filesystem::path asked_;  // there already: confirmed twice it is replaced
  Chosen chosen_;
};

}  // namespace rodeira::nodes
