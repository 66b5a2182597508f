// SPDX-License-Identifier: Apache-2.0
// Promises of callers: indices of lists, declarations of keys.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/core/config/declared.hpp"
#include "common/core/config/schema.hpp"

namespace rodeira::config {
namespace {

TEST(ContractsDeathTest, AnIndexIsLessThanTheSizeOfTheList) {
  const auto file = File::Parse("list: [1, two, [3], {four: 4}]", "list.yaml");
  ASSERT_TRUE(file.ok());
  const List list = file.value().root().Items("list");
  ASSERT_EQ(list.size(), 4u);
  EXPECT_DEATH((void)list.Number(4), "index < size");
  EXPECT_DEATH((void)list.Text(4), "index < size");
  EXPECT_DEATH((void)list.Numbers(4), "index < size");
  EXPECT_DEATH((void)list.At(4), "index < size");
  EXPECT_EQ(list.Place(4), "list.yaml");
}

TEST(ContractsDeathTest, ADefaultIsAllowedItself) {
  EXPECT_DEATH((void)NumberKey("width_m", {0.0, 1.0}, 1.5, "Width."), "default_value <= range.high");
  EXPECT_DEATH((void)IntegerKey("lanes", 1, 2, 3, "Lanes."), "default_value >= low");
  EXPECT_DEATH((void)WordKey("side", {"left", "right"}, "up", "Side."), "find\\(words, default_value\\)");
  EXPECT_DEATH((void)Counted(2, 1, ListKey("axes", NumberItem({}), "Axes.")), "low <= high");
  EXPECT_DEATH((void)Renamed("wide_m", Required(NumberKey("width_m", {}, 1.0, "Width."))),
               "key.type == ValueType::kNumber && std::holds_alternative<double>");
  EXPECT_DEATH((void)WithDefaultNote("the width", NumberKey("width_m", {}, 1.0, "Width.")), "!key.required");
}

TEST(ContractsDeathTest, KindsHaveTheNamesOfTheirWord) {
  const auto word = [] { return Required(OptionalWordKey("kind", {"roller", "swing"}, "Kind.")); };
  const Key roller = MappingKey("roller", {}, "Roller."), swing = MappingKey("swing", {}, "Swing.");
  EXPECT_EQ(KindsItem(word(), {roller, swing}).of.size(), 3U);
  EXPECT_DEATH((void)KindsItem(word(), {roller}), "word.words.size\\(\\) == kinds.size\\(\\)");
  EXPECT_DEATH((void)KindsItem(word(), {swing, roller}), "kind.name == key.of.front\\(\\).words");
  EXPECT_DEATH((void)Summarised("A number.", FlagKey("lit", true, "Lit.")), "key.type == ValueType::kMapping");
}

// One key of each declaration that a wrong question can be asked of.
const std::vector<Key> kKeys{
    NumberKey("number", {}, 1.0, "."),
    OptionalNumberKey("optional_number", {}, "."),
    IntegerKey("integer", 0, 9, 1, "."),
    OptionalIntegerKey("optional_integer", 0, 9, "."),
    Key{"flag", ValueType::kFlag, "."},
    TextKey("text", "a", "."),
    ComputedTextKey("computed_text", "of others", "a", "."),
    WordKey("word", {"a", "b"}, "a", "."),
    OptionalWordKey("optional_word", {"a", "b"}, "."),
    ListKey("numbers", NumberItem({}), "."),
    ListKey("texts", TextItem("a"), "."),
    Key{"empty_list", ValueType::kList, "."},
    Key{"empty_names", ValueType::kNamed, "."},
    NamedValueKey("named_numbers", NumberItem({}), "."),
    NamedKey("named_mappings", {}, "."),
};

class DeclaredContractsDeathTest : public ::testing::Test {
 protected:
  const base::Result<File> file_ = File::Parse("{numbers: [1], texts: [a]}", "file.yaml");
  const DeclaredMap root_{file_.value().root(), kKeys};
};

TEST_F(DeclaredContractsDeathTest, AKeyWithoutADefaultIsAskedForAsSuch) {
  EXPECT_DEATH((void)root_.Number("optional_number"), "default_value != nullptr");
  EXPECT_DEATH((void)root_.Integer("optional_integer"), "default_value != nullptr");
  EXPECT_DEATH((void)root_.Flag("flag"), "default_value != nullptr");
  EXPECT_DEATH((void)root_.Text("computed_text"), "default_value != nullptr");
  EXPECT_DEATH((void)root_.Word("optional_word"), "default_value != nullptr");
  EXPECT_EQ(root_.OptionalNumber("optional_number"), std::nullopt);
}

TEST_F(DeclaredContractsDeathTest, AKeyWithADefaultTakesNoOther) {
  EXPECT_DEATH((void)root_.Number("number", 2.0), "!declared.default_note.empty\\(\\)");
  EXPECT_DEATH((void)root_.Text("text", "b"), "!declared.default_note.empty\\(\\)");
  EXPECT_DEATH((void)root_.Word("word", "b"), "!declared.default_note.empty\\(\\)");
  EXPECT_DEATH((void)root_.RequiredNumber("number"), "declared.required \\|\\|");
  EXPECT_DEATH((void)root_.OptionalNumber("number"), "!declared.required && std::holds_alternative");
  EXPECT_DEATH((void)root_.OptionalInteger("integer"), "!declared.required && std::holds_alternative");
  EXPECT_EQ(root_.Text("computed_text", "b"), "b");
}

TEST_F(DeclaredContractsDeathTest, AMappingAListAndNamesAreReadAsWhatTheyHold) {
  EXPECT_DEATH((void)root_.Child("number"), "found->type == ValueType::kOther");
  EXPECT_DEATH((void)root_.Items("empty_list"), "declared.of.size\\(\\) == 1\n");
  EXPECT_DEATH((void)root_.Named("empty_names"), "declared.of.size\\(\\) == 1\n");
  EXPECT_DEATH((void)root_.Named("named_numbers"), "declared.of.front\\(\\).type == ValueType::kKinds");
  EXPECT_DEATH((void)root_.RequiredNumbers("texts"), "declared.of.front\\(\\).type == ValueType::kNumber");
  EXPECT_DEATH((void)root_.NamedNumbers("named_mappings"), "declared.of.front\\(\\).type == ValueType::kNumber");
  EXPECT_DEATH((void)root_.Items("numbers").At(0), "item_->type == ValueType::kKinds");
  EXPECT_DEATH((void)root_.Items("texts").Number(0), "item_->type == ValueType::kNumber");
  EXPECT_DEATH((void)root_.Items("numbers").Text(0), "item_->type == ValueType::kText");
  EXPECT_EQ(root_.Items("numbers").Number(0), 1.0);
}

}  // namespace
}  // namespace rodeira::config
