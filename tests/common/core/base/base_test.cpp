// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>

#include "common/core/base/bytes.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/hash.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/printable.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/base/state_fields.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::base {
namespace {

TEST(Hash, IsXxh3) {
  // Published values of XXH3-64 with seed 0: of nothing, and of "abc" (xxhash's own command-line tool).
  EXPECT_EQ(Hash(std::string_view()), 0x2d06800538d394c2ull);
  EXPECT_EQ(Hash(std::string_view("abc")), 0x78af5f94892f3950ull);
  EXPECT_EQ(Hex(0x2dull), "000000000000002d");
  EXPECT_NE(Combine(1, 2), Combine(2, 1));
}

TEST(Bytes, ReadingPastTheEndIsSeenAndHarmless) {
  ByteWriter out;
  out.Put(std::uint16_t{7});
  out.PutString("key");
  ByteReader in(out.bytes());
  EXPECT_EQ(in.Get<std::uint16_t>(), 7);
  EXPECT_EQ(in.GetString(), "key");
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.Get<double>(), 0.0);
  EXPECT_FALSE(in.ok());
  EXPECT_TRUE(in.GetRaw(1).empty());
}

struct Part {
  double x = 0.0;
  std::vector<std::int32_t> list;
  void Save(StateWriter& out) const {
    out.Put("x", x);
    out.Put("list", list);
  }
  void Restore(StateReader& in) {
    in.Get("x", x);
    in.Get("list", list);
  }
};

// A field that is written only where it is needed: a reader asks for it, and nothing is read by that.
TEST(State, AReaderAsksForTheNextField) {
  StateWriter with, without;
  for (StateWriter* writer : {&with, &without}) writer->Put("speed", 3.0);
  with.Put("wind", 2.0);
  StateReader found(with.bytes()), absent(without.bytes());
  double speed = 0.0, wind = 0.0;
  EXPECT_FALSE(found.Has("wind")) << "another field is next";
  EXPECT_TRUE(found.Has("speed"));
  found.Get("speed", speed);
  EXPECT_TRUE(found.Has("wind"));
  EXPECT_TRUE(found.Has("wind")) << "asked twice";
  found.Get("wind", wind);
  EXPECT_EQ(wind, 2.0);
  EXPECT_FALSE(found.Has("wind"));
  EXPECT_TRUE(found.Finish().ok());
  absent.Get("speed", speed);
  EXPECT_FALSE(absent.Has("wind"));
  EXPECT_TRUE(absent.Finish().ok());
  absent.Get("wind", wind);
  EXPECT_FALSE(absent.Has("wind")) << "after an error";
  EXPECT_FALSE(absent.Finish().ok());
}

TEST(State, ComesBackAsItWas) {
  const Part part{2.5, {1, -2, 3}};
  const std::array<double, 2> pair{4.0, 5.0};
  StateWriter out;
  out.Put("part", part);
  out.Put("pair", std::span<const double>(pair));
  out.Put("name", std::string("x"));
  Part back;
  std::array<double, 2> pair_back{};
  std::string name;
  StateReader in(out.bytes());
  in.Get("part", back);
  in.Get("pair", std::span<double>(pair_back));
  in.Get("name", name);
  ASSERT_TRUE(in.Finish().ok());
  EXPECT_EQ(back.x, part.x);
  EXPECT_EQ(back.list, part.list);
  EXPECT_EQ(pair_back, pair);
  EXPECT_EQ(name, "x");
}

TEST(State, AFieldThatDoesNotFitIsNamed) {
  StateWriter out;
  out.Put("speed_mps", 1.0);
  double value = 0.0;
  StateReader in(out.bytes());
  in.Get("speed_kmh", value);
  EXPECT_EQ(in.Finish().error().message, "state field 'speed_kmh' was expected, found field 'speed_mps'");
  StateReader cut(std::span(out.bytes()).first(out.bytes().size() - 1));
  cut.Get("speed_mps", value);
  EXPECT_FALSE(cut.Finish().ok());
  StateReader left(out.bytes());
  EXPECT_FALSE(left.Finish().ok());
}

