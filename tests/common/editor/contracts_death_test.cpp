// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the editor: only an edit that is done is undone, on its own document; a preview is as large as
// its level.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/editor/pyramid.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

TEST(ContractsDeathTest, OnlyAnEditThatIsThereIsUndoneOrDoneAgain) {
  History history(EmptyDocument());
  EXPECT_DEATH((void)history.Undo(), "CanUndo\\(\\)");
  EXPECT_DEATH((void)history.Redo(), "CanRedo\\(\\)");
  ExpectUndone(history, [](Document& d) { return NewCurve(d, Straight({0, 3}, {40, 3})); });
  EXPECT_DEATH((void)history.Redo(), "CanRedo\\(\\)");
}

TEST(ContractsDeathTest, AnEditIsUndoneOnTheDocumentThatItLeft) {
  Document document = EmptyDocument();
  auto edit = NewCurve(document, Straight({0, 3}, {40, 3}));
  ASSERT_TRUE(edit.ok()) << edit.error().Text();
  ASSERT_EQ(document.map.curves.size(), 1U);
  edit.value().Undo(document);
  ASSERT_TRUE(document.map.curves.empty());
  EXPECT_DEATH(edit.value().Undo(document), "change.index < lines.size\\(\\)");
}

TEST(ContractsDeathTest, APreviewIsAsLargeAsItsLevel) {
  const Pixels pixels{5, 3, std::vector<std::uint8_t>(45)};
  EXPECT_EQ(Pyramid(10, 6, 1, pixels).first(), 1U);
  EXPECT_DEATH(Pyramid(11, 6, 1, pixels), "width_px_ == SizeAt");
  EXPECT_DEATH(Pyramid(10, 7, 1, pixels), "height_px_ == SizeAt");
}

}  // namespace
}  // namespace rodeira::editor
