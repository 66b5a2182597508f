// SPDX-License-Identifier: Apache-2.0
// What is asked before something could be lost, and what becomes of each answer.
#include "tests/nodes/editor/editor_app_fixture.hpp"

namespace rodeira::nodes {
namespace {

class AQuestion : public EditorAppTest {
 protected:
  // A map that has a file, with a change.
  void Change() {
    OpenTheGoodMap();
    Press(SDL_SCANCODE_C);
    Press(SDL_SCANCODE_Z, KMOD_CTRL);
    ASSERT_FALSE(work().session.unsaved());
    ClickOn(15.0, 0.0);
    ChooseOne("left border", "Single");
    ASSERT_TRUE(work().session.unsaved());
  }
  static void CloseTheWindow() {
    SDL_Event event{};
    event.type = SDL_QUIT;
    SDL_PushEvent(&event);
  }
  bool IsSaved() { return base::ReadText(At("a.motors")).value() != traffic_map::GoodMap(); }
};

TEST_F(AQuestion, NothingIsAskedWhereNothingIsUnsaved) {
  OpenTheGoodMap();
  Press(SDL_SCANCODE_N, KMOD_CTRL);
  EXPECT_EQ(work().form, Form::kNone);
  EXPECT_TRUE(document().map.curves.empty());
  CloseTheWindow();
  Show();
  EXPECT_FALSE(open_);
}

TEST_F(AQuestion, ANewMapAfterSaving) {
  Change();
  Press(SDL_SCANCODE_N, KMOD_CTRL);
  ASSERT_EQ(work().form, Form::kUnsaved);
  Keep("editor_question.png");
  Click("Save");
  EXPECT_TRUE(IsSaved());
  EXPECT_TRUE(document().map.curves.empty());
  EXPECT_TRUE(work().session.path().empty());
}

TEST_F(AQuestion, ANewMapInsteadOfTheChange) {
  Change();
  Press(SDL_SCANCODE_N, KMOD_CTRL);
  Click("Discard");
  EXPECT_FALSE(IsSaved());
  EXPECT_TRUE(document().map.curves.empty());
  EXPECT_FALSE(work().session.unsaved());
}

TEST_F(AQuestion, NoNewMapAfterAll) {
  Change();
  Press(SDL_SCANCODE_N, KMOD_CTRL);
  Click("Cancel");
  EXPECT_EQ(work().form, Form::kNone);
  EXPECT_FALSE(IsSaved());
  EXPECT_EQ(document().map.lanes.size(), 3u);
  EXPECT_TRUE(work().session.unsaved());
  Press(SDL_SCANCODE_Z, KMOD_CTRL);
  EXPECT_FALSE(work().session.unsaved()) << "the work goes on where it was";
}

TEST_F(AQuestion, AnotherMapIsOpenedAfterTheAnswer) {
  Change();
  ASSERT_TRUE(base::WriteWhole(At("b.motors"), traffic_map::GoodMap()).ok());
  Press(SDL_SCANCODE_O, KMOD_CTRL);
  ASSERT_EQ(work().form, Form::kUnsaved);
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_FALSE(work().files.open());
  Press(SDL_SCANCODE_O, KMOD_CTRL);
  Press(SDL_SCANCODE_RETURN);  // saved
  EXPECT_TRUE(IsSaved());
  ASSERT_TRUE(work().files.open());
  Write(At("b.motors").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(work().session.path(), At("b.motors"));
}

TEST_F(AQuestion, TheWindowIsClosedAfterTheAnswer) {
  Change();
  CloseTheWindow();
  Show();
  ASSERT_TRUE(open_);
  ASSERT_EQ(work().form, Form::kUnsaved);
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_TRUE(open_);
  EXPECT_FALSE(IsSaved());
  Press(SDL_SCANCODE_Q, KMOD_CTRL);
  Press(SDL_SCANCODE_RETURN);
  EXPECT_FALSE(open_);
  EXPECT_TRUE(IsSaved());
}

TEST_F(AQuestion, TheWindowIsClosedInsteadOfTheChange) {
  Change();
  app_->KeepEvery(0.1);
  for (int i = 0; i < 20; ++i) app_->Frame(0);
  CloseTheWindow();
  Show();
  Click("Discard");
  EXPECT_FALSE(open_);
  EXPECT_FALSE(IsSaved());
  app_.reset();
  EXPECT_TRUE(editor::Keeper::Make(At("kept")).value().Found().empty()) << "what was given up is not offered again";
}

TEST_F(AQuestion, AMapWithoutAFileIsAskedForOne) {
  Press(SDL_SCANCODE_1);
  ClickOn(0.0, 0.0);
  Press(SDL_SCANCODE_Q, KMOD_CTRL);
  ASSERT_EQ(work().form, Form::kUnsaved);
  Click("Save");
  ASSERT_TRUE(work().files.open());
  ASSERT_TRUE(open_);
  // Nothing is left before it is saved.
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_TRUE(open_);
  EXPECT_TRUE(work().session.unsaved());
  Press(SDL_SCANCODE_Q, KMOD_CTRL);
  Click("Save");
  Write(At("crossing").string());
  Press(SDL_SCANCODE_RETURN);
  EXPECT_FALSE(open_);
  EXPECT_TRUE(std::filesystem::exists(At("crossing.motors")));
}

TEST_F(AQuestion, WhatCannotBeSavedIsNotLeft) {
  Change();
  Click("delete chosen");  // no start lane any more
  CloseTheWindow();
  Show();
  Press(SDL_SCANCODE_RETURN);
  EXPECT_TRUE(open_);
  EXPECT_EQ(work().form, Form::kNone);
  EXPECT_FALSE(work().session.said().good);
  EXPECT_NE(Said().find("not saved: "), std::string::npos) << Said();
  EXPECT_TRUE(work().session.unsaved());
  EXPECT_FALSE(IsSaved());
}

TEST_F(AQuestion, TheWindowIsClosedWhileAFileIsAskedFor) {
  Change();
  Press(SDL_SCANCODE_B);
  ASSERT_TRUE(work().files.open());
  CloseTheWindow();
  Show();
  EXPECT_EQ(work().form, Form::kUnsaved);
  EXPECT_FALSE(work().files.open());
  Press(SDL_SCANCODE_ESCAPE);
  EXPECT_TRUE(open_);
  Press(SDL_SCANCODE_C);
  EXPECT_EQ(document().map.curves.size(), 7u) << "the keys work again";
}

class WorkLeftBehind : public EditorAppTest {
 protected:
  // Of an editor that has ended: the map with another scale.
  void Leave(float scale) {
    auto keeper = editor::Keeper::Make(At("kept"));
    ASSERT_TRUE(keeper.ok());
    editor::Document document = work().session.document();
    document.map.scale.value.value = scale;
    ASSERT_TRUE(keeper.value().Keep(document, At("a.motors"), 1).ok());
  }
};

TEST_F(WorkLeftBehind, IsOfferedAndTakenUp) {
  OpenTheGoodMap();
  Leave(77.0f);
  Sit();
  ASSERT_EQ(work().form, Form::kRecover);
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(document().map.scale.value.value, 77.0f);
  EXPECT_EQ(work().session.path(), At("a.motors"));
  EXPECT_TRUE(work().session.unsaved());
  // It is kept again at once: this editor may be killed too.
  Sit();
  ASSERT_EQ(work().form, Form::kRecover);
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(document().map.scale.value.value, 77.0f);
  Press(SDL_SCANCODE_S, KMOD_CTRL);
  Press(SDL_SCANCODE_Q, KMOD_CTRL);
  EXPECT_FALSE(open_);
  Sit();
  EXPECT_EQ(work().form, Form::kNone) << "saved, and so not offered any more";
}

TEST_F(WorkLeftBehind, IsOfferedAgainUnlessItIsGivenUp) {
  OpenTheGoodMap();
  Leave(77.0f);
  Sit();
  Click("Later");
  EXPECT_EQ(work().form, Form::kNone);
  Sit();
  ASSERT_EQ(work().form, Form::kRecover);
  Press(SDL_SCANCODE_ESCAPE);
  Sit();
  ASSERT_EQ(work().form, Form::kRecover);
  Click("Discard");
  Sit();
  EXPECT_EQ(work().form, Form::kNone);
}

TEST_F(WorkLeftBehind, OneIsTakenUpAndTheOthersStay) {
  OpenTheGoodMap();
  Leave(77.0f);
  Leave(78.0f);
  Sit();
  Press(SDL_SCANCODE_RETURN);
  EXPECT_EQ(work().form, Form::kNone) << "another one would take its place";
  const float taken = document().map.scale.value.value;
  app_.reset();
  EXPECT_EQ(editor::Keeper::Make(At("kept")).value().Found().size(), 2u);
  EXPECT_TRUE(taken == 77.0f || taken == 78.0f);
}

}  // namespace
}  // namespace rodeira::nodes
