// SPDX-License-Identifier: Apache-2.0
// .bt files with headers that are broken in every way that there is: a grid that can be asked, or a sentence. The
// reader of headers sees RODEIRA_FUZZ_HEADERS of them (300 000); files are loaded from RODEIRA_FUZZ_FILES of them
// (200). Both begin at the number RODEIRA_FUZZ_FIRST.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/terrain/bt.hpp"
#include "common/world/terrain/elevation_file.hpp"

namespace rodeira::terrain {
namespace {

namespace fs = std::filesystem;

std::size_t Setting(const char* name, std::size_t default_value) {
  const char* set = std::getenv(name);
  return set == nullptr ? default_value : static_cast<std::size_t>(std::strtoull(set, nullptr, 10));
}

class Draw {
 public:
  explicit Draw(std::uint64_t number) : number_(number) {}
  std::uint64_t Bits() { return base::RandomBits({31, number_, count_++}); }
  std::size_t Below(std::size_t end) { return static_cast<std::size_t>(Bits() % end); }

 private:
  std::uint64_t number_;
  std::uint64_t count_ = 0;
};

base::Bytes Good() {
  BtHeader header;
  header.columns = 5;
  header.rows = 4;
  header.left = 100.0, header.right = 140.0, header.bottom = 200.0, header.top = 230.0;
  header.utm_zone = 29;
  base::Bytes bytes = BtHeaderBytes(header);
  base::ByteWriter heights;
  for (int i = 0; i < 20; ++i) heights.Put(static_cast<float>(i));
  bytes.insert(bytes.end(), heights.bytes().begin(), heights.bytes().end());
  return bytes;
}

template <class T>
void Put(base::Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

// One to three fields, bits or bytes of the header get another value, often one at an edge; sometimes the file is cut.
base::Bytes Broken(Draw& draw) {
  base::Bytes bytes = Good();
  const std::int32_t integers[] = {0,   1,     2,      3,     4,       5,       -1,         8,
                                   100, 32767, -32768, 65536, 100'000, 100'001, 2147483647, -2147483647 - 1};
  const double numbers[] = {0.0,
                            -0.0,
                            1e-310,
                            1.0,
                            140.0,
                            -1e300,
                            1e308,
                            std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity(),
                            std::nan("")};
  for (std::size_t changes = 1 + draw.Below(3); changes > 0; --changes) {
    const std::int32_t integer = integers[draw.Below(std::size(integers))];
    const double number = numbers[draw.Below(std::size(numbers))];
    constexpr std::size_t longs[] = {10, 14}, shorts[] = {18, 20, 22, 24, 26, 42, 60}, doubles[] = {28, 36, 44, 52},
                          floats[] = {26, 30, 34, 38, 62};
    switch (draw.Below(8)) {
      case 0:
        bytes[9] = static_cast<std::byte>('0' + draw.Below(6));
        break;
      case 1:
        Put(bytes, longs[draw.Below(2)], integer);
        break;
      case 2:
        Put(bytes, shorts[draw.Below(7)], static_cast<std::int16_t>(integer));
        break;
      case 3:
        Put(bytes, doubles[draw.Below(4)], number);
        break;
      case 4:
        Put(bytes, floats[draw.Below(5)], static_cast<float>(number));
        break;
      case 5:
        bytes[draw.Below(80)] ^= static_cast<std::byte>(1u << draw.Below(8));
        break;
      case 6:
        bytes[draw.Below(kBtHeaderBytes)] = static_cast<std::byte>(draw.Bits());
        break;
      default:
        if (draw.Below(4) == 0) {
          bytes.resize(draw.Below(bytes.size()));
          return bytes;
        }
        bytes.resize(bytes.size() + 4 * draw.Below(40));
    }
  }
  return bytes;
}

void ExpectSentence(const base::Error& error, std::size_t number) {
  ASSERT_EQ(error.exit_status(), 2) << number;
  ASSERT_FALSE(error.message.empty()) << number;
  for (const char c : error.Text()) ASSERT_TRUE(c < 0 || c >= 0x20) << number << ": " << error.Text();
}

TEST(BtHeaders, AMutatedHeaderIsReadAsSomethingThatCanBeOrRefused) {
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0), count = Setting("RODEIRA_FUZZ_HEADERS", 300'000);
  std::size_t accepted = 0;
  for (std::size_t number = first; number < first + count; ++number) {
    Draw draw(number);
    const auto header = ParseBtHeader(Broken(draw));
    if (!header) {
      ExpectSentence(header.error(), number);
      if (testing::Test::HasFatalFailure()) return;
      continue;
    }
    ++accepted;
    const BtHeader& h = header.value();
    ASSERT_TRUE(h.version_tenths >= 10 && h.version_tenths <= 13 && h.columns >= 2 && h.rows >= 2) << number;
    ASSERT_TRUE(std::isfinite(h.right - h.left) && h.left < h.right && std::isfinite(h.top - h.bottom) &&
                h.bottom < h.top)
        << number;
    ASSERT_TRUE(h.vertical_scale > 0.0 && std::isfinite(h.vertical_scale) && h.metres_a_unit >= 0.0) << number;
    ASSERT_GE(h.file_bytes(), kBtHeaderBytes + 8u) << number;
    if (h.version_tenths == 10) continue;  // keeps its extents in single precision, and elsewhere
    const auto again = ParseBtHeader(BtHeaderBytes(h));
    ASSERT_TRUE(again.ok()) << number << ": " << again.error().Text();
    ASSERT_TRUE(again.value().columns == h.columns && again.value().left == h.left && again.value().top == h.top &&
                again.value().metres_a_unit == h.metres_a_unit)
        << number;
  }
  if (count < 1000) return;
  EXPECT_GT(accepted, count / 20);
  EXPECT_LT(accepted, count - count / 5);
}

TEST(BtHeaders, AFileWithAMutatedHeaderIsAGridThatCanBeAskedOrASentence) {
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0), count = Setting("RODEIRA_FUZZ_FILES", 200);
  const fs::path path = fs::temp_directory_path() / ("rodeira-bt-" + std::to_string(::getpid()) + ".bt");
  std::size_t accepted = 0;
  for (std::size_t number = first; number < first + count; ++number) {
    Draw draw(number);
    const base::Bytes bytes = Broken(draw);
    ASSERT_TRUE(base::WriteWhole(path, std::span<const std::byte>(bytes)).ok());
    const auto loaded = LoadElevation(path);
    const auto header = ParseBtHeader(bytes);
    if (!loaded) {
      ExpectSentence(loaded.error(), number);
      if (testing::Test::HasFatalFailure()) break;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(header.ok() && bytes.size() >= header.value().file_bytes()) << number;
    const ElevationGrid& grid = *loaded.value();
    const auto& frame = grid.frame();
    for (const double share : {0.0, 0.3, 0.999, 1.0, 1.5}) {
      const GridSample at = grid.At(frame.west_m + share * (frame.east_m - frame.west_m),
                                    frame.south_m + share * (frame.north_m - frame.south_m));
      ASSERT_TRUE(!at.inside || std::isfinite(at.z_m)) << number;
    }
  }
  fs::remove(path);
  if (count < 200) return;
  EXPECT_GT(accepted, count / 20);
  EXPECT_LT(accepted, count - count / 5);
}

}  // namespace
}  // namespace rodeira::terrain
