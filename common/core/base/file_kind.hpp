// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// The kinds of files that Rodeira reads. A reader that is given another kind than its own says which one it is and what
// takes it.
namespace rodeira::base {

// "a launch file; run it: rodeira run demo.yaml", for the end of a sentence, of a kind as in the line
// `rodeira: KIND/1`. Empty for an unknown kind.
std::string AboutKind(std::string_view kind, const std::filesystem::path& path);

// The same of a file that is no YAML, by its first bytes: the marks of MCAP, OpenDRIVE, OpenCRG, tyre property files,
// FMUs and pictures, and the extension .motors. Empty for other files.
std::string AboutOtherFormat(std::string_view begin, const std::filesystem::path& path);

// The same of every file: by another format, or by its line `rodeira: KIND/1`.
std::string AboutFile(std::string_view begin, const std::filesystem::path& path);

}  // namespace rodeira::base
