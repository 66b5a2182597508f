// SPDX-License-Identifier: Apache-2.0
#include "tests/property/fuzz.hpp"

#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdio>

#include "tests/property/last_words.hpp"

namespace rodeira::property {
namespace {

// Of the processor: a loaded machine is not a hang. By the clock for what waits.
constexpr unsigned kHangSeconds = 60, kStuckSeconds = 1200;

void LimitTime(unsigned processor_s, unsigned clock_s) {
  itimerval limit{};
  limit.it_value.tv_sec = processor_s;
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  ::alarm(clock_s);
}

}  // namespace

void ExpectSentence(const base::Error& error) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_FALSE(error.context.empty()) << error.message;
  EXPECT_EQ(error.exit_status(), 2) << error.Text();
  for (const char c : error.Text())
    EXPECT_FALSE((c >= 0 && c < 0x20) || c == 0x7F) << "a control character in: " << error.Text();
}

void Fuzz(const char* format, const std::vector<std::string>& good, const Read& read, const Change& change) {
  SayWhereItDies();
  for (const std::string& text : good) {
    const auto error = read(text);
    ASSERT_FALSE(error) << error->Text();
  }
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 400);
  std::size_t accepted = 0;
  for (std::size_t number = first; number < first + count; ++number) {
    Draw draw(number);
    std::string text = good[draw.Below(good.size())];
    for (std::size_t mutations = 1 + draw.Below(3); mutations > 0; --mutations) change(text, draw);
    NowTrying(std::string(format) + ", text", number);
    if (Setting("RODEIRA_FUZZ_SHOW", 0) != 0) std::fprintf(stderr, "%s%s\n", g_last_words, text.c_str());
    LimitTime(kHangSeconds, kStuckSeconds);
    const auto error = read(text);
    LimitTime(0, 0);
    if (error)
      ExpectSentence(*error);
    else
      ++accepted;
    if (testing::Test::HasFailure()) FAIL() << g_last_words << text;
  }
  if (count < 400) return;
  EXPECT_GT(accepted, count / 50) << "the mutations are so wild that all is refused at the door";
  EXPECT_LT(accepted, count - count / 5) << "the mutations are so mild that nearly all is accepted";
}

}  // namespace rodeira::property