TEST(State, SaysItsFieldsAndWhereTwoDiffer) {
  const auto state = [](double x, std::int8_t third, const std::string& name) {
    StateWriter out;
    out.Put("steps", std::uint64_t{7});
    out.Put("part", Part{x, {1, -2, third}});
    out.Put("name", name);
    return out.bytes();
  };
  const auto fields = StateFields(state(0.1, 3, "abc"));
  ASSERT_TRUE(fields.ok());
  const std::vector<StateField> expected{{"steps", "7"},        {"part.x", "0.1"},      {"part.list.size", "3"},
                                         {"part.list[0]", "1"}, {"part.list[1]", "-2"}, {"part.list[2]", "3"},
                                         {"part.name", "abc"}};
  EXPECT_EQ(fields.value(), expected);
  const Bytes one = state(0.1, 3, "abc");
  EXPECT_FALSE(FirstStateDifference(one, one).value().has_value());
  const auto x = FirstStateDifference(one, state(0.1 + 2e-17, 4, "abc")).value();
  EXPECT_EQ(x->path, "part.x");
  EXPECT_EQ(x->first + " " + x->second, "0.1 0.10000000000000002");
  EXPECT_EQ(FirstStateDifference(one, state(0.1, 4, "abd")).value()->path, "part.list[2]");
  for (std::size_t size = 0; size < one.size(); ++size)
    (void)StateFields(std::span(one).first(size));  // never beyond its end
  EXPECT_FALSE(StateFields(std::span(one).first(one.size() - 1)).ok());
}

TEST(State, TheDigestNeedsNoNames) {
  StateWriter a(StateWriter::Names::kWithout);
  StateWriter b(StateWriter::Names::kWithout);
  a.Put("x", 1.0);
  b.Put("y", 1.0);
  EXPECT_EQ(a.digest(), b.digest());
  b.Put("z", true);
  EXPECT_NE(a.digest(), b.digest());
}

TEST(Random, DrawsDependOnTheirKeysAlone) {
  EXPECT_EQ(RandomBits({1, 2, 3}), RandomBits({1, 2, 3}));
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 100; ++i) {
    for (std::uint64_t j = 0; j < 100; ++j) seen.insert(RandomBits({i, j}));
  }
  EXPECT_EQ(seen.size(), 10000u);
}

TEST(Random, IsUniform) {
  // Chi-square over 100 cells, 100 000 draws: 99 degrees of freedom, mean 99, deviation 14; 5 deviations allowed.
  std::array<int, 100> cells{};
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double u = RandomUniform({42, 7, i});
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    ++cells[static_cast<std::size_t>(u * 100.0)];
  }
  double chi_square = 0.0;
  for (const int count : cells) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_GT(chi_square, 99.0 - 5 * 14.1);
  EXPECT_LT(chi_square, 99.0 + 5 * 14.1);
  EXPECT_NEAR(sum / 100000.0, 0.5, 5 * 0.2887 / 316.2);
}

TEST(Suggest, NamesTheNearest) {
  EXPECT_EQ(NearestName("mas_kg", std::vector<std::string>{"name", "mass_kg"}), "mass_kg");
  EXPECT_EQ(NearestName("pedal", std::vector<std::string>{"zebra"}), "");
  EXPECT_EQ(DidYouMean("vehcile", {"traffic", "vehicle"}), "; did you mean 'vehicle'?");
  EXPECT_EQ(DidYouMean("xyz", {"traffic", "vehicle"}), "; known are traffic, vehicle");
  EXPECT_EQ(DidYouMean("xyz", {"traffic", "vehicle", "traffic"}), "; known are traffic, vehicle");
}

