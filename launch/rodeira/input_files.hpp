// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

// Files that a command accepts by name: `rodeira run demo` finds demo.yaml in the launch files of Rodeira.
namespace rodeira::cli {

enum class InputKind { kLaunch, kWorld, kVehicle };

// A directory with launch/ and configs/, and its name in lists.
struct InputFolder {
  std::filesystem::path path;
  std::string from;  // "here", "yours" or "Rodeira"
};

// A file that can be given by its name.
struct InputFile {
  std::string name;  // path below launch/, configs/worlds/, configs/vehicles/ or the InputFolder, without .yaml
  std::filesystem::path path;
  std::string from;  // as InputFolder
};

// The current directory, the user's data folder (base::UserDataFolder) and Rodeira's own (base::SharedDataFolder), in
// this order; each only if it exists, and once.
std::vector<InputFolder> InputFolders();

// Files of a kind: all in the kind's directory, and complete ones in its subdirectories and in the InputFolder itself
// (a file that another file of its directory includes is a part of that). In the order of `folders`, then by place and
// name. Unreadable directories count as empty.
std::vector<InputFile> FindInputFiles(InputKind kind, const std::vector<InputFolder>& folders);

// Path of the file that `text` means: `text` itself if it exists; else the first of `folders` that has a file of this
// name. A `text` with a directory or an extension that is found nowhere is returned as it is, for its reader to refuse.
// Wrong input: a bare name that is found nowhere; the message suggests the nearest name.
base::Result<std::string> ResolveInputFile(InputKind kind, const std::string& text,
                                           const std::vector<InputFolder>& folders = InputFolders());

// A table of names, origins and paths, for a terminal.
std::string ListInputFiles(InputKind kind, const std::vector<InputFolder>& folders = InputFolders());

}  // namespace rodeira::cli
