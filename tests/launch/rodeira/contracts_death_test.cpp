// SPDX-License-Identifier: Apache-2.0
// Promises inside the front door: a command is chosen, a name fits an address, a node that goes on has published.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>
#include <unistd.h>

#include "launch/rodeira/commands/chosen_command.hpp"
#include "launch/rodeira/doctor/doctor_network.hpp"
#include "launch/rodeira/replay/continued_node.hpp"
#include "launch/rodeira/run/abstract_socket.hpp"

namespace rodeira::cli {
namespace {

TEST(ContractsDeathTest, ACommandIsChosenBeforeItRuns) {
  CLI::App app;
  ChosenCommand chosen;
  CLI::App* command = app.add_subcommand("seven", "");
  chosen.When(*command, [] { return 7; });
  EXPECT_DEATH((void)chosen.Run(), "run_ != nullptr");
  app.parse("seven");
  EXPECT_EQ(chosen.Run(), 7);
}

TEST(ContractsDeathTest, ANameFitsTheAddressOfASocket) {
  std::string name = "rodeira-contracts-" + std::to_string(::getpid());
  name.resize(106, 'x');
  EXPECT_TRUE(AbstractSocket::Take(name).has_value());
  EXPECT_DEATH((void)AbstractSocket::Take(name + "xx"), "sizeof\\(address.value.sun_path\\)");
  EXPECT_DEATH((void)AbstractSocket::OwnerOf(name + "xx"), "sizeof\\(address.value.sun_path\\)");
}

TEST(ContractsDeathTest, AnExchangeIsMeasuredByRoundTrips) {
  LoopBackSettings settings;
  settings.round_trips = 0;
  EXPECT_DEATH((void)MeasureLoopBack(settings), "settings.round_trips > 0");
}

TEST(ContractsDeathTest, ANodeThatGoesOnHasPublishedAndDoesNotBeginAgain) {
  const auto roster =
      lockstep::Roster::Create(1'000'000, 20, {{"one", "t", lockstep::Role::kStepped, 2, 0, 0, {"a"}, {}}});
  ASSERT_TRUE(roster.ok()) << roster.error().Text();
  ContinuedNode node, other;
  EXPECT_DEATH(node.Follow(other, {}, roster.value()), "!published.empty\\(\\)");
  lockstep::Outbox outbox(roster.value(), 0);
  EXPECT_DEATH((void)node.Initialise(outbox), "a node goes on behind its beginning");
  base::StateReader reader{base::Bytes()};
  EXPECT_DEATH(node.Restore(reader), "its state cannot be saved");
}

}  // namespace
}  // namespace rodeira::cli
