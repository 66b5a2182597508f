// Many seeded mutations of small files: the reader, Verify and Repair never crash, and never hand out a message that
// was not written. RODEIRA_FUZZ_FILES sets how many files are tried, RODEIRA_FUZZ_FIRST with which number they begin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "common/base/random.hpp"
#include "common/record/checksum.hpp"
#include "common/record/repair.hpp"
#include "tests/common/record/sample.hpp"
#include "tests/property/last_words.hpp"
#include "tests/setting.hpp"

namespace rodeira::record {
namespace {

// Draws of one mutated file: a pure function of its number.
class Draw {
 public:
  explicit Draw(std::uint64_t file) : file_(file) {}
  std::uint64_t Bits() { return base::RandomBits({20240611, file_, count_++}); }
  std::size_t Below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(Bits() % end); }

 private:
  std::uint64_t file_;
  std::uint64_t count_ = 0;
};

// A length or an offset that looks plausible, or is at an edge.
std::uint64_t Interesting(Draw& draw, std::uint64_t size) {
  const std::uint64_t values[] = {0, 1, 7, 9, size, size - 1, size + 1, 0x7F, 0x80, 0xFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF,
                                  0x10000000, 0x10000001, 0x7FFFFFFFFFFFFFFF, ~0ull, ~0ull - 8, draw.Bits() % (size + 1)};
  return values[draw.Below(std::size(values))];
}

void Mutate(base::Bytes& bytes, Draw& draw) {
  const std::size_t at = draw.Below(bytes.size());
  const std::size_t left = bytes.size() - at;
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto length = static_cast<std::ptrdiff_t>(1 + draw.Below(std::min<std::size_t>(left, 64)));
  switch (draw.Below(8)) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1u << draw.Below(8));
      break;
    case 1:
      bytes[at] = static_cast<std::byte>(draw.Bits());
      break;
    case 2:
    case 3: {
      const std::uint64_t value = Interesting(draw, bytes.size());
      std::memcpy(bytes.data() + at, &value, std::min<std::size_t>(left, draw.Below(2) == 0 ? 4 : 8));
      break;
    }
    case 4:
      bytes.erase(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)));
      break;
    case 5: {
      const base::Bytes copy(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)));
      const auto target = bytes.begin() + static_cast<std::ptrdiff_t>(draw.Below(bytes.size()));
      bytes.insert(target, copy.begin(), copy.end());
      break;
    }
    case 6:
      bytes.resize(at);
      break;
    default:
      std::fill(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)), std::byte{0});
  }
}

void PutCrc(base::Bytes& bytes, std::size_t from, std::size_t to, std::size_t at) {
  const std::uint32_t crc = Crc32(std::span(bytes).subspan(from, to - from));
  std::memcpy(bytes.data() + at, &crc, sizeof crc);
}

std::uint64_t NumberAt(const base::Bytes& bytes, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

// Makes the checksums right again (of uncompressed chunks, of attachments, of the summary), so that the changes reach
// what lies behind them.
void Reseal(base::Bytes& bytes) {
  for (std::size_t at = 8; at + 9 < bytes.size();) {
    const std::uint64_t length = NumberAt(bytes, at + 1);
    if (length > bytes.size() - at - 9) break;
    const std::size_t end = at + 9 + static_cast<std::size_t>(length);
    if (bytes[at] == std::byte{6} && length >= 40) PutCrc(bytes, at + 9 + 40, end, at + 9 + 24);
    if (bytes[at] == std::byte{9} && length >= 4) PutCrc(bytes, at + 9, end - 4, end - 4);
    at = end;
  }
  if (bytes.size() < 60) return;
  const std::uint64_t summary = NumberAt(bytes, bytes.size() - 28);
  if (summary < bytes.size() - 12) PutCrc(bytes, static_cast<std::size_t>(summary), bytes.size() - 12, bytes.size() - 12);
}

// Everything a user of the reader can ask for. Returns how many messages came.
std::size_t UseAll(const base::Bytes& bytes, bool scan, const std::set<Copied>* known) {
  ReaderSettings settings;
  settings.scan = scan;
  auto opened = McapReader::OpenBytes(bytes, settings);
  if (!opened) {
    EXPECT_FALSE(opened.error().message.empty());
    return 0;
  }
  const McapReader& reader = opened.value();
  const Read read = ReadAll(reader);
  if (known != nullptr) {
    for (const Copied& message : read.messages) EXPECT_TRUE(known->contains(message));
  }
  Query query;
  query.order = Query::Order::kFile;
  query.channels = std::set<ChannelId>{1, 3};
  query.through_ns = 1000;
  EXPECT_LE(ReadAll(reader, query).messages.size(), read.messages.size());
  std::size_t chunk_by_chunk = 0;
  for (const ChunkInfo& info : reader.chunks()) {
    const auto chunk = reader.ReadChunk(info);
    if (chunk) chunk_by_chunk += chunk.value().messages.size();
  }
  EXPECT_EQ(chunk_by_chunk, read.messages.size());
  for (const MetadataInfo& info : reader.metadata()) static_cast<void>(reader.ReadMetadata(info).ok());
  for (const AttachmentInfo& info : reader.attachments()) static_cast<void>(reader.ReadAttachment(info).ok());
  return read.messages.size();
}

TEST(Fuzz, MutatedFilesNeitherCrashNorLie) {
  std::vector<base::Bytes> seeds;
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    seeds.push_back(Record(SmallPlan(), SmallSettings(compression)));
    seeds.push_back(Record({}, SmallSettings(compression)));
  }
  const auto messages = MessagesOf(SmallPlan());
  const std::set<Copied> known(messages.begin(), messages.end());
  std::size_t opened = 0;
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 100'000);
  property::SayWhereItDies();
  for (std::size_t file = first; file < first + count; ++file) {
    property::NowTrying("file", file);
    Draw draw(file);
    base::Bytes bytes = seeds[draw.Below(seeds.size())];
    const std::size_t mutations = 1 + draw.Below(4);
    for (std::size_t i = 0; i < mutations && !bytes.empty(); ++i) Mutate(bytes, draw);
    const bool resealed = draw.Below(2) == 0;
    if (resealed) Reseal(bytes);
    // With several changes one may take the checksum out of force and another touch its bytes.
    if (UseAll(bytes, file % 2 == 0, mutations == 1 && !resealed ? &known : nullptr) > 0) ++opened;
    if (file % 10 == 0) {
      base::Bytes repaired;
      const auto report = RepairBytes(bytes, &repaired);
      if (report) {
        auto again = McapReader::OpenBytes(repaired);
        ASSERT_TRUE(again.ok()) << file;
        EXPECT_EQ(again.value().Verify(), std::vector<std::string>{}) << file;
        EXPECT_EQ(again.value().statistics().messages, report.value().kept.messages) << file;
      }
    }
    if (testing::Test::HasFailure()) FAIL() << property::g_last_words;
  }
  if (count < 1000) return;
  EXPECT_GT(opened, count / 10);  // the mutations are not so wild that all is refused at the door
}

}  // namespace
}  // namespace rodeira::record
