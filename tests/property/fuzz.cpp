#include "tests/property/fuzz.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/property/mutate.hpp"

namespace rodeira::property {
namespace {

constexpr unsigned kHangSeconds = 60;

// Which text is being read, said where that ends the process.
char g_now[128] = "";
void SayAndDie(int number) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, g_now, std::char_traits<char>::length(g_now));
  ::signal(number, SIG_DFL);
  ::raise(number);
}

}  // namespace

std::size_t Setting(const char* name, std::size_t otherwise) {
  const char* set = std::getenv(name);
  return set == nullptr ? otherwise : static_cast<std::size_t>(std::strtoull(set, nullptr, 10));
}

void ExpectSentence(const base::Error& error) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_FALSE(error.context.empty()) << error.message;
  EXPECT_EQ(error.exit_status(), 2) << error.Text();
  for (const char c : error.Text()) EXPECT_FALSE((c >= 0 && c < 0x20) || c == 0x7F) << "a control character in: " << error.Text();
}

void Fuzz(const char* format, const std::vector<std::string>& good, const Read& read) {
  for (const int number : {SIGALRM, SIGABRT, SIGFPE, SIGSEGV}) ::signal(number, SayAndDie);
  for (const std::string& text : good) {
    const auto error = read(text);
    ASSERT_FALSE(error) << error->Text();
  }
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 2000);
  std::size_t accepted = 0;
  for (std::size_t number = first; number < first + count; ++number) {
    Draw draw(number);
    std::string text = good[draw.Below(good.size())];
    for (std::size_t mutations = 1 + draw.Below(3); mutations > 0; --mutations) Mutate(text, draw);
    std::snprintf(g_now, sizeof(g_now), "%s, text %zu (RODEIRA_FUZZ_FIRST=%zu RODEIRA_FUZZ_FILES=1)\n", format, number, number);
    if (Setting("RODEIRA_FUZZ_SHOW", 0) != 0) std::fprintf(stderr, "%s%s\n", g_now, text.c_str());
    ::alarm(kHangSeconds);
    const auto error = read(text);
    ::alarm(0);
    if (error) ExpectSentence(*error);
    else ++accepted;
    if (testing::Test::HasFailure()) FAIL() << g_now << text;
  }
  if (count < 1000) return;
  EXPECT_GT(accepted, count / 50) << "the mutations are so wild that all is refused at the door";
  EXPECT_LT(accepted, count - count / 5) << "the mutations are so mild that nearly all is accepted";
}

}  // namespace rodeira::property
