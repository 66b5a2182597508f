// SPDX-License-Identifier: Apache-2.0
// A person's session: the last action in green or red, the check before saving, what is unsaved.
#include "common/editor/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/editor/drawing.hpp"
#include "tests/names.hpp"

namespace rodeira::editor {
namespace {

class ASession : public testing::Test {
 protected:
  void SetUp() override {
    auto made = base::TemporaryFolder::Make("editor");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
  }
  std::filesystem::path At(const std::string& name) const { return folder_->path() / name; }

  std::optional<base::TemporaryFolder> folder_;
  Session session_;
};

TEST_F(ASession, TheLastActionIsSaid) {
  EXPECT_TRUE(session_.Do([](Document& d) { return NewCurve(d, Straight({0, 0}, {9, 0})); }));
  EXPECT_EQ(session_.said().text, "curve 1 made");
  EXPECT_TRUE(session_.said().good);
  EXPECT_FALSE(session_.Do([](Document& d) { return NewLane(d, Side(5), Side(6), traffic_map::LaneMode::kNone); }));
  EXPECT_THAT(session_.said().text, Names("no lane … left curve 5"));
  EXPECT_FALSE(session_.said().good);
  session_.Undo();
  EXPECT_EQ(session_.said().text, "undone: curve 1 made");
  session_.Redo();
  EXPECT_EQ(session_.said().text, "done again: curve 1 made");
  session_.Redo();
  EXPECT_FALSE(session_.said().good);
}

TEST_F(ASession, AFaultyMapIsNotSavedAndTheFaultyElementIsChosen) {
  ASSERT_TRUE(base::WriteWhole(At("a.motors"), traffic_map::GoodMap()).ok());
  ASSERT_TRUE(session_.Open(At("a.motors")));
  EXPECT_TRUE(session_.said().good);
  EXPECT_FALSE(session_.unsaved());
  ASSERT_TRUE(session_.Do([](Document& d) { return NewLane(d, Side(1), Side(4), traffic_map::LaneMode::kStart); }));
  EXPECT_TRUE(session_.unsaved());
  EXPECT_FALSE(session_.Save(At("a.motors")));
  EXPECT_EQ(session_.said().text, "not saved: lane 4: it has neither predecessor nor successor");
  EXPECT_EQ(session_.selection.lanes, std::set<std::int32_t>{4});
  EXPECT_EQ(base::ReadText(At("a.motors")).value(), traffic_map::GoodMap());
  EXPECT_TRUE(session_.Save(At("draft.motors"), true)) << "a draft is saved despite errors";
  EXPECT_FALSE(session_.unsaved());
  session_.Undo();
  EXPECT_TRUE(session_.unsaved());
  EXPECT_TRUE(session_.Save(At("a.motors")));
  EXPECT_EQ(base::ReadText(At("a.motors")).value(), traffic_map::GoodMap());
  EXPECT_EQ(session_.path(), At("a.motors"));
}

TEST_F(ASession, WhatCannotBeOpenedLeavesWhatIsOpen) {
  ASSERT_TRUE(base::WriteWhole(At("a.motors"), traffic_map::GoodMap()).ok());
  ASSERT_TRUE(base::WriteWhole(At("b.motors"), "Once upon a time").ok());
  ASSERT_TRUE(session_.Open(At("a.motors")));
  ASSERT_TRUE(session_.Do([](Document& d) { return SetScale(d, 3.0f); }));
  EXPECT_FALSE(session_.Open(At("b.motors")));
  EXPECT_FALSE(session_.said().good);
  EXPECT_NE(session_.said().text.find("b.motors"), std::string::npos);
  EXPECT_EQ(session_.path(), At("a.motors"));
  EXPECT_EQ(session_.document().map.scale.value.value, 3.0f);
  EXPECT_TRUE(session_.history().CanUndo());
}

TEST_F(ASession, ThePictureIsTold) {
  const auto first = session_.picture_state();
  ASSERT_TRUE(session_.SetPicture(traffic_map::kPng2x1, 4.0f));
  const auto second = session_.picture_state();
  EXPECT_NE(second, first);
  ASSERT_TRUE(session_.Do([](Document& d) { return SetScale(d, 5.0f); }));
  session_.Undo();
  EXPECT_EQ(session_.picture_state(), second);
  session_.Undo();
  EXPECT_NE(session_.picture_state(), second);
  EXPECT_TRUE(session_.document().map.picture.empty());
  session_.Redo();
  EXPECT_EQ(session_.document().map.picture, traffic_map::kPng2x1);
}

}  // namespace
}  // namespace rodeira::editor
