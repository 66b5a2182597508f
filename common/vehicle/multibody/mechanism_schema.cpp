// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/mechanism_schema.hpp"

#include <fmt/format.h>

#include <limits>

#include "common/core/base/constants.hpp"

namespace rodeira::multibody {
namespace {

using config::ComputedNumberKey;
using config::ComputedTextKey;
using config::Counted;
using config::Key;
using config::ListKey;
using config::MappingKey;
using config::NumberItem;
using config::NumberKey;
using config::Range;
using config::Required;
using config::RequiredNumberKey;
using config::RequiredTextKey;
using config::WithDefaultNote;

constexpr Range kAny{-1e6, 1e6}, kAnyLarge{-1e12, 1e12}, kStiffness{0.0, 1e12};

Key Three(std::string name, Range range, std::string meaning) {
  return Counted(3, 3, ListKey(std::move(name), NumberItem(range), std::move(meaning)));
}

Key DirectionKey(std::string name, std::string meaning) {
  return config::OtherKey(std::move(name), "[VECTOR] or [POINT, POINT]", "[u]", std::move(meaning));
}

Key TwoPointsKey(std::string meaning) {
  return config::OtherKey("points", "[POINT, POINT]", "[A, B]", std::move(meaning));
}

Key NamesKey(std::string name, std::string meaning) {
  return ListKey(std::move(name), config::TextItem("A"), std::move(meaning));
}

// The key with the value, and those that all functions of time have.
std::vector<Key> WithLaw(std::vector<Key> keys, Key value) {
  keys.push_back(std::move(value));
  keys.push_back(NumberKey("rate_per_s", kAnyLarge, 0.0, "Its rate of change."));
  keys.push_back(NumberKey("square_per_s2", kAnyLarge, 0.0, "Its factor of t squared."));
  keys.push_back(MappingKey("sine",
                            {RequiredNumberKey("amplitude", kAnyLarge, "Amplitude."),
                             RequiredNumberKey("frequency_Hz", {0.0, 1e5}, "Frequency."),
                             NumberKey("phase_rad", {-100.0, 100.0}, 0.0, "Phase at the beginning.")},
                            "A sine in addition."));
  return keys;
}

Key LawValueKey(std::string name, std::string meaning) {
  return NumberKey(std::move(name), kAnyLarge, 0.0, std::move(meaning));
}

Key PointItem() {
  return MappingKey("",
                    {Required(Three("at_m", kAny, "Place as drawn.")),
                     config::WordKey("fixed", {"false", "true", "x", "y", "z", "xy", "xz", "yz"}, "false",
                                     "Whether it stays, or along which axes."),
                     Three("velocity_mps", kAny, "Initial velocity.")},
                    "");
}

Key MassKey() { return RequiredNumberKey("mass_kg", {0.0, 1e9}, "Mass."); }

Key BodyItem() {
  const Key points =
      Counted(1, std::numeric_limits<std::size_t>::max(), NamesKey("points", "Points that move with it."));
  const Key vectors = ListKey("vectors", config::TextItem("u"), "Vectors that turn with it.");
  Key centre = Three("centre_m", kAny, "Centre of mass as drawn.");
  centre.of.front().sample = "0";
  const Key middle = WithDefaultNote("middle of the points", centre);
  const Key inertia = Counted(
      3, 6, ListKey("inertia_kgm2", config::WithSample("0", NumberItem(kAnyLarge)), "xx, yy, zz, or also xy, xz, yz."));
  const auto kind = [](std::string name, std::vector<Key> keys, std::string meaning) {
    return MappingKey(std::move(name), std::move(keys), std::move(meaning));
  };
  return KindsItem(
      WithDefaultNote(
          "general; planar in a planar mechanism",
          config::OptionalWordKey("kind", {"general", "plate", "planar", "rod", "particle"}, "Kind of body.")),
      {kind("general", {Required(points), vectors, MassKey(), Required(centre), Required(inertia)},
            "A point and three independent directions."),
       kind("plate", {Required(points), vectors, MassKey(), Required(centre), WithDefaultNote("0", inertia)},
            "Points in a plane."),
       kind("planar",
            {Required(points), vectors, MassKey(), Required(centre),
             RequiredNumberKey("inertia_zz_kgm2", {0.0, 1e12}, "Moment of inertia about the centre.")},
            "A body that turns about z."),
       kind("rod",
            {Required(TwoPointsKey("Ends.")), vectors, MassKey(), middle,
             ComputedNumberKey("inertia_kgm2", {0.0, 1e12}, "of a uniform rod", "Moment of inertia across it.")},
            "Two points."),
       kind("particle", {Required(Counted(1, 1, NamesKey("points", "Its point."))), vectors, MassKey(), middle},
            "One point.")});
}

Key AngleItem() {
  return MappingKey("",
                    {config::OptionalNumberKey("rotor_kgm2", {1e-12, 1e9}, "It is a rotor by itself, of this inertia."),
                     NumberKey("at_rad", kAny, 0.0, "Angle of a rotor as drawn."),
                     WithDefaultNote("or `rotor_kgm2`", DirectionKey("of", "Direction of the angle.")),
                     WithDefaultNote("world x if planar", DirectionKey("from", "Direction at which it is 0.")),
                     WithDefaultNote("world y if planar", DirectionKey("to", "Direction at which it is 90°.")),
                     config::OptionalNumberKey("rate_radps", kAny, "Initial rate.")},
                    "");
}

Key DistanceItem() {
  return MappingKey("",
                    {Required(TwoPointsKey("Ends.")),
                     WithDefaultNote("none", DirectionKey("along", "The way along a direction instead.")),
                     config::OptionalNumberKey("rate_mps", kAny, "Initial rate.")},
                    "");
}

Key ConstraintItem() {
  const Key a = Required(DirectionKey("a", "First direction.")), b = Required(DirectionKey("b", "Second direction."));
  return KindsItem(
      Required(config::OptionalWordKey(
          "kind", {"distance", "perpendicular", "dot", "coplanar", "same", "drive", "linear"}, "Kind.")),
      {MappingKey("distance",
                  {Required(TwoPointsKey("Two points.")),
                   ComputedNumberKey("length_m", {1e-9, 1e6}, "as drawn", "Their distance.")},
                  "A distance that stays."),
       MappingKey("perpendicular", {a, b}, "A right angle."),
       MappingKey("dot", {a, b, ComputedNumberKey("value_m2", kAnyLarge, "as drawn", "The product a·b.")},
                  "A product that stays."),
       MappingKey("coplanar", {a, b, Required(DirectionKey("c", "Third direction."))}, "Directions in a plane."),
       MappingKey("same", {Required(TwoPointsKey("Two points."))}, "Points that coincide."),
       MappingKey("drive",
                  WithLaw({RequiredTextKey("coordinate", "turn", "Angle, distance or POINT.x.")},
                          ComputedNumberKey("value", kAnyLarge, "as drawn", "Value at the beginning.")),
                  "A coordinate over time."),
       MappingKey("linear",
                  {Required(config::WithSample(
                       "turn", config::NamedValueKey("terms", NumberItem(kAny), "Factor of the coordinate NAME."))),
                   ComputedNumberKey("value", {-1e9, 1e9}, "as drawn", "Sum of the terms.")},
                  "A sum that stays.")});
}

// Keys of a spring, with the ends of its keys' names: lengths and forces, or angles and moments.
std::vector<Key> WithSpring(std::vector<Key> keys, const std::string& way, const std::string& force,
                            const std::string& stiffness, const std::string& damping, const std::string& rate) {
  const auto curve = [](std::string name, std::string form, std::string meaning) {
    return WithDefaultNote("none",
                           config::OtherKey(std::move(name), std::move(form), "[[0, 0], [1, 10]]", std::move(meaning)));
  };
  const std::string stops = "stops_" + way;
  for (Key& key :
       std::vector<Key>{NumberKey("stiffness_" + stiffness, kStiffness, 0.0, "Stiffness."),
                        curve(fmt::format("spring_{}_{}", way, force), fmt::format("a list of [{}, {}]", way, force),
                              "A curve instead of the stiffness."),
                        ComputedNumberKey("free_" + way, kAny, "as drawn", "Where the spring has no force."),
                        NumberKey("preload_" + force, {-1e9, 1e9}, 0.0, "Constant share, positive in tension."),
                        NumberKey("damping_" + damping, kStiffness, 0.0, "Damping."),
                        curve(fmt::format("damper_{}_{}", rate, force), fmt::format("a list of [{}, {}]", rate, force),
                              "A curve instead of the damping."),
                        config::WithDefaultNote("none", config::OtherKey(stops, "[low, high]", "[0, 1]", "Stops.")),
                        ComputedNumberKey("stop_stiffness_" + stiffness, kStiffness,
                                          fmt::format("required with `{}`", stops), "Stiffness of a stop."),
                        NumberKey("stop_damping_" + damping, kStiffness, 0.0, "Damping of a stop.")})
    keys.push_back(std::move(key));
  return keys;
}

Key ForceItem() {
  const Key coordinate = RequiredTextKey("coordinate", "turn", "Angle.");
  return KindsItem(
      Required(config::OptionalWordKey(
          "kind", {"spring", "torsion", "anti_roll", "force", "torque", "coordinate", "drag", "bushing"}, "Kind.")),
      {MappingKey("spring",
                  WithSpring({WithDefaultNote("or `coordinate`", TwoPointsKey("Ends.")),
                              ComputedTextKey("coordinate", "or `points`", "way", "Distance.")},
                             "m", "N", "Npm", "Nspm", "mps"),
                  "Spring, damper and stops."),
       MappingKey("torsion", WithSpring({coordinate}, "rad", "Nm", "Nmprad", "Nmsprad", "radps"),
                  "The same on an angle."),
       MappingKey("anti_roll",
                  {Required(config::OtherKey("coordinates", "[NAME, NAME]", "[way, other]", "Travel of both sides.")),
                   ComputedNumberKey("stiffness_Npm", kStiffness, "with distances", "Stiffness of their difference."),
                   NumberKey("damping_Nspm", kStiffness, 0.0, "Damping of their difference."),
                   ComputedNumberKey("stiffness_Nmprad", kStiffness, "with angles", "Stiffness of their difference."),
                   NumberKey("damping_Nmsprad", kStiffness, 0.0, "Damping of their difference.")},
                  "Anti-roll bar."),
       MappingKey("force",
                  WithLaw({RequiredTextKey("point", "A", "Where it acts."),
                           Required(Three("direction", kAny, "Direction in the world."))},
                          LawValueKey("force_N", "Force.")),
                  "A force over time."),
       MappingKey("torque",
                  WithLaw({RequiredTextKey("body", "chassis", "General or planar body."),
                           Required(Three("axis", kAny, "Axis in the world."))},
                          LawValueKey("torque_Nm", "Torque.")),
                  "A torque over time."),
       MappingKey("coordinate",
                  WithLaw({RequiredTextKey("coordinate", "way", "Angle or distance."),
                           LawValueKey("torque_Nm", "Torque on an angle.")},
                          LawValueKey("force_N", "Force on a distance.")),
                  "A force on a coordinate."),
       MappingKey("drag",
                  {RequiredTextKey("point", "A", "Where it acts."),
                   RequiredNumberKey("drag_area_m2", {0.0, 1e6}, "Drag coefficient times area."),
                   NumberKey("density_kgpm3", {0.0, 1e5}, 1.2, "Density of the air.")},
                  "½ρA|v|v."),
       MappingKey("bushing",
                  {RequiredTextKey("first", "chassis", "General or planar body."),
                   ComputedTextKey("second", "or `point`", "chassis", "The other body."),
                   ComputedTextKey("point", "or `second`", "A", "Point of another body, where it is drawn."),
                   WithDefaultNote("required with `second`", Three("at_m", kAny, "Place as drawn.")),
                   Required(Three("stiffness_Npm", kStiffness, "Along the axes of the first body.")),
                   WithDefaultNote("0", Three("damping_Nspm", kStiffness, "Along the axes of the first body.")),
                   NumberKey("stiffness_Nmprad", kStiffness, 0.0, "Stiffness of turning, with `second`."),
                   NumberKey("damping_Nmsprad", kStiffness, 0.0, "Damping of turning, with `second`.")},
                  "Elastic joint.")});
}

std::vector<Key> MakeMechanismKeys() {
  using config::NamedValueKey;
  return {
      config::TextKey("name", "", "Name, for the reader."),
      config::FlagKey("planar", false, "No point leaves its z."),
      config::FlagKey("redundant", false, "Constraints that follow from others are allowed."),
      WithDefaultNote(fmt::format("[0, 0, -{}]", base::kGravity_mps2), Three("gravity_mps2", {-1e4, 1e4}, "Gravity.")),
      Required(config::WithSample("A", NamedValueKey("points", PointItem(), "Points."))),
      NamedValueKey("vectors",
                    MappingKey("",
                               {Required(Three("direction", kAny, "Direction as drawn, made of unit length.")),
                                config::FlagKey("fixed", false, "It does not turn.")},
                               ""),
                    "Unit vectors, beside `world x`, `world y` and `world z`."),
      NamedValueKey("bodies", BodyItem(), "Bodies."),
      NamedValueKey("markers",
                    MappingKey("",
                               {RequiredTextKey("body", "chassis", "Body that it moves with."),
                                Required(Three("at_m", kAny, "Place as drawn."))},
                               ""),
                    "Points of bodies that are no coordinates."),
      NamedValueKey("angles", AngleItem(), "Angles from one direction towards another, without wrapping."),
      NamedValueKey("distances", DistanceItem(), "Distances of two points."),
      NamedValueKey("constraints", ConstraintItem(), "Constraints."),
      NamedValueKey("forces", ForceItem(), "Forces."),
      NamedValueKey("outputs", config::TextItem("energy"), "Quantity for the column NAME, as below."),
  };
}

}  // namespace

const std::vector<Key>& MechanismKeys() {
  static const std::vector<Key> keys = MakeMechanismKeys();
  return keys;
}

const config::Schema& MechanismSchema() {
  static const config::Schema schema{"mechanism", "mechanism/1", "A multibody mechanism.",
                                     config::FileKeys("mechanism/1", MechanismKeys())};
  return schema;
}

}  // namespace rodeira::multibody
