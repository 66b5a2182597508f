// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/compress.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <new>
#include <random>
#include <string>

namespace rodeira::record {
namespace {

base::Bytes DrawnBytes(std::size_t size) {
  std::mt19937_64 rng(1);
  base::Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(rng() % 16);
  return bytes;
}

// Limits the address space of this process to what it has and `more` bytes.
void LimitMemory(rlim_t more) {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = pages * 4096 + more;
  ::setrlimit(RLIMIT_AS, &limit);
}

// A program ends with status 1 and one sentence for std::bad_alloc; status 3 stands for it here.
[[noreturn, maybe_unused]] void CompressWithLittleMemory() {
  const base::Bytes bytes = DrawnBytes(8u << 20);
  base::Bytes out;
  out.reserve(bytes.size() + (1u << 20));
  ZstdCompressor compressor(19);  // needs tens of MB
  LimitMemory(4u << 20);
  try {
    compressor.Append(bytes, out);
  } catch (const std::bad_alloc&) {
    std::_Exit(3);
  }
  std::_Exit(0);
}

#ifndef __SANITIZE_ADDRESS__  // its malloc ends the program where there is no memory
TEST(Compress, LackOfMemoryIsToldAsSuch) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(CompressWithLittleMemory(), testing::ExitedWithCode(3), "");
}
#endif

TEST(Compress, ComesBackToTheByte) {
  const base::Bytes bytes = DrawnBytes(100'000);
  base::Bytes out;
  const std::uint64_t size = ZstdCompressor(3).Append(bytes, out);
  EXPECT_EQ(size, out.size());
  EXPECT_LT(size, bytes.size() * 6 / 10) << "half of the bits are drawn";
  const auto back = ZstdDecompress(out, bytes.size());
  ASSERT_TRUE(back.ok()) << back.error().Text();
  EXPECT_EQ(back.value(), bytes);
}

}  // namespace
}  // namespace rodeira::record
