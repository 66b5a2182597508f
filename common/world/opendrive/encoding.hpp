// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"

namespace rodeira::opendrive {

// An XML text as UTF-8: from UTF-16 or UTF-32 of either byte order, with a byte order mark or without, or from the
// encoding that its declaration names, which then names UTF-8. A text that is UTF-8 or ASCII comes back to the byte.
// What is no character becomes U+FFFD. Wrong input where the encoding is unknown.
base::Result<std::string> ToUtf8(std::string bytes, const std::filesystem::path& path);

// Wrong input, with what was found, where a text cannot be XML at all: empty, a page of the web, a Git LFS pointer.
base::Status LooksLikeXml(const std::string& text, const std::filesystem::path& path);

}  // namespace rodeira::opendrive