TEST(Files, AreWrittenWholeOrNotAtAll) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-files-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto path = folder / "a.txt";
  ASSERT_TRUE(WriteWhole(path, std::string_view("one")).ok());
  EXPECT_EQ(ReadText(path).value(), "one");
  const auto refused = WriteWhole(folder / "a.txt" / "b", std::string_view("two"));
  EXPECT_FALSE(refused.ok());
  EXPECT_EQ(ReadText(path).value(), "one");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++entries;
  EXPECT_EQ(entries, 1u);
  EXPECT_NE(ReadText(path, 2).error().message.find("3 bytes"), std::string::npos);
  EXPECT_NE(ReadText(folder).error().message.find("folder"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(Files, WhatComesThroughAPipeIsReadToItsEnd) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string text(20000, 'x');  // less than a pipe holds
  const auto send = [&] { ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size())); };
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  send(), send();
  int other[2];
  ASSERT_EQ(::pipe(other), 0);
  ASSERT_EQ(::write(other[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]), ::close(other[1]);
  EXPECT_EQ(ReadText(path).value(), text + text);
  EXPECT_EQ(ReadText("/dev/fd/" + std::to_string(other[0]), 10).error().message,
            "more than the 10 bytes that were expected at most came");
  ::close(ends[0]), ::close(other[0]);
}

