// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/config/quoted.hpp"
#include "tests/names.hpp"

namespace rodeira::config {
namespace {

using testing::ElementsAre;

File Parsed(const char* text) {
  auto file = File::Parse(text, "folder/car.yaml");
  EXPECT_TRUE(file.ok());
  return std::move(file).value();
}

TEST(Config, GivesWhatTheFileSays) {
  const File file = Parsed(
      "mass_kg: 1200.5\nname: Seat\nwheels: 4\nabs: true\nbody: {colour: red}\ngears: [3.46, 1.96]\nmesh: "
      "parts/a.obj\n");
  const Map root = file.root();
  EXPECT_EQ(root.Number("mass_kg", Range::Positive()), 1200.5);
  EXPECT_EQ(root.Text("name"), "Seat");
  EXPECT_EQ(root.Integer("wheels", 2, 8), 4);
  EXPECT_TRUE(root.Flag("abs", false));
  EXPECT_EQ(root.Child("body").Choice("colour", {"blue", "red"}), "red");
  EXPECT_EQ(root.Numbers("gears"), (std::vector<double>{3.46, 1.96}));
  EXPECT_EQ(root.Path("mesh"), "folder/parts/a.obj");
  EXPECT_EQ(root.Number("drag_area_m2", {}, 0.5), 0.5);
  EXPECT_TRUE(file.Finish().ok());
}

TEST(Config, AnUnknownKeyIsNamedWithItsLineAndTheNearestName) {
  const File file = Parsed("name: a\nmas_kg: 5\n");
  (void)file.root().Text("name");
  (void)file.root().Number("mass_kg", {}, 1.0);
  const auto status = file.Finish();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().Text(), "folder/car.yaml:2: unknown key 'mas_kg'; did you mean 'mass_kg'?");
}

TEST(Config, AWrongUnitIsNamed) {
  const File file = Parsed("length_cm: 5\n");
  (void)file.root().Number("length_m", {}, 1.0);
  EXPECT_EQ(file.Finish().error().id.text(), "config.unknown_key");
  EXPECT_EQ(file.Finish().error().Text(),
            "folder/car.yaml:1: unknown key 'length_cm'; the unit is part of the name: 'length_m'");
}

TEST(Config, AMissingUnitIsNamed) {
  const File file = Parsed("heading: 5\nx: 1\n");
  (void)file.root().Number("heading_deg", {}, 1.0);
  (void)file.root().Number("heading_of_road", {}, 1.0);
  (void)file.root().Number("x_m", {}, 1.0);
  const auto problems = file.Problems();
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0], IsError("config.unknown_key", "folder/car.yaml:1: … 'heading' … 'heading_deg'"));
  EXPECT_THAT(problems[1], IsError("config.unknown_key", "folder/car.yaml:2: … 'x' … 'x_m'"));
}

TEST(Config, AMisspeltKeyIsNotMissingToo) {
  const auto problems = [](const std::string& text) {
    auto file = File::Parse(text, "car.yaml").value();
    const Map body = file.root().Child("body");
    (void)body.Number("mass_kg");
    (void)body.Child("wheels");
    (void)body.Items("axles");
    return file.Problems();
  };
  const auto unknown = [](const std::string& things) { return IsError("config.unknown_key", things); };
  const std::string rest = "  wheels: {}\n  axles: []\n";
  EXPECT_THAT(problems("body:\n  mas_kg: 1\n" + rest), ElementsAre(unknown("car.yaml:2: … 'body.mas_kg' … 'mass_kg'")));
  EXPECT_THAT(problems("body:\n  mass_t: 1\n" + rest), ElementsAre(unknown("car.yaml:2: … 'body.mass_t' … 'mass_kg'")));
  EXPECT_THAT(
      problems("body:\n  mass_kg: 1\n  wheel: {}\n  axle: []\n"),
      ElementsAre(unknown("car.yaml:3: … 'body.wheel' … 'wheels'"), unknown("car.yaml:4: … 'body.axle' … 'axles'")));
  EXPECT_THAT(problems("body:\n" + rest), ElementsAre(IsError("config.missing_key", "car.yaml:2: … 'body.mass_kg'")))
      << "what is just missing is said";
}

