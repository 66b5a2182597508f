// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace rodeira::base {

// "; did you mean 'demo.yaml'?" for the end of a sentence, where a file with nearly that name, of the same kind (by its
// extension) or of the same stem, lies in the same folder; otherwise nothing.
std::string NearestFile(const std::filesystem::path& path);

// "there is no such file; did you mean ...?" if the file is missing, or a link's target is; empty otherwise.
std::string NoSuchFile(const std::filesystem::path& path);

}  // namespace rodeira::base
