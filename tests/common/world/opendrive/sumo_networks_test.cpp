// SPDX-License-Identifier: Apache-2.0
// Networks that SUMO's netgenerate writes as OpenDRIVE with its default options. The oracle is SUMO's own network of
// the same call: every edge of it is a road, and every lane of it a drivable lane.
#include <gmock/gmock.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

struct Call {
  const char *name, *options;
};

class SumoNetworks : public testing::TestWithParam<Call> {};

std::size_t Count(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST_P(SumoNetworks, AreReadWhole) {
  if (std::system("netgenerate --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "netgenerate (sumo) is not installed";
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("rodeira_sumo_{}_{}", ::getpid(), GetParam().name);
  std::filesystem::create_directories(folder);
  const std::string net = (folder / "a.net.xml").string(), xodr = (folder / "a.xodr").string();
  ASSERT_EQ(std::system(fmt::format("netgenerate {} -o {} --opendrive-output {} > /dev/null 2>&1", GetParam().options,
                                    net, xodr)
                            .c_str()),
            0);
  const auto import = Load(xodr);
  const std::string sumo = base::ReadText(net).value();
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(import.ok() && import.value().network != nullptr);
  const network::Network& network = *import.value().network;
  std::size_t roads = 0;
  for (const network::Road& road : network.roads()) roads += road.spec().junction.empty() ? 1 : 0;
  EXPECT_EQ(roads, Count(sumo, "<edge id=\"") - Count(sumo, "<edge id=\":"));
  EXPECT_GE(ReachOf(network).share(), 0.98);
  EXPECT_LE(OneEachKind(import.value().warnings).size(), 10u);
}

INSTANTIATE_TEST_SUITE_P(OfNetgenerate, SumoNetworks,
                         testing::Values(Call{"grid", "--grid"}, Call{"left", "--grid --lefthand"},
                                         Call{"spider", "--spider"},
                                         Call{"random", "--rand --rand.iterations 60 --seed 3"},
                                         Call{"lights", "--grid --tls.guess --tls.guess.threshold 0"},
                                         Call{"walks", "--grid --sidewalks.guess --crossings.guess"},
                                         Call{"lanes", "--grid --default.lanenumber 2"},
                                         Call{"large", "--grid --grid.number 12"}),
                         [](const testing::TestParamInfo<Call>& call) { return call.param.name; });

}  // namespace
}  // namespace rodeira::opendrive
