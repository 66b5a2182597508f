// SPDX-License-Identifier: Apache-2.0
// Where points lie on real files, against an oracle that has nothing in common with the network (file_oracle.hpp).
#include "tests/common/world/network/file_oracle.hpp"

#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "tests/common/world/network/against_oracle.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

TEST(FileOracle, AgreesOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  std::size_t asked = 0;
  for (const auto& file : files) {
    const std::string text = base::ReadText(file).value();
    const FileOracle oracle(text);
    if (oracle.has_lateral() || oracle.has_borders()) continue;
    ++asked;
    ExpectAgreement(*opendrive::LoadNetwork(file).value(), oracle, !oracle.has_heights(), file.filename().string());
  }
  EXPECT_GE(asked, 5u);
}

}  // namespace
}  // namespace rodeira::network
