// SPDX-License-Identifier: Apache-2.0
// What is wanted of a conflict zone.
#include "common/traffic/right_of_way/reservation_table.hpp"

#include <gtest/gtest.h>

namespace rodeira::traffic {
namespace {

TEST(ReservationTable, RoomIsReservedForTheLongestWaiting) {
  ReservationTable book(3);
  EXPECT_EQ(book.RoomWanted(1, 0).waited_s, 0.0);
  book.WantRoom(1, 0, {50.0, 7});
  book.WantRoom(1, 0, {80.0, 3});
  book.WantRoom(1, 0, {80.0, 9});  // of equals the first
  book.WantRoom(1, 0, {60.0, 1});
  EXPECT_EQ(book.RoomWanted(1, 0).waited_s, 80.0);
  EXPECT_EQ(book.RoomWanted(1, 0).id, 3u);
  EXPECT_EQ(book.RoomWanted(1, 1).waited_s, 0.0);
  EXPECT_EQ(book.RoomWanted(2, 0).waited_s, 0.0);
  book.Clear();
  EXPECT_EQ(book.RoomWanted(1, 0).waited_s, 0.0);
  book.Await(2, 1);
  EXPECT_TRUE(book.IsAwaited(2, 1));
  EXPECT_EQ(book.RoomWanted(1, 0).waited_s, 0.0);
}

}  // namespace
}  // namespace rodeira::traffic
