// SPDX-License-Identifier: Apache-2.0
// Files of roads as they are handed on (gzip, ZIP, UTF-16, with included files) and packed maps, against many
// seeded mutations of their bytes: read, or one sentence, within bounds of time and memory (law L6).
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zip.h>

#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/sumo/unpack.hpp"
#include "tests/common/world/opendrive/gzipped.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/property/fuzz.hpp"

namespace rodeira::property {
namespace {

namespace fs = std::filesystem;
using opendrive::Gzipped;

// Of this process, its largest so far.
void ExpectMemoryBelow(long mib) {
  rusage used{};
  ASSERT_EQ(::getrusage(RUSAGE_SELF, &used), 0);
  EXPECT_LT(used.ru_maxrss / 1024, mib);
}

std::string Zipped(const fs::path& path, const std::vector<std::pair<std::string, std::string>>& files, int method) {
  zipFile zip = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
  for (const auto& [inside, bytes] : files) {
    EXPECT_EQ(zipOpenNewFileInZip(zip, inside.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, method, 6), ZIP_OK);
    EXPECT_EQ(zipWriteInFileInZip(zip, bytes.data(), static_cast<unsigned>(bytes.size())), ZIP_OK);
    EXPECT_EQ(zipCloseFileInZip(zip), ZIP_OK);
  }
  EXPECT_EQ(zipClose(zip, nullptr), ZIP_OK);
  return base::ReadText(path).value();
}

std::string Utf16(const std::string& ascii) {
  std::string wide = "\xff\xfe";
  for (const char c : ascii) wide += {c, '\0'};
  return wide;
}

TEST(PackedFiles, OpenDrive) {
  const auto folder = std::move(base::TemporaryFolder::Make("packed-fuzz")).value();
  const fs::path path = folder.path() / "fuzz.xodr";
  const std::string road = opendrive::RoadText().Text(), text = opendrive::Document(road),
                    part = opendrive::Document("<include file=\"part.xml\"/>");
  ASSERT_TRUE(base::WriteWhole(folder.path() / "part.xml", road).ok());
  Fuzz("packed",
       {Gzipped(text), Zipped(folder.path() / "a.zip", {{"a.xodr", part}, {"part.xml", road}}, Z_DEFLATED),
        Zipped(folder.path() / "b.zip", {{"a.xodr", part}, {"part.xml", Gzipped(road)}}, 0), Utf16(text), part},
       [&](const std::string& bytes) -> std::optional<base::Error> {
         std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
         const auto import = opendrive::Load(path);
         if (!import) return import.error();
         if (!import.value().errors.empty()) return opendrive::ToError(import.value().errors.front(), path);
         return std::nullopt;
       });
  ExpectMemoryBelow(2048);
}

// As far as they are ours: what is packed is unpacked, and the outermost element is looked at.
TEST(PackedFiles, MapsOfOpenStreetMap) {
  const auto folder = std::move(base::TemporaryFolder::Make("map-fuzz")).value();
  const fs::path path = folder.path() / "fuzz.osm.gz", copy = folder.path() / "copy.osm";
  const std::string text =
      "<?xml version=\"1.0\"?>\n<!-- a map -->\n<osm version=\"0.6\"><node id=\"1\" lat=\"48\" lon=\"11\"/>"
      "<node id=\"2\" lat=\"48.001\" lon=\"11\"/><way id=\"3\"><nd ref=\"1\"/><nd ref=\"2\"/></way></osm>\n";
  Fuzz("osm.gz", {text, Gzipped(text)}, [&](const std::string& bytes) -> std::optional<base::Error> {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    const auto status = sumo::Unpack(path, sumo::SourceKind::kOpenStreetMap, copy);
    return status ? std::nullopt : std::optional(status.error());
  });
  ExpectMemoryBelow(2048);
}

}  // namespace
}  // namespace rodeira::property