TEST(Printable, WhatATerminalWouldExecuteBecomesVisible) {
  EXPECT_EQ(Printable("Régua to Pinhão, 3 µs …"), "Régua to Pinhão, 3 µs …");
  EXPECT_EQ(Printable("a\nb\tc\x1b[31m\x7f"), "a\\nb\\tc\\x1b[31m\\x7f");
  EXPECT_EQ(Printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(Printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");               // a control sequence in one character
  EXPECT_EQ(Printable("\xc3("), "\\xc3(");  // cut short
  EXPECT_EQ(Printable("\xc0\xaf \xed\xa0\x80 \xf5"),
            "\\xc0\\xaf \\xed\\xa0\\x80 \\xf5");  // overlong, surrogate, beyond Unicode
  EXPECT_EQ(Printable(std::string(5000, 'x'), 10), "xxxxxxxxxx…");
  EXPECT_EQ(WrongInput("file.not_found", "'a\nb' was found", "file\n:3").Text(), "file\\n:3: 'a\\nb' was found");
}

// An id is a known scope, a dot, and lower-case words that are joined by '_'.
TEST(ErrorId, HasOneForm) {
  EXPECT_TRUE(ErrorId::IsId("config.unknown_key"));
  EXPECT_TRUE(ErrorId::IsId("fmu.other_version2"));
  for (const char* wrong : {"", "config", "config.", ".unknown_key", "house.unknown_key", "config.Unknown",
                            "config._key", "config.key_", "config.a__b", "config.a b", "config.a.b"})
    EXPECT_FALSE(ErrorId::IsId(wrong)) << wrong;
  constexpr ErrorId id = "config.unknown_key";
  EXPECT_EQ(id.text(), "config.unknown_key");
  EXPECT_EQ(id.scope(), "config");
}

// An error that is told again at another place, or in other words, keeps its id and its exit status.
TEST(Error, KeepsIdAndStatusWhenItIsToldAgain) {
  const Error error = Failed("file.cannot_open", "cannot open", "a.yaml:3");
  for (const Error& told : {error.WithContext("b.yaml"), error.In("node 'x'"), error.WithMessage("no file")}) {
    EXPECT_EQ(told.id, ErrorId("file.cannot_open"));
    EXPECT_EQ(told.exit_status(), 1);
  }
  EXPECT_EQ(error.WithContext("b.yaml").Text(), "b.yaml: cannot open");
  EXPECT_EQ(error.In("node 'x'").Text(), "node 'x': a.yaml:3: cannot open");
  EXPECT_EQ(error.WithMessage("no file").Text(), "a.yaml:3: no file");
}

TEST(Files, AMissingFileIsSaidWithTheNearestBesideIt) {
  auto folder = TemporaryFolder::Make("test");
  ASSERT_TRUE(folder.ok());
  const auto in = [&](const char* name) { return folder.value().path() / name; };
  ASSERT_TRUE(WriteWhole(in("demo.yaml"), std::string_view("x")).ok());
  ASSERT_TRUE(WriteWhole(in("dmeo.mcap"), std::string_view("x")).ok());
  EXPECT_EQ(ReadText(in("dmeo.yaml")).error().message, "there is no such file; did you mean 'demo.yaml'?");
  EXPECT_EQ(ReadText(in("something else.yaml")).error().message, "there is no such file");
  EXPECT_EQ(ReadText("/no/such/dmeo.yaml").error().message, "there is no such file");
  std::filesystem::create_symlink("moved.yaml", in("link.yaml"));
  EXPECT_EQ(ReadText(in("link.yaml")).error().message, "this is a link to 'moved.yaml', which is not there");
}

TEST(Mathematics, TheDigestIsTheSameTwice) { EXPECT_EQ(MathLibraryFingerprint(), MathLibraryFingerprint()); }

std::string DigestOfAProgram(const std::string& environment) {
  const std::string command = environment + " " + BinaryDir() + "/bin/mathematics_digest";
  FILE* pipe = ::popen(command.c_str(), "r");
  char text[64] = {};
  const bool read = std::fgets(text, sizeof(text), pipe) != nullptr;
  EXPECT_EQ(::pclose(pipe), 0);
  EXPECT_TRUE(read);
  return text;
}

// Law L7: the fixed choice of code is what makes machines agree. Where this processor has FMA, the library's own
// choice gives other bits, and the digest sees it.
TEST(Mathematics, TheFixedChoiceDiffersFromTheProcessorsOwn) {
  const std::string fixed = DigestOfAProgram("env -u GLIBC_TUNABLES");
  EXPECT_EQ(fixed, DigestOfAProgram("GLIBC_TUNABLES=glibc.malloc.check=0"));
  std::ifstream cpuinfo("/proc/cpuinfo");
  const std::string flags((std::istreambuf_iterator<char>(cpuinfo)), {});
  if (flags.find(" fma ") == std::string::npos) GTEST_SKIP() << "this processor has no FMA: there is but one choice";
  EXPECT_NE(fixed, DigestOfAProgram("env -u GLIBC_TUNABLES RODEIRA_TEST_KEEP_MATHEMATICS=1"));
}

// The program that sets the choice for its children has not got it itself.
TEST(Mathematics, TheChoiceForChildrenIsTheirs) {
  const std::string fixed = DigestOfAProgram("env -u GLIBC_TUNABLES");
  const auto set_and_ask = [&] {
    ::unsetenv("GLIBC_TUNABLES");
    PinMathLibraryOfChildren();
    return !MathematicsFixed() && DigestOfAProgram("RODEIRA_TEST_KEEP_MATHEMATICS=1") == fixed;
  };
  EXPECT_EXIT(std::exit(set_and_ask() ? 0 : 1), ::testing::ExitedWithCode(0), "");
}

TEST(TemporaryFolder, IsItsOwnAndGoneAtTheEnd) {
  std::filesystem::path first;
  {
    auto one = TemporaryFolder::Make("test");
    auto other = TemporaryFolder::Make("test");
    ASSERT_TRUE(one.ok() && other.ok());
    first = one.value().path();
    EXPECT_NE(first, other.value().path());
    EXPECT_TRUE(first.filename().string().starts_with("rodeira-test-")) << first;
    std::filesystem::create_directories(first / "a/b");
    const TemporaryFolder moved = std::move(one).value();
    EXPECT_TRUE(std::filesystem::exists(moved.path() / "a/b"));
  }
  EXPECT_FALSE(std::filesystem::exists(first));
}

}  // namespace
}  // namespace rodeira::base
