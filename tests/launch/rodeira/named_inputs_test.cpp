// SPDX-License-Identifier: Apache-2.0
// `--set world=NAME` and `--set nodes.ego.config.vehicle=NAME` take the names that lists print.
#include "launch/rodeira/named_inputs.hpp"

#include <gtest/gtest.h>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

class NamedInputs : public ::testing::Test {
 protected:
  NamedInputs() {
    for (const char* file : {"configs/worlds/town.yaml", "configs/worlds/example/world.yaml"})
      (void)shared_.Write(file, "rodeira: world/2\n");
    (void)shared_.Write("configs/vehicles/kart.yaml", "rodeira: vehicle/2\n");
    (void)own_.Write("launch/beside.yaml", "rodeira: world/2\n");
  }
  base::Result<launch::Overrides> Named(const std::string& key, const std::string& value) const {
    return WithNamedInputs({{key, value}}, own_.path() / "launch/demo.yaml", "--set", {{shared_.path(), "Rodeira"}});
  }
  std::string Value(const std::string& key, const std::string& value) const {
    const auto named = Named(key, value);
    return named ? named.value().front().second : named.error().Text();
  }
  std::string Shared(const std::string& file) const { return "\"" + (shared_.path() / file).string() + "\""; }

  TemporaryFolder shared_, own_;
};

TEST_F(NamedInputs, ANameOfAListIsItsFile) {
  EXPECT_EQ(Value("world", "town"), Shared("configs/worlds/town.yaml"));
  EXPECT_EQ(Value("world", "town.yaml"), Shared("configs/worlds/town.yaml"));
  EXPECT_EQ(Value("world", "example/world"), Shared("configs/worlds/example/world.yaml"));
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "kart"), Shared("configs/vehicles/kart.yaml"));
}

TEST_F(NamedInputs, AnUnknownNameIsRefusedWithTheNearest) {
  const auto refused = Named("nodes.ego.config.vehicle", "krat");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), IsError("file.not_found", "--set nodes.ego.config.vehicle=krat: … 'kart'"));
  EXPECT_EQ(refused.error().exit_status(), 2);
}

// A node without a vehicle has no such key, which its reader says.
TEST_F(NamedInputs, TheVehicleOfANodeWithoutOneIsNoName) {
  (void)own_.Write("launch/demo.yaml", "rodeira: launch/1\nnodes: {ego: {kind: vehicle}, cars: {kind: traffic}}\n");
  EXPECT_EQ(Value("nodes.cars.config.vehicle", "4"), "4");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "kart"), Shared("configs/vehicles/kart.yaml"));
}

TEST_F(NamedInputs, EverythingElseStays) {
  for (const char* value : {"beside.yaml", "../worlds/none.yaml", "/nowhere/town.yaml", "~", "\"town\"", ""})
    EXPECT_EQ(Value("world", value), value);
  EXPECT_EQ(Value("nodes.ego.config", "{vehicle: kart}"), "{vehicle: kart}");
  EXPECT_EQ(Value("nodes.driver.config.source", "kart"), "kart");
  EXPECT_EQ(Value("vehicle.model", "kart"), "kart");
}

}  // namespace
}  // namespace rodeira::cli
