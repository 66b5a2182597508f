// SPDX-License-Identifier: Apache-2.0
// Promises of callers: nothing is written into a closed recording, and nothing is read beyond a file's end.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "common/core/base/temporary_folder.hpp"
#include "common/data/record/mcap_contents.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "common/data/record/sink.hpp"
#include "common/data/record/source.hpp"

namespace rodeira::record {
namespace {

TEST(ContractsDeathTest, AClosedRecordingTakesNothing) {
  base::Bytes bytes;
  auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer.value().Close().ok());
  EXPECT_DEATH((void)writer.value().AddSchema("a", "omgidl", ""), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().AddChannel("a", 0, "cdr"), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().Write(1, 0, 0, 0, {}), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().AddMetadata("a", {}), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().AddAttachment("a", "text/plain", {}, 0, 0), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().Flush(), "closed\\(\\)");
  EXPECT_DEATH((void)writer.value().Sync(), "closed\\(\\)");
  EXPECT_TRUE(writer.value().Close().ok()) << "a second Close does nothing";
}

TEST(ContractsDeathTest, AClosedFileTakesNothing) {
  const auto folder = base::TemporaryFolder::Make("contracts");
  ASSERT_TRUE(folder.ok()) << folder.error().Text();
  auto sink = OpenFileSink(folder.value().path() / "a.mcap", false);
  ASSERT_TRUE(sink.ok()) << sink.error().Text();
  ASSERT_TRUE(sink.value()->Close().ok());
  EXPECT_DEATH((void)sink.value()->Append(base::Bytes(1)), "file_ >= 0");
  EXPECT_DEATH((void)sink.value()->Sync(), "file_ >= 0");
  EXPECT_DEATH(sink.value()->SyncSoon(), "file_ >= 0");
}

TEST(ContractsDeathTest, NothingIsReadBeyondTheEnd) {
  const auto source = MemorySource(base::Bytes(10));
  EXPECT_TRUE(source->Read(0, 10).ok());
  EXPECT_TRUE(source->Read(10, 0).ok());
  EXPECT_DEATH((void)source->Read(0, 11), "size <= size_ - offset");
  EXPECT_DEATH((void)source->Read(11, 0), "offset <= size_");
  EXPECT_DEATH((void)source->Read(1, ~std::uint64_t{0}), "size <= size_ - offset") << "no sum overflows";
  EXPECT_DEATH((void)ReadRecord(*source, 0, 11), "end <= source.size\\(\\)");
  EXPECT_DEATH((void)ReadRecord(*source, 5, 4), "offset <= end");
}

}  // namespace
}  // namespace rodeira::record
