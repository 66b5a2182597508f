// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/exhaustion.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "common/core/base/open_error.hpp"

namespace rodeira::base {
namespace {

template <class Exception>
void ThrowOnAThread(const Exception& exception) {
  NameExhaustion("rodeira-test");
  std::thread([&exception] { throw exception; }).join();
}

TEST(Exhaustion, OfMemoryAndThreadsIsASentenceAndStatus1OnAnyThread) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(ThrowOnAThread(std::bad_alloc()), ::testing::ExitedWithCode(1), "^rodeira-test: the memory that");
  EXPECT_EXIT(ThrowOnAThread(std::system_error(EAGAIN, std::generic_category())), ::testing::ExitedWithCode(1),
              "^rodeira-test: no further thread can be started");
}

TEST(Exhaustion, WhereALibraryWaitsForEverIsTheSentenceOfTheCaller) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        NameExhaustion("rodeira-test");
        EndExhausted("a library waits");
      },
      ::testing::ExitedWithCode(1), "^rodeira-test: a library waits; `rodeira repair`");
}

TEST(Exhaustion, AnotherExceptionAborts) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(ThrowOnAThread(std::logic_error("odd")), ::testing::KilledBySignal(SIGABRT), "odd");
  EXPECT_EXIT(ThrowOnAThread(std::system_error(EINVAL, std::generic_category())), ::testing::KilledBySignal(SIGABRT),
              "Invalid argument");
}

TEST(OpenError, IsAFailureWhereTheMachineIsShortOfSomething) {
  for (const int error : {EMFILE, ENFILE, ENOMEM, ENOSPC, EIO}) {
    const Error made = OpenError("the file cannot be opened", error, "a.txt");
    EXPECT_EQ(made.exit_status(), 1) << made.Text();
    EXPECT_EQ(made.context, "a.txt");
  }
  for (const int error : {ENOENT, EACCES, EISDIR, ENAMETOOLONG, EROFS})
    EXPECT_EQ(OpenError("the file cannot be opened", error, "a.txt").exit_status(), 2) << error;
  EXPECT_EQ(OpenError("the file cannot be opened", ENOENT, "a.txt").Text(),
            "a.txt: the file cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace rodeira::base
