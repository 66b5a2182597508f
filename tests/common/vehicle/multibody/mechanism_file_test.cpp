// SPDX-License-Identifier: Apache-2.0
// Wrong mechanism files get one sentence with file and line.
#include <gmock/gmock.h>

#include "common/core/base/files.hpp"
#include "common/vehicle/multibody/run.hpp"
#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

using testing::HasSubstr;

const char* kBar = R"(rodeira: mechanism/1
points:
  A: {at_m: [0, 0, 0], fixed: true}
  B: {at_m: [1, 0, 0]}
  C: {at_m: [1, 1, 0], fixed: true}
bodies:
  crank: {kind: rod, points: [A, B], mass_kg: 1}
constraints:
  tie: {kind: distance, points: [B, C], length_m: 1}
)";

std::string Refusal(const std::string& from, const std::string& to) {
  std::string text = kBar;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto mechanism = ParseMechanism(text, "bar.yaml");
  EXPECT_FALSE(mechanism.ok()) << text;
  if (mechanism.ok()) return "";
  EXPECT_EQ(mechanism.error().exit_status(), 2);
  return mechanism.error().Text();
}

TEST(MechanismFile, TheOneThatIsBrokenBelowIsGood) { EXPECT_TRUE(ParseMechanism(kBar, "bar.yaml").ok()); }

TEST(MechanismFile, MistakesAreNamedWithTheirLine) {
  EXPECT_EQ(Refusal("mass_kg: 1", "mas_kg: 1").find("bar.yaml:7: "), 0u);
  EXPECT_THAT(Refusal("mass_kg: 1", "mas_kg: 1"), HasSubstr("mass_kg"));
  EXPECT_THAT(Refusal("mass_kg: 1", "mass_kg: -1"), HasSubstr("bar.yaml:7: 'bodies.crank.mass_kg' is -1"));
  EXPECT_THAT(Refusal("points: [A, B]", "points: [A, D]"), HasSubstr("'D' is no point"));
  EXPECT_THAT(Refusal("points: [A, B]", "points: [A, A]"), HasSubstr("appears twice"));
  EXPECT_THAT(Refusal("kind: rod", "kind: rot"), HasSubstr("did you mean 'rod'"));
  EXPECT_THAT(Refusal("points: [B, C]", "points: [B, X]"), HasSubstr("bar.yaml:9: 'X' is no point"));
  EXPECT_THAT(Refusal("[1, 0, 0]", "[1, 0]"), HasSubstr("three were expected"));
  EXPECT_THAT(Refusal("mechanism/1", "mechanism/2"), HasSubstr("mechanism/1"));
  const auto force = [](const std::string& text) {
    return Refusal("constraints:\n", "forces: {f: {" + text + "}}\nconstraints:\n");
  };
  EXPECT_THAT(force("kind: anti_roll, coordinates: [B, C], stiffness_Npm: 1"), HasSubstr("bar.yaml:8: "));
  EXPECT_THAT(force("kind: anti_roll, coordinates: [B], stiffness_Npm: 1"), HasSubstr("two were expected"));
  EXPECT_THAT(force("kind: bushing, first: crank, point: C, stiffness_Npm: [1, 1, 1]"),
              HasSubstr("must be a general or planar one"));
}

// A bar joins two different coordinates of one kind.
TEST(MechanismFile, AnAntiRollBarJoinsTwoOfOneKind) {
  const auto refusal = [](const std::string& pair) {
    const auto mechanism = ParseMechanism(
        "rodeira: mechanism/1\npoints: {A: {at_m: [0, 0, 0], fixed: true}, B: {at_m: [1, 0, 0]}}\n"
        "bodies: {b: {kind: particle, points: [B], mass_kg: 1}}\n"
        "angles: {turn: {rotor_kgm2: 1}}\ndistances: {way: {points: [A, B]}}\n"
        "forces: {bar: {kind: anti_roll, coordinates: [" +
            pair + "], stiffness_Npm: 5}}\n",
        "bar.yaml");
    EXPECT_FALSE(mechanism.ok()) << pair;
    return mechanism.ok() ? std::string() : mechanism.error().Text();
  };
  EXPECT_THAT(refusal("way, way"), HasSubstr("bar.yaml:6: an anti-roll bar joins two different coordinates"));
  EXPECT_THAT(refusal("way, turn"), HasSubstr("distances or angles"));
}

