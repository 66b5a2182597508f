// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "tests/tree.hpp"

namespace rodeira::property {

// The text of a file of the source tree, which a test mutates.
inline std::string GoodFile(const char* path) {
  const auto text = base::ReadText(std::filesystem::path(SourceDir()) / path);
  EXPECT_TRUE(text.ok()) << path;
  return text.ok() ? text.value() : "";
}

}  // namespace rodeira::property
