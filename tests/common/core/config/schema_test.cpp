// SPDX-License-Identifier: Apache-2.0
// Declared keys: what a reader takes from them, and how they are written as text, JSON Schema and Markdown.
#include "common/core/config/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/config/declared.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::config {
namespace {

using ::testing::HasSubstr;

const Schema& Garage() {
  static const Schema schema{
      "garage", "garage/1", "A garage.",
      FileKeys(
          "garage/1",
          {RequiredNumberKey("height_m", Range::Positive(), "Clear height."),
           NumberKey("slope", {-0.25, 0.25}, 0.0, "Slope of the floor."), IntegerKey("floors", 1, 9, 2, "Floors."),
           FlagKey("lit", true, "Lamps are on."), WordKey("kind", {"open", "closed"}, "open", "Walls."),
           NamedKey("gates", {RequiredTextKey("side", "north", "Side of the \"gate\".")}, "Gates."),
           Counted(2, 3, ListKey("axes", NumberItem({0.0, 5.0}), "Axes.")),
           OptionalNumberKey("gap_m", {0.0, 1.0}, "Gap."),
           ListKey("cars",
                   {RequiredNumberKey("length_m", Range::Positive(), "Length."),
                    ListKey("colours", TextItem("red"), "Colours.")},
                   "Cars."),
           NamedValueKey("doors",
                         KindsItem(Required(OptionalWordKey("kind", {"roller", "swing"}, "Kind.")),
                                   {MappingKey("roller", {NumberKey("power_W", {0.0, 1e3}, 200.0, "Power.")}, ""),
                                    MappingKey("swing", {RequiredNumberKey("width_m", {0.5, 9.0}, "Width.")}, "")}),
                         "Doors."),
           OtherKey("sign", "a text or a number", "7", "Sign.")})};
  return schema;
}

std::string ReadGarage(const std::string& text) {
  const auto file = File::Parse(text, "garage.yaml");
  if (!file) return file.error().Text();
  const DeclaredMap root(file.value().root(), Garage().keys);
  (void)root.Word("rodeira");
  (void)root.Number("height_m");
  (void)root.Number("slope");
  (void)root.Integer("floors");
  (void)root.Flag("lit");
  (void)root.Word("kind");
  for (const auto& [name, gate] : root.Named("gates")) (void)gate.Text("side");
  (void)root.OptionalNumber("gap_m");
  const std::vector<double> axes = root.Numbers("axes");
  if (!axes.empty() && (axes.size() < 2 || axes.size() > 3)) root.map().Problem("axes", "'axes' has no 2 or 3 items");
  if (axes.empty() && root.map().Has("axes")) root.map().Problem("axes", "'axes' is empty");
  const DeclaredList cars = root.Items("cars");
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const DeclaredMap car = cars.At(i);
    (void)car.Number("length_m");
    const DeclaredList colours = car.Items("colours");
    for (std::size_t k = 0; k < colours.size(); ++k) (void)colours.Text(k);
  }
  for (const auto& [name, door] : root.Named("doors")) {
    const std::string kind = door.Word("kind");
    (void)door.OfKind(kind).Number(kind == "roller" ? "power_W" : "width_m");
  }
  (void)root.MapWith("sign").Text("sign", "");
  const base::Status status = file.value().Finish();
  return status ? "" : status.error().Text();
}

// A key of a later version says so in all three forms.
TEST(Schema, AKeyNamesTheVersionThatHasItFirst) {
  const Schema schema{"shed", "shed/1", "A shed.",
                      FileKeys("shed/1", {FlagKey("lit", true, "Lamps are on."),
                                          Since("0.3.0", NumberKey("height_m", {1.0, 9.0}, 2.0, "Height."))})};
  EXPECT_THAT(SchemaMarkdown(schema), HasSubstr("| `height_m` | 2 | 1 to 9 | Height. Since 0.3.0. |"));
  EXPECT_THAT(SchemaMarkdown(schema), HasSubstr("| Lamps are on. |"));
  EXPECT_THAT(SchemaText(schema), HasSubstr("since version 0.1.0, unless their row says another one"));
  EXPECT_THAT(SchemaText(schema), HasSubstr("Height. Since 0.3.0."));
  const std::string json = SchemaJson(schema);
  EXPECT_THAT(json, HasSubstr("\"description\": \"Lamps are on.\",\n      \"$comment\": \"since 0.1.0\""));
  EXPECT_THAT(json, HasSubstr("\"description\": \"Height.\",\n      \"$comment\": \"since 0.3.0\""));
}

TEST(Schema, TheReaderTakesTypeRangeAndDefaultFromTheDeclaration) { ExpectEveryKey(Garage(), ReadGarage); }

TEST(Schema, AnAbsentKeyHasItsDefault) {
  const auto file = File::Parse("{rodeira: garage/1, height_m: 2}", "garage.yaml");
  ASSERT_TRUE(file.ok());
  const DeclaredMap root(file.value().root(), Garage().keys);
  EXPECT_EQ(root.Number("slope"), 0.0);
  EXPECT_EQ(root.Integer("floors"), 2);
  EXPECT_TRUE(root.Flag("lit"));
  EXPECT_EQ(root.Word("kind"), "open");
  EXPECT_TRUE(root.Named("gates").empty());
  EXPECT_EQ(root.OptionalNumber("gap_m"), std::nullopt);
  EXPECT_EQ(root.Items("cars").size(), 0u);
}

