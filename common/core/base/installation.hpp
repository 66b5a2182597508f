// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

// Where the programs and the shared files of Rodeira lie: in a build folder inside a source tree, or installed below a
// prefix (bin/, libexec/rodeira/, share/rodeira/). The prefix may be moved as a whole. Nothing is created here.
namespace rodeira::base {

// Directory of the running program; "." where /proc is not mounted.
std::filesystem::path ProgramFolder();

// Path of a program of Rodeira: `name` beside the program in `folder`, else in the bin/ or libexec/rodeira/ of the same
// installation. A program that exists in none of them is returned as `folder`/`name`, an absolute path as it is.
std::filesystem::path FindProgram(std::string_view name, const std::filesystem::path& folder = ProgramFolder());

// True if the program in `folder` belongs to an installation, false in a build folder.
bool IsInstalled(const std::filesystem::path& folder = ProgramFolder());

// Directory that holds launch/ and configs/: $RODEIRA_DATA if set, else the source tree around `folder`, else the
// share/rodeira of the installation. Empty if none exists.
std::filesystem::path SharedDataFolder(const std::filesystem::path& folder = ProgramFolder());

}  // namespace rodeira::base
