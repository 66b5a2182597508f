// SPDX-License-Identifier: Apache-2.0
// Nodes that share processes, without `rodeira run`: few libraries, so that every sanitizer sees them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;
using Groups = std::map<std::string, std::string>;  // a node's process

const Groups kSeparate{{"road", "r"}, {"a", "a"}, {"b", "b"}, {"c", "c"}, {"recorder", "w"}};

struct Case {
  std::string name;
  Groups groups;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

class HostedNodes : public testing::TestWithParam<Case> {
 protected:
  // The run's digest; empty where a process has not ended well.
  std::string DigestOf(const std::string& name, const Groups& groups) {
    const std::string launch = folder_
                                   .Write(name + ".yaml", fmt::format(R"(rodeira: launch/1
duration_s: 1
nodes:
  road: {{kind: road, process: {}}}
  a: {{kind: empty, process: {}}}
  b: {{kind: empty, process: {}}}
  c: {{kind: empty, process: {}}}
  recorder: {{kind: recorder, process: {}, config: {{file: {}.mcap}}}}
)",
                                                                      groups.at("road"), groups.at("a"), groups.at("b"),
                                                                      groups.at("c"), groups.at("recorder"), name))
                                   .string();
    const Words common{"--launch", launch, "--run", name + std::to_string(::getpid()), "--domain", "216"};
    const auto start = [&](const std::string& program, const Words& more) {
      Words words{Bin(program)};
      words.insert(words.end(), common.begin(), common.end());
      words.insert(words.end(), more.begin(), more.end());
      return std::make_unique<Started>(words);
    };
    const auto clock = start("rodeira-clock", {"--pace", "max"});
    std::map<std::string, std::unique_ptr<Started>> parts;
    for (const auto& [node, process] : groups) {
      auto& part = parts[process];
      if (part == nullptr) part = start("rodeira-test-shared-process", {"--process", process});
    }
    const Ended ended = clock->Wait(150s);
    EXPECT_EQ(ended.status, 0) << ended.out;
    for (const auto& [process, part] : parts) {
      const Ended of_part = part->Wait(60s);
      EXPECT_EQ(of_part.status, 0) << process << ":\n" << of_part.out;
      EXPECT_EQ(of_part.out, "") << process;
    }
    const auto end = ended.out.find("\nend ");
    const auto digest = ended.out.find("digest=", end);
    return HasFailure() || digest == std::string::npos ? "" : ended.out.substr(digest, 7 + 16);
  }
  const cli::TemporaryFolder folder_;
};

TEST_P(HostedNodes, HaveTheDigestOfSeparateProcesses) {
  const std::string separate = DigestOf("separate", kSeparate);
  ASSERT_NE(separate, "");
  EXPECT_EQ(DigestOf(GetParam().name, GetParam().groups), separate);
}

INSTANTIATE_TEST_SUITE_P(
    Groups, HostedNodes,
    testing::Values(Case{"one", {{"road", "p"}, {"a", "p"}, {"b", "p"}, {"c", "p"}, {"recorder", "p"}}},
                    Case{"two", {{"road", "p"}, {"a", "p"}, {"b", "q"}, {"c", "q"}, {"recorder", "p"}}},
                    Case{"stepped", {{"road", "r"}, {"a", "p"}, {"b", "p"}, {"c", "p"}, {"recorder", "w"}}}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace rodeira::system_test