TEST(Config, EveryProblemIsCollectedInTheOrderOfLines) {
  const File file = Parsed("a_m: -1\nb_m: long\nc: {d: 1, d: 2}\ne: [1, x]\nf: violet\n");
  const Map root = file.root();
  (void)root.Choice("f", {"violin", "red"});
  (void)root.Number("b_m");
  (void)root.Number("a_m", Range::NotNegative());
  (void)root.Child("c").Integer("d", 0, 9);
  (void)root.Numbers("e");
  (void)root.Number("g_m");
  std::vector<std::string> texts, ids;
  for (const auto& problem : file.Problems()) {
    texts.push_back(problem.Text());
    ids.emplace_back(problem.id.text());
  }
  EXPECT_EQ(ids, (std::vector<std::string>{"config.out_of_range", "config.missing_key", "config.wrong_type",
                                           "config.duplicate_key", "config.wrong_type", "config.unknown_word"}));
  EXPECT_EQ(texts, (std::vector<std::string>{
                       "folder/car.yaml:1: 'a_m' is -1; a number at least 0 was expected",
                       "folder/car.yaml:1: key 'g_m' is missing; a number was expected",
                       "folder/car.yaml:2: 'b_m' is 'long'; a number was expected",
                       "folder/car.yaml:3: key 'c.d' appears twice",
                       "folder/car.yaml:4: item 2 of 'e' is 'x'; a number finite was expected",
                       "folder/car.yaml:5: 'f' is 'violet'; did you mean 'violin'?",
                   }));
}

TEST(Config, RefusesWhatIsNoMapping) {
  EXPECT_EQ(File::Parse("- 1\n", "x.yaml").error().id.text(), "config.not_mapping");
  EXPECT_EQ(File::Parse("a: [1\n", "x.yaml").error().id.text(), "config.not_yaml");
  EXPECT_EQ(File::Parse("a: [1\n", "x.yaml").error().context.find("x.yaml:"), 0u);
  EXPECT_EQ(File::Load("/no/such/file.yaml").error().id.text(), "file.not_found");
  EXPECT_EQ(File::Load("/no/such/file.yaml").error().context, "/no/such/file.yaml");
  EXPECT_EQ(File::Parse("", "x.yaml").error().code, base::ErrorCode::kWrongInput);
}

// A tab is not seen in an editor; the library's own message does not name it.
TEST(Config, ATabAsIndentationIsNamedWithItsLine) {
  for (const char* text : {"a: 1\nb:\n\tc: 2\n", "b:\n  - c: 2\n\td: 3\n", "a: 1\n \tb: {c: 2}\n"}) {
    const auto file = File::Parse(text, "dir/a.yaml");
    ASSERT_FALSE(file.ok()) << text;
    const int line = text[0] == 'a' && text[5] == ' ' ? 2 : 3;
    EXPECT_EQ(file.error().Text(), "dir/a.yaml:" + std::to_string(line) +
                                       ": this is no YAML: a tab indents this line; spaces were expected");
  }
  EXPECT_TRUE(File::Parse("a: {b: 1}\t# a tab before a remark\n", "a.yaml").ok());
}

// A recording that is named where a launch file is wanted.
TEST(Config, AFileOfAnotherKindIsNamedWithWhatTakesIt) {
  EXPECT_THAT(File::Parse(std::string("\x89MCAP0\r\n\0", 9), "p07.mcap").error(),
              IsError("config.not_text", "p07.mcap: … recording … rodeira replay p07.mcap"));
  EXPECT_THAT(File::Parse("<?xml version='1.0'?><OpenDRIVE/>", "a.xodr").error().Text(), Names("OpenDRIVE"));
  const File world = File::Parse("name: a\nrodeira: world/2\nroads: {}\n", "a.yaml").value();
  (void)world.root().Choice("rodeira", {"launch/1"});
  (void)world.root().Child("nodes");
  EXPECT_EQ(
      world.Finish().error().Text(),
      "a.yaml:2: 'rodeira' is 'world/2'; 'launch/1' was expected; this is a world; rodeira world info a.yaml; run "
      "in it: rodeira run LAUNCH.yaml --set world=a.yaml");
  const File other = File::Parse("rodeira: launch/9\n", "a.yaml").value();
  (void)other.root().Choice("rodeira", {"launch/1"});
  EXPECT_EQ(other.Finish().error().id, base::ErrorId("config.unknown_word")) << "the same kind";
}

