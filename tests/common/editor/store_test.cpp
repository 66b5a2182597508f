// SPDX-License-Identifier: Apache-2.0
// Files: nothing that was loaded is lost, a full disk leaves the old ones whole, unsaved work outlives its editor.
#include "common/editor/store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

namespace fs = std::filesystem;

const std::string kBeside = "# levelled in 2024\nrodeira: motors/1\nheights_m:\n  3: [0, 0, 6.50, 6.5]  # the bridge\n";

class Store : public testing::Test {
 protected:
  void SetUp() override {
    auto made = base::TemporaryFolder::Make("editor");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
  }
  fs::path At(const std::string& name) const { return folder_->path() / name; }
  fs::path Written(const std::string& name, const std::string& bytes, const std::string& beside = "") const {
    EXPECT_TRUE(base::WriteWhole(At(name), bytes).ok());
    EXPECT_TRUE(beside.empty() || base::WriteWhole(CompanionPath(At(name)), beside).ok());
    return At(name);
  }
  std::string Text(const fs::path& path) const {
    const auto text = base::ReadText(path);
    return text.ok() ? text.value() : text.error().Text();
  }
  std::size_t Files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_->path()), fs::directory_iterator()));
  }

  std::optional<base::TemporaryFolder> folder_;
};

TEST_F(Store, OpenedAndSavedIsTheSameToTheByte) {
  for (const std::string& bytes : {traffic_map::Figure18(), traffic_map::AppendixA15(), traffic_map::GoodMap()}) {
    const fs::path path = Written("a.motors", bytes, kBeside);
    const auto opened = Open(path);
    ASSERT_TRUE(opened.ok()) << opened.error().Text();
    ASSERT_TRUE(Save(opened.value().document, opened.value().companion, At("b.motors")).ok());
    EXPECT_EQ(Text(At("b.motors")), bytes);
    EXPECT_EQ(Text(At("b.motors.yaml")), kBeside);
  }
  EXPECT_EQ(Files(), 4u) << "nothing else is left";
}

TEST_F(Store, AnEditLeavesEverythingElseToTheByte) {
  const fs::path path = Written("a.motors", traffic_map::AppendixA15(), kBeside);
  auto opened = Open(path);
  ASSERT_TRUE(opened.ok());
  History history(opened.value().document);
  ASSERT_TRUE(history.Do([](Document& d) { return SetStop(d, 1, 4, true); }).ok());
  ASSERT_TRUE(history.Do([](Document& d) { return SetFlow(d, 1, 200.0); }).ok());
  const auto written = Save(history.document(), opened.value().companion, path);
  ASSERT_TRUE(written.ok()) << written.error().Text();
  std::string expected = traffic_map::AppendixA15();
  expected.replace(expected.find("c,1,4,False\n"), 12, "c,1,4,True,0,0,0\n");
  EXPECT_EQ(Text(path), expected);
  EXPECT_EQ(Text(CompanionPath(path)), kBeside + "flows_vehph:\n  1: 200\n");
  history.Undo();
  history.Undo();
  ASSERT_TRUE(Save(history.document(), written.value(), path).ok());
  EXPECT_EQ(Text(path), traffic_map::AppendixA15());
}

TEST_F(Store, AnotherMapsCompanionDoesNotStay) {
  const fs::path path = Written("a.motors", traffic_map::Figure18(), kBeside);
  ASSERT_TRUE(Save(Parsed(traffic_map::GoodMap()), {}, path).ok());
  EXPECT_FALSE(fs::exists(CompanionPath(path)));
  ASSERT_TRUE(Open(path).ok());
}

// No file may be larger than so many bytes: the disk is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(Store, AFullDiskLeavesBothOldFilesWhole) {
  const fs::path path = Written("a.motors", traffic_map::Figure18(), kBeside);
  auto opened = Open(path);
  ASSERT_TRUE(opened.ok());
  History history(opened.value().document);
  ASSERT_TRUE(history.Do([](Document& d) { return SetStop(d, 1, 4, true); }).ok());
  ASSERT_TRUE(history.Do([](Document& d) { return SetHeights(d, 1, {1, 1, 1, 1}); }).ok());
  for (const rlim_t room : {rlim_t{0}, rlim_t{30},
                            rlim_t{300}}) {  // nothing fits; half of the companion; the companion, but half of the map
    base::Result<LoadedCompanion> written = LoadedCompanion{};
    {
      const FullDisk full(room);
      written = Save(history.document(), opened.value().companion, path);
    }
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().exit_status(), 1);
    EXPECT_NE(written.error().Text().find("a.motors: the file cannot be written: File too large"), std::string::npos)
        << written.error().Text();
    EXPECT_EQ(Text(path), traffic_map::Figure18());
    EXPECT_EQ(Text(CompanionPath(path)), kBeside);
    EXPECT_EQ(Files(), 2u);
  }
  EXPECT_TRUE(Save(history.document(), opened.value().companion, path).ok());
}

