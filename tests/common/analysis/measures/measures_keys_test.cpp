// SPDX-License-Identifier: Apache-2.0
// The keys of a measures file, each in generated files.
#include "common/analysis/measures/measures_schema.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/analysis/measures/spec.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::measures {
namespace {

// An interval needs a name and two points, or a condition.
TEST(MeasuresKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto folder = base::TemporaryFolder::Make("keys");
  ASSERT_TRUE(folder.ok());
  const std::filesystem::path path = folder.value().path() / "measures.yaml";
  const auto problem = [&](const std::string& text) -> std::string {
    std::ofstream(path) << text;
    const auto spec = ReadSpec(path);
    return spec ? "" : spec.error().Text();
  };
  const config::Values points{{"intervals[].from", "start"}, {"intervals[].to", "end"}};
  config::ExpectEveryKey(MeasuresSchema(), problem,
                         {{"baseline", {{"intervals", "[{name: calm, from: start, to: end}]"}}},
                          {"intervals[].name", points},
                          {"intervals[].from", points},
                          {"intervals[].to", points},
                          {"intervals[].for_s", {{"intervals[].from", "start"}}},
                          {"intervals[].min_s", {{"intervals[].while", "speed_mps > 20"}}}});
}

}  // namespace
}  // namespace rodeira::measures
