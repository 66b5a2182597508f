// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/recycled_bytes.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace rodeira::base {
namespace {

Bytes Filled(std::size_t size) {
  Bytes bytes = TakeBytes(size);
  bytes.assign(size, std::byte{7});
  return bytes;
}

TEST(RecycledBytes, HaveRoomForEverySizeAndNoContent) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{255}, std::size_t{256}, std::size_t{257},
                                 std::size_t{4095}, kMaxRecycled_bytes, kMaxRecycled_bytes + 1}) {
    for (int i = 0; i < 3; ++i) {
      Bytes bytes = TakeBytes(size);
      EXPECT_TRUE(bytes.empty());
      EXPECT_GE(bytes.capacity(), size);
      bytes.assign(size, std::byte{1});
      RecycleBytes(std::move(bytes));
      EXPECT_TRUE(bytes.empty());
    }
  }
}

TEST(RecycledBytes, AreUsedAgainOnceTheLastOwnerIsGone) {
  auto shared = ShareBytes(Filled(300));
  const std::byte* const place = shared->data();
  auto other = shared;
  shared.reset();
  Bytes meanwhile = TakeBytes(300);
  EXPECT_NE(meanwhile.data(), place) << "one owner is left";
  EXPECT_EQ(*other, Bytes(300, std::byte{7}));
  other.reset();
  EXPECT_EQ(TakeBytes(300).data(), place);
}

// A buffer of 500 bytes has room for 256, not for 512.
TEST(RecycledBytes, TakesBuffersFromElsewhereByTheirRoom) {
  for (int i = 0; i < 1000; ++i) RecycleBytes(Bytes(500));
  for (int i = 0; i < 300; ++i) EXPECT_GE(TakeBytes(512).capacity(), 512u);
  for (int i = 0; i < 300; ++i) EXPECT_GE(TakeBytes(200).capacity(), 200u);
}

// The sanitizers name what goes wrong here.
TEST(RecycledBytes, AreGivenBackByOtherThreads) {
  std::vector<std::shared_ptr<const Bytes>> handed;
  for (int i = 0; i < 100; ++i) handed.push_back(ShareBytes(Filled(1000)));
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([handed] {
      for (int i = 0; i < 1000; ++i) EXPECT_EQ(*ShareBytes(Filled(100 + 10 * i)), Bytes(100 + 10 * i, std::byte{7}));
    });
  }
  handed.clear();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace rodeira::base