TEST(Config, NestingIsBounded) {
  for (const std::size_t depth : {1000u, 100'000u}) {
    for (const char* open : {"[", "{a: ", "- ", "? "}) {
      std::string text = "a:\n  ";
      for (std::size_t i = 0; i < depth; ++i) text += open;
      const auto file = File::Parse(text, "x.yaml");
      ASSERT_FALSE(file.ok());
      EXPECT_EQ(file.error().id.text(), "config.not_yaml") << file.error().Text();
      EXPECT_EQ(file.error().context, "x.yaml:2");
    }
    const std::string closed = "a: " + std::string(depth, '[') + std::string(depth, ']') + "\n";
    EXPECT_EQ(File::Parse(closed, "x.yaml").error().Text(),
              "x.yaml:1: this is nested too deeply: lists and mappings lie in one another, 500 levels are too many");
  }
  EXPECT_TRUE(File::Parse("a: " + std::string(200, '[') + std::string(200, ']') + "\n", "x.yaml").ok());
  File file = Parsed("a: 1\n");
  EXPECT_NE(file.Override("a", std::string(1000, '[')).error().Text().find("the value is nested too deeply"),
            std::string::npos);
}

TEST(Config, AnOverrideByNothingTakesAKeyOut) {
  auto file = File::Parse("a: 1\nb: {c: 2, d: 3}\n", "x.yaml").value();
  ASSERT_TRUE(file.Override("b.c", "~").ok());
  ASSERT_TRUE(file.Override("b.none", "~").ok());
  EXPECT_FALSE(file.root().Child("b").Has("c"));
  EXPECT_EQ(file.root().Child("b").Integer("d", 0, 9), 3);
  EXPECT_EQ(file.root().Integer("a", 0, 9), 1);
  EXPECT_TRUE(file.Finish().ok());
}

// What is wrong in it stands in no line of the file: the option said it.
TEST(Config, WhatAnOverrideSaysWrongIsTheOptions) {
  File file = Parsed("a: 1\nb: {c: 2}\n");
  ASSERT_TRUE(file.Override("b", "{c: 3, list: [1, x], inner: {odd: 1}}").ok());
  (void)file.root().Number("a");
  const Map b = file.root().Child("b");
  EXPECT_EQ(b.Number("c"), 3.0);
  (void)b.Items("list").Number(1);
  (void)b.Child("inner").Number("even", {}, 1.0);
  const auto problems = file.Problems();
  ASSERT_EQ(problems.size(), 2u);
  for (const base::Error& problem : problems)
    EXPECT_EQ(problem.context, "--set b={c: 3, list: [1, x], inner: {odd: 1}}") << problem.Text();
  EXPECT_EQ(b.Child("inner").Place("odd"), problems.front().context);
}

// A value, a key that it makes, a key that it takes out, and the last of two; what the file says keeps its line.
TEST(Config, EachProblemIsAtTheOptionOrTheLineThatMadeIt) {
  const auto places = [](const std::vector<std::pair<std::string, std::string>>& overrides) {
    File file = Parsed("seed: 1\nrun: {name: a, pace: 1}\nother: 2\n");
    for (const auto& [key, value] : overrides) EXPECT_TRUE(file.Override(key, value).ok());
    const Map root = file.root(), run = root.Child("run");
    (void)root.Integer("seed", 0, 9);
    (void)run.Text("name");
    (void)run.Number("pace", {0.0, 2.0});
    (void)root.Number("other", {0.0, 1.0});
    (void)root.OptionalChild("limits").Number("step_s", {}, 1.0);
    std::vector<std::string> found;
    for (const base::Error& problem : file.Problems()) found.push_back(problem.context);
    return found;
  };
  using Places = std::vector<std::string>;
  const std::string line = "folder/car.yaml:3";
  EXPECT_EQ(places({}), Places{line});
  EXPECT_EQ(places({{"seed", "abc"}}), (Places{"--set seed=abc", line}));
  EXPECT_EQ(places({{"seed", "2"}, {"seed", "12"}}), (Places{"--set seed=12", line}));
  EXPECT_EQ(places({{"run.pace", "[3]"}}), (Places{"--set run.pace=[3]", line}));
  EXPECT_EQ(places({{"run.name", "~"}}), (Places{"--set run.name=~", line}));
  EXPECT_EQ(places({{"run", "{name: b, pace: 3}"}}), (Places{"--set run={name: b, pace: 3}", line}));
  EXPECT_EQ(places({{"limits.step_s", "x"}}), (Places{"--set limits.step_s=x", line}));
  EXPECT_EQ(places({{"lmits.step_s", "1"}}), (Places{"--set lmits.step_s=1", line}));
  EXPECT_EQ(places({{"run.nme", "1"}}), (Places{"--set run.nme=1", line}));
  EXPECT_EQ(places({{"othre", "1"}}), (Places{"--set othre=1", line}));
}

TEST(Config, OverridesReplaceAndAdd) {
  File file = Parsed("a: 1\nb: {c: 2}\n");
  ASSERT_TRUE(file.Override("a", "5").ok());
  ASSERT_TRUE(file.Override("b.c", "6").ok());
  ASSERT_TRUE(file.Override("b.d.e", "[1, 2]").ok());
  EXPECT_EQ(file.root().Number("a"), 5.0);
  EXPECT_EQ(file.root().Child("b").Number("c"), 6.0);
  EXPECT_EQ(file.root().Child("b").Child("d").Numbers("e").size(), 2u);
  EXPECT_TRUE(file.Finish().ok());
  EXPECT_EQ(file.Override("a.x", "1").error().Text(), "--set a.x=1: 'a' is '5', no mapping");
  ASSERT_TRUE(file.Override("a", "car.yaml").ok());
  EXPECT_EQ(file.Override("a.x", "1").error().Text(),
            "--set a.x=1: 'a' is 'car.yaml', no mapping; change the key in a copy of that file");
  EXPECT_FALSE(file.Override("a..x", "1").ok());
  EXPECT_FALSE(file.Override("a", "[1").ok());
}

// A key that may stand there and does not is known where another is misspelt, and what is misspelt comes before what is
// missing.
TEST(Config, WhatMayStandThereIsAmongTheNamesThatAreNear) {
  const auto file = File::Parse("throtle: 1\nframes: {fsp: 25}\n", "wheel.yaml");
  ASSERT_TRUE(file.ok());
  const Map root = file.value().root();
  EXPECT_FALSE(root.Has("throttle"));
  const Map frames = root.Child("frames");
  EXPECT_FALSE(frames.Has("fps"));
  (void)frames.Text("times_s");
  const auto problems = file.value().Problems();
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_NE(problems[0].Text().find("unknown key 'throtle'; did you mean 'throttle'?"), std::string::npos)
      << problems[0].Text();
  EXPECT_NE(problems[1].Text().find("unknown key 'frames.fsp'; did you mean 'fps'?"), std::string::npos)
      << problems[1].Text();
  EXPECT_NE(problems[2].Text().find("key 'frames.times_s' is missing"), std::string::npos) << problems[2].Text();
}

TEST(Config, WhatIsLeftToOthersIsNotUnknown) {
  const File file = Parsed("mine: 1\nyours: {x: 1}\n");
  (void)file.root().Number("mine");
  file.root().IgnoreKey("yours");
  EXPECT_TRUE(file.Finish().ok());
}

TEST(Config, PeekingAsksForNothing) {
  const File file = Parsed("yours: {x: {y: here}, z: 1}\nlist: [1]\n");
  const Map root = file.root();
  root.IgnoreKey("yours");
  root.IgnoreKey("list");
  EXPECT_EQ(root.Peek({"yours", "x", "y"}), "here");
  EXPECT_EQ(root.Peek({"yours", "z"}), "1");
  EXPECT_FALSE(root.Peek({"yours", "x"}).has_value()) << "no text";
  EXPECT_FALSE(root.Peek({"yours", "w", "y"}).has_value());
  EXPECT_FALSE(root.Peek({"list", "x"}).has_value());
  EXPECT_TRUE(file.Finish().ok()) << "what stands in yours is not ours to judge";
}

TEST(Config, NumbersAreNeverInfinite) {
  const File file = Parsed("a: .inf\nb: nan\nc: 1e999\n");
  for (const char* key : {"a", "b", "c"}) (void)file.root().Number(key);
  EXPECT_EQ(file.Problems().size(), 3u);
}

std::string Refusal(const std::string& text) {
  const auto file = File::Parse(text, "x.yaml");
  return file.ok() ? "" : file.error().Text();
}

TEST(Yaml, AnAliasStandsForItsValues) {
  const File file = Parsed("front: &axle {track_m: 1.5}\nrear: *axle\nagain: [*axle, *axle]\n");
  EXPECT_EQ(file.root().Child("rear").Number("track_m"), 1.5);
}

TEST(Yaml, AnAliasInsideOfWhatItStandsForIsRefused) {
  const std::string why = "an alias refers to a list or mapping that it is part of";
  EXPECT_NE(Refusal("a: 1\nb: &b [*b, 2]\n").find("x.yaml:2: this is no YAML: " + why), std::string::npos)
      << Refusal("a: 1\nb: &b [*b, 2]\n");
  EXPECT_NE(Refusal("b: &b {c: {d: *b}}\n").find(why), std::string::npos);
  EXPECT_NE(Refusal("&root\nb: [1, *root]\n").find(why), std::string::npos);
  EXPECT_EQ(Refusal("b: &b [1, 2]\nc: [*b, *b]\n"), "");
}

TEST(Yaml, AliasesThatGrowWithoutBoundAreRefused) {
  std::string text = "a0: &a0 [1, 1]\n";
  for (int i = 1; i < 60; ++i)
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + ", *a" +
            std::to_string(i - 1) + "]\n";
  EXPECT_NE(Refusal(text).find("aliases stand for more than 100000 values"), std::string::npos) << Refusal(text);
}

TEST(Yaml, ASecondDocumentIsRefused) {
  EXPECT_NE(Refusal("a: 1\n---\nb: 2\n").find("a second document begins here; one was expected"), std::string::npos);
  EXPECT_EQ(Refusal("---\na: 1\n...\n"), "");
}

TEST(Yaml, AValueThatRefersToItselfIsRefused) {
  File file = Parsed("seed: 1\n");
  const auto status = file.Override("seed", "&a [*a, *a]");
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().Text().find("an alias refers to"), std::string::npos) << status.error().Text();
}