// A renamed key is read under its former name for a while: one warning a place names the new one.
TEST(Schema, AFormerNameIsReadWithOneWarning) {
  const Schema schema{"shed", "shed/1", "A shed.",
                      FileKeys("shed/1", {Renamed("tall_m", NumberKey("height_m", {1.0, 9.0}, 2.0, "Height."))})};
  const auto height_of = [&](const File& file) { return DeclaredMap(file.root(), schema.keys).Number("height_m"); };
  const auto file = File::Parse("rodeira: shed/1\ntall_m: 3\n", "former_name.yaml");
  ASSERT_TRUE(file.ok());
  testing::internal::CaptureStderr();
  EXPECT_EQ(height_of(file.value()), 3.0);
  EXPECT_EQ(height_of(file.value()), 3.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "rodeira: warning: former_name.yaml:2: 'tall_m' is deprecated; write 'height_m'\n");
  EXPECT_EQ(file.value().root().Text("rodeira"), "shed/1");
  EXPECT_TRUE(file.value().Finish().ok());

  const auto beyond = File::Parse("{rodeira: shed/1, tall_m: 10}", "former_name_beyond.yaml");
  (void)height_of(beyond.value());
  ASSERT_EQ(beyond.value().Problems().size(), 1u);
  EXPECT_THAT(beyond.value().Problems().front().Text(), HasSubstr("'tall_m'")) << "the bounds are the same";
  const auto both = File::Parse("{rodeira: shed/1, tall_m: 3, height_m: 4}", "former_name_both.yaml");
  EXPECT_EQ(height_of(both.value()), 4.0);
  (void)both.value().root().Text("rodeira");
  ASSERT_EQ(both.value().Problems().size(), 1u);
  EXPECT_EQ(both.value().Problems().front().id.text(), "config.conflicting_keys");

  EXPECT_THAT(SchemaMarkdown(schema), HasSubstr("| `height_m` | 2 | 1 to 9 | Height. Formerly `tall_m`. |"));
  const std::string json = SchemaJson(schema);
  EXPECT_THAT(json, HasSubstr("\"deprecated\": true"));
  EXPECT_LT(json.find("\"tall_m\""), json.find("\"deprecated\""));
}

TEST(SchemaDeathTest, AnUndeclaredKeyOrAnotherTypeAsserts) {
  const auto file = File::Parse("{rodeira: garage/1, height_m: 2}", "garage.yaml");
  ASSERT_TRUE(file.ok());
  const DeclaredMap root(file.value().root(), Garage().keys);
  EXPECT_DEATH((void)root.Number("width_m"), "found != nullptr && found->type == type");
  EXPECT_DEATH((void)root.Text("height_m"), "found->type == type");
  EXPECT_DEATH((void)root.MapWith("width_m"), "FindKey");
  EXPECT_DEATH((void)root.Items("height_m"), "found->type == type");
  EXPECT_DEATH((void)root.OfKind("roller"), "found != nullptr && found->type == type");
  EXPECT_DEATH((void)root.NamedNumbers("doors"), "declared.of.front\\(\\).type == ValueType::kNumber");
}

TEST(Schema, MarkdownHasARowAKey) {
  EXPECT_EQ(SchemaMarkdown(Garage()),
            "| key | default | range | meaning |\n|---|---|---|---|\n"
            "| `rodeira` | required | garage/1 | Kind and version of the file. |\n"
            "| `height_m` | required | over 0 | Clear height. |\n"
            "| `slope` | 0 | -0.25 to 0.25 | Slope of the floor. |\n"
            "| `floors` | 2 | 1 to 9 | Floors. |\n"
            "| `lit` | true | true, false | Lamps are on. |\n"
            "| `kind` | open | open, closed | Walls. |\n"
            "| `gates.NAME.side` | required | | Side of the \"gate\". |\n"
            "| `axes[]` | | 2 to 3 items, 0 to 5 | Axes. |\n"
            "| `gap_m` | | 0 to 1 | Gap. |\n"
            "| `cars[].length_m` | required | over 0 | Length. |\n"
            "| `cars[].colours[]` | | | Colours. |\n"
            "| `doors.NAME.kind` | required | roller, swing | Kind. |\n"
            "| `doors.NAME(roller).power_W` | 200 | 0 to 1000 | Power. |\n"
            "| `doors.NAME(swing).width_m` | required | 0.5 to 9 | Width. |\n"
            "| `sign` | | a text or a number | Sign. |\n");
}

TEST(Schema, JsonHasTypeBoundsAndWhatIsRequired) {
  const std::string json = SchemaJson(Garage());
  EXPECT_THAT(json, HasSubstr("\"$schema\": \"https://json-schema.org/draft/2020-12/schema\""));
  EXPECT_THAT(json, HasSubstr("\"required\": [\"rodeira\", \"height_m\"]"));
  EXPECT_THAT(json, HasSubstr("\"exclusiveMinimum\": 0"));
  EXPECT_THAT(json, HasSubstr("\"minimum\": -0.25"));
  EXPECT_THAT(json, HasSubstr("\"description\": \"Side of the \\\"gate\\\".\""));
}

TEST(Schema, TextHasALineAKey) {
  EXPECT_THAT(SchemaText(Garage()), ::testing::ContainsRegex("gates.NAME.side +required"));
}

}  // namespace
}  // namespace rodeira::config