TEST_F(Store, BrokenForeignAndHugeFilesAreRefused) {
  EXPECT_NE(Open(At("none.motors")).error().Text().find("there is no such file"), std::string::npos);
  EXPECT_NE(Open(folder_->path()).error().Text().find("this is a folder"), std::string::npos);
  EXPECT_NE(Open(Written("a.png", traffic_map::kPng2x1)).error().Text().find("a.png"), std::string::npos);
  EXPECT_NE(Open(Written("bad.motors", traffic_map::GoodMap(), "rodeira: motors/1\nheigths_m: {}\n"))
                .error()
                .Text()
                .find("bad.motors.yaml:2"),
            std::string::npos);
  const fs::path huge = At("huge.motors");
  std::ofstream(huge).put('p');
  fs::resize_file(huge, (std::uintmax_t{1} << 28) + 1);
  EXPECT_NE(Open(huge).error().Text().find("at most 268435456 were expected"), std::string::npos);
}

// Whatever stands in a file: a sentence, or a document that is saved and read again.
TEST_F(Store, MutatedFilesAreRefusedOrEditable) {
  int opened_count = 0;
  for (std::uint64_t number = 0; number < 400; ++number) {
    std::string bytes = traffic_map::Figure18(), beside = kBeside;
    const std::uint64_t times = 1 + base::RandomBits({number, 0}) % 2;
    for (std::uint64_t i = 1; i <= times; ++i) {
      std::string& text = base::RandomBits({number, i, 1}) % 4 == 0 ? beside : bytes;
      const std::size_t at = base::RandomBits({number, i, 2}) % text.size();
      switch (base::RandomBits({number, i, 3}) % 4) {
        case 0:
          text[at] = "0123456789,-pcl\n"[base::RandomBits({number, i, 4}) % 16];
          break;
        case 1:
          text.erase(at, base::RandomBits({number, i, 4}) % 9);
          break;
        case 2:
          text.insert(at, text.substr(base::RandomBits({number, i, 4}) % text.size(), 20));
          break;
        default:
          text.resize(at);
          break;
      }
      if (text.empty()) text = "\n";
    }
    auto opened = Open(Written("m.motors", bytes, beside));
    if (!opened) {
      EXPECT_FALSE(opened.error().Text().empty());
      continue;
    }
    ++opened_count;
    History history(opened.value().document);
    for (const auto& lane : opened.value().document.map.lanes)
      (void)history.Do([&](Document& d) { return SetLane(d, lane.value); });
    (void)history.Do([](Document& d) { return Remove(d, {{}, {3}, {2}, {}}); });
    (void)history.Do([](Document& d) { return NewCurve(d, Straight({0, 0}, {9, 9})); });
    const auto saved = Save(history.document(), opened.value().companion, At("n.motors"));
    ASSERT_TRUE(saved.ok()) << saved.error().Text();
    const auto again = Open(At("n.motors"));
    ASSERT_TRUE(again.ok()) << again.error().Text();
    EXPECT_EQ(BytesOf(again.value().document), BytesOf(history.document()));
    while (history.CanUndo()) history.Undo();
    EXPECT_EQ(traffic_map::WriteMap(history.document().map), bytes);
  }
  EXPECT_GT(opened_count, 40);
}

TEST_F(Store, UnsavedWorkOutlivesAKilledEditor) {
  const Document document = Parsed(traffic_map::Figure18(), kBeside);
  const fs::path kept = At("kept");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto keeper = Keeper::Make(kept);
    const bool good = keeper.ok() && keeper.value().Keep(document, "town.motors", 1).ok() &&
                      keeper.value().Keep(document, "town.motors", 1).ok();
    ::_exit(good ? 7 : 1);  // as if killed: nothing is cleaned up
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(WEXITSTATUS(status), 7);
  auto keeper = Keeper::Make(kept);
  ASSERT_TRUE(keeper.ok()) << keeper.error().Text();
  const auto found = keeper.value().Found();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].of.filename(), "town.motors");
  const auto restored = Keeper::Restore(found[0]);
  ASSERT_TRUE(restored.ok()) << restored.error().Text();
  EXPECT_EQ(BytesOf(restored.value().document), BytesOf(document));
  Keeper::Discard(found[0]);
  EXPECT_TRUE(keeper.value().Found().empty());
}

TEST_F(Store, ALivingEditorsWorkIsItsOwnAndSavedWorkIsForgotten) {
  const fs::path kept = At("kept");
  auto first = Keeper::Make(kept), second = Keeper::Make(kept);
  ASSERT_TRUE(first.ok() && second.ok());
  ASSERT_TRUE(first.value().Keep(Parsed(traffic_map::GoodMap()), "", 1).ok());
  EXPECT_TRUE(second.value().Found().empty());
  first.value().Forget();
  { const Keeper gone(std::move(first).value()); }
  EXPECT_TRUE(second.value().Found().empty());
  EXPECT_EQ(Keeper::Make("/dev/null/x").ok(), false);
}

}  // namespace
}  // namespace rodeira::editor