// Whatever a path or a name holds: as part of a YAML text it is the same bytes again.
TEST(Quoted, AnyTextIsReadBackAsItWas) {
  std::vector<std::string> texts = {"",     "plain",  "it's",       "a \"b\"",  "C:\\x",  "a: b", "[x], {y}",
                                    "# no", "*alias", "&anchor",    "\ttab\n",  "\\n",    "~",    "true",
                                    "12",   "%YAML",  "---\n...\n", " spaces ", "é ü 漢", "\r\n", "a\\\\b"};
  for (std::uint64_t n = 0; n < 2000; ++n) {
    std::string text;
    for (std::uint64_t i = 0; i < n % 20; ++i) text += static_cast<char>(base::RandomBits({n, i}) % 128);
    texts.push_back(text);
  }
  for (const std::string& text : texts) {
    EXPECT_EQ(Unquoted(Quoted(text)), text) << Quoted(text);
    if (text.find('\0') != std::string::npos) continue;  // no path or name holds it
    const auto file = File::Parse("value: " + Quoted(text) + "\n", "x.yaml");
    ASSERT_TRUE(file.ok()) << Quoted(text) << ": " << file.error().Text();
    EXPECT_EQ(file.value().root().Text("value"), text) << Quoted(text);
    File changed = Parsed("value: 1\n");
    ASSERT_TRUE(changed.Override("value", Quoted(text)).ok()) << Quoted(text);
    EXPECT_EQ(changed.root().Text("value"), text) << Quoted(text);
  }
  for (const char* other : {"", "\"", "plain", "\"a", "\"a\"b\"", "\"\\\"", "\"\\q\"", "\"\\x1\""})
    EXPECT_FALSE(Unquoted(other)) << other;
}

// The values go into recordings; all texts there are UTF-8.
TEST(Utf8, AFileInAnotherEncodingIsRefusedWithItsLine) {
  const auto file = File::Parse("a: 1\nb: gr\xFC\xDF\n", "x.yaml");
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().Text(),
            "x.yaml:2: byte 0xfc is not UTF-8; YAML in UTF-8 was expected; save the file as UTF-8");
  EXPECT_TRUE(File::Parse("a: 1\nb: gr\xC3\xBC\xC3\x9F\n", "x.yaml").ok());
}

}  // namespace
}  // namespace rodeira::config