TEST(MechanismFile, WhatCannotBeAssembledNamesTheConstraintFarthestOff) {
  // B would have to be 1 m from A and 0.2 m from C, which are 1.414 m apart.
  const std::string text = Refusal("length_m: 1", "length_m: 0.2");
  EXPECT_THAT(text, HasSubstr("cannot be assembled"));
  EXPECT_TRUE(text.find("'tie'") != std::string::npos || text.find("'crank (length A-B)'") != std::string::npos)
      << text;
}

TEST(MechanismFile, RedundantConstraintsAreNamed) {
  const std::string again = "constraints:\n  again: {kind: distance, points: [A, B]}\n";
  // The same length as the rod's is said once only: no complaint.
  std::string text = kBar;
  text.replace(text.find("constraints:\n"), 13, again);
  EXPECT_TRUE(ParseMechanism(text, "bar.yaml").ok());
  // An angle that the lengths determine already.
  text = kBar;
  text += "  more: {kind: dot, a: [A, C], b: [A, B]}\n  and_more: {kind: dot, a: [A, C], b: [C, B]}\n";
  const auto mechanism = ParseMechanism(text, "bar.yaml");
  ASSERT_FALSE(mechanism.ok());
  EXPECT_THAT(mechanism.error().Text(), HasSubstr("more"));
  EXPECT_THAT(mechanism.error().Text(), HasSubstr("redundant"));
  EXPECT_TRUE(ParseMechanism(text + "redundant: true\n", "bar.yaml").ok());
}

TEST(MechanismFile, ALoosePointWithoutMassIsNamed) {
  std::string text = kBar;
  text.replace(text.find("bodies:"), 7, "  D: {at_m: [3, 0, 0]}\nbodies:");
  const auto mechanism = ParseMechanism(text, "bar.yaml");
  ASSERT_FALSE(mechanism.ok());
  EXPECT_THAT(mechanism.error().Text(), HasSubstr("bar.yaml:6: 'D' can move but has no mass"));
}

TEST(MechanismFile, InertiaThatNoMassHasIsRefused) {
  const char* kBody = R"(rodeira: mechanism/1
points: {A: {at_m: [0, 0, 0]}}
vectors: {u: {direction: [1, 0, 0]}, v: {direction: [0, 1, 0]}, w: {direction: [0, 0, 1]}}
bodies:
  rock: {points: [A], vectors: [u, v, w], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [1, 1, 3]}
)";
  const auto mechanism = ParseMechanism(kBody, "rock.yaml");
  ASSERT_FALSE(mechanism.ok());
  EXPECT_THAT(mechanism.error().Text(), HasSubstr("rock.yaml:5: body 'rock' has moments of inertia that no mass has"));
}

TEST(MechanismFile, BodiesWithoutAFrameAreRefused) {
  const char* kFlat = R"(rodeira: mechanism/1
points: {A: {at_m: [0, 0, 0]}, B: {at_m: [1, 0, 0]}, C: {at_m: [0, 1, 0]}}
bodies:
  flat: {points: [A, B, C], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [1, 1, 1]}
)";
  const auto mechanism = ParseMechanism(kFlat, "flat.yaml");
  ASSERT_FALSE(mechanism.ok());
  EXPECT_THAT(mechanism.error().Text(), HasSubstr("three independent directions"));
}

TEST(MechanismFile, VelocitiesThatDoNotFitAreRefused) {
  const std::string text = Refusal("B: {at_m: [1, 0, 0]}", "B: {at_m: [1, 0, 0], velocity_mps: [1, 0, 0]}");
  EXPECT_THAT(text, HasSubstr("velocities do not fit"));
}

TEST(MechanismRun, WritesATableThatReadsBackExactly) {
  Mechanism pendulum = Example("pendulum");
  plot::Table table;
  RunSummary summary;
  ASSERT_TRUE(RunMechanism(pendulum, 0.5, 0.01, table, summary).ok());
  EXPECT_EQ(table.rows(), 51u);
  EXPECT_EQ(table.names.front(), "time_s");
  const std::string csv = plot::ToCsv(table);
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  EXPECT_EQ(std::strtod(last.c_str(), nullptr), 0.5);
  EXPECT_EQ(std::strtod(last.substr(last.find(',') + 1).c_str(), nullptr), Value(pendulum, "x_m"));
  EXPECT_THAT(plot::ToSvg(table, "a < b"), HasSubstr("a &lt; b"));
  EXPECT_FALSE(RunMechanism(pendulum, 1.0, 2.0, table, summary).ok());
  EXPECT_FALSE(RunMechanism(pendulum, 1e9, 1e-9, table, summary).ok());
}

}  // namespace
}  // namespace rodeira::multibody
