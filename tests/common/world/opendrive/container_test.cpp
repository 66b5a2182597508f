// SPDX-License-Identifier: Apache-2.0
// Files as they are handed on: packed, in other encodings, in several parts. The oracle is the plain file of the same
// road: what is read of the others is the same, to the bit (content_hash), or the sentence says what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/world/opendrive/gzipped.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// UTF-16 by the definition of the encoding (RFC 2781) for characters below U+10000; the text is Latin-1.
std::string Utf16(const std::string& latin1, bool little, bool mark) {
  std::string wide = mark ? (little ? "\xff\xfe" : "\xfe\xff") : "";
  for (const char c : latin1) {
    if (little)
      wide += {c, '\0'};
    else
      wide += {'\0', c};
  }
  return wide;
}

class Container : public testing::Test {
 protected:
  fs::path Put(const std::string& name, const std::string& bytes) const {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  fs::path Zip(const std::string& name, const std::vector<std::pair<std::string, std::string>>& files) const {
    const fs::path path = folder_.path() / name;
    zipFile zip = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
    for (const auto& [inside, bytes] : files) {
      EXPECT_EQ(zipOpenNewFileInZip(zip, inside.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 6),
                ZIP_OK);
      EXPECT_EQ(zipWriteInFileInZip(zip, bytes.data(), static_cast<unsigned>(bytes.size())), ZIP_OK);
      EXPECT_EQ(zipCloseFileInZip(zip), ZIP_OK);
    }
    EXPECT_EQ(zipClose(zip, nullptr), ZIP_OK);
    return path;
  }
  static std::string Refusal(const fs::path& path) {
    const auto import = Load(path);
    if (import.ok()) return "it was read";
    EXPECT_EQ(import.error().exit_status(), 2);
    return import.error().Text();
  }

  base::TemporaryFolder folder_ = std::move(base::TemporaryFolder::Make("container-test")).value();
};

RoadText Named(const std::string& name) {
  RoadText road;
  road.attributes = "junction=\"-1\" name=\"" + name + "\"";
  return road;
}

std::string Declared(const std::string& encoding, const std::string& name) {
  return "<?xml version=\"1.0\" encoding=\"" + encoding +
         "\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"8\"/>\n" + Named(name).Text() + "</OpenDRIVE>\n";
}

TEST_F(Container, PackedFilesAreReadAsThePlainOne) {
  const std::string text = Document(RoadText().Text());
  const auto plain = Load(Put("plain.xodr", text)).value();
  ASSERT_NE(plain.network, nullptr);
  for (const fs::path& path :
       {Put("a.xodrz", Gzipped(text)), Put("a.xodr.gz", Gzipped(text)), Put("packed.xodr", Gzipped(text)),
        Put("a.xml", text), Zip("a.zip", {{"readme.txt", "a map"}, {"maps/town.xodr", text}}),
        Zip("b.zip", {{"maps\\town.XODR", text}, {"__MACOSX/maps/._town.xodr", "finder"}}),
        Zip("c.zip", {{"x.xml", text}}), Zip("d.zip", {{"x.xodrz", Gzipped(text)}}),
        Put("two members.xodrz", Gzipped(text.substr(0, 100)) + Gzipped(text.substr(100)))}) {
    const auto import = Load(path);
    ASSERT_TRUE(import.ok()) << import.error().Text();
    EXPECT_EQ(import.value().content_hash, plain.content_hash) << path;
    EXPECT_NE(import.value().network, nullptr) << path;
    EXPECT_EQ(LoadText(path).value(), text) << path;
  }
}

TEST_F(Container, OtherEncodingsComeAsUtf8) {
  const std::string latin1 =
                        "Stra\xdf"
                        "e",
                    utf8 =
                        "Stra\xc3\x9f"
                        "e";
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"le.xodr", Utf16(Declared("UTF-16", latin1), true, true)},
           {"be.xodr", Utf16(Declared("UTF-16", latin1), false, true)},
           {"bare_le.xodr", Utf16(Declared("utf-16", latin1), true, false)},
           {"bare_be.xodr", Utf16(Declared("utf-16", latin1), false, false)},
           {"latin1.xodr", Declared("ISO-8859-1", latin1)},
           {"windows.xodr", Declared("windows-1252", latin1)}}) {
    const fs::path path = Put(name, bytes);
    const auto import = Load(path);
    ASSERT_TRUE(import.ok()) << import.error().Text();
    ASSERT_NE(import.value().network, nullptr) << name;
    EXPECT_EQ(import.value().network->roads()[0].spec().name, utf8) << name;
    EXPECT_EQ(LoadText(path).value(), Declared("UTF-8", utf8)) << name;
  }
  // Shift_JIS of U+9053, "road", by the table of JIS X 0208.
  EXPECT_EQ(Load(Put("japan.xodr", Declared("Shift_JIS", "\x93\xb9"))).value().network->roads()[0].spec().name,
            "\xe9\x81\x93");
  const std::string marked = "\xef\xbb\xbf" + Declared("UTF-8", utf8);
  EXPECT_EQ(LoadText(Put("marked.xodr", marked)).value(), marked);
  EXPECT_EQ(Load(Put("marked.xodr", marked)).value().network->roads()[0].spec().name, utf8);
  // What says UTF-16 and is written byte by byte is what it is written in.
  EXPECT_NE(Load(Put("liar.xodr", Declared("UTF-16", "a"))).value().network, nullptr);
  EXPECT_THAT(Refusal(Put("who.xodr", Declared("x-klingon", latin1))),
              HasSubstr("who.xodr:1: the encoding 'x-klingon' is unknown; UTF-8 was expected"));
}

TEST_F(Container, LinesAreThoseOfTheTextInsideAndRepairsArePlain) {
  RoadText road;
  road.right = "\n<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"x\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const std::string text = Document(road.Text());
  const auto plain = Load(Put("plain.xodr", text)).value();
  const auto packed = Load(Put("wide.xodr", Utf16(text, true, true))).value();
  ASSERT_EQ(packed.warnings.size(), plain.warnings.size());
  ASSERT_FALSE(plain.warnings.empty());
  for (std::size_t i = 0; i < plain.warnings.size(); ++i) EXPECT_EQ(packed.warnings[i].line, plain.warnings[i].line);
  EXPECT_FALSE(plain.repaired_text.empty());
  EXPECT_EQ(packed.repaired_text, plain.repaired_text);
}

TEST_F(Container, IncludedFilesStandInTheirPlace) {
  const std::string one = RoadText().Text();
  RoadText other;
  other.id = "2";
  other.geometry = "<geometry s=\"0\" x=\"0\" y=\"500\" hdg=\"0\" length=\"100\"><line/></geometry>";
  const std::string lanes = one.substr(one.find("<laneSection"), one.find("</lanes>") - one.find("<laneSection"));
  std::string split = one;
  split.replace(split.find(lanes), lanes.size(), "<include file=\"parts/lanes.xml\"/>");
  Put("parts/lanes.xml", "<?xml version=\"1.0\"?>\n<!-- by itself -->\n" + lanes);
  // Relative to the file that names it, and as a whole document.
  Put("parts/other.xodr", Document("<include file='more/two.xml'/>"));
  Put("parts/more/two.xml", Utf16("<OpenDRIVE>" + other.Text() + "</OpenDRIVE>", false, true));
  const std::string main = Document(split + "<include file=\"parts\\other.xodr\"/>\n");
  const auto whole = Load(Put("whole.xodr", Document(one + other.Text()))).value();
  const auto import = Load(Put("main.xodr", main));
  ASSERT_TRUE(import.ok()) << import.error().Text();
  EXPECT_THAT(import.value().warnings, testing::IsEmpty());
  ASSERT_NE(import.value().network, nullptr);
  EXPECT_EQ(Describe(import.value()), Describe(whole));
  EXPECT_EQ(import.value().network->roads()[1].id(), "2");
  EXPECT_EQ(LoadText(folder_.path() / "main.xodr").value().find("<include"), std::string::npos);
  const auto zipped = Load(Zip("m.zip", {{"m/main.xodr", Document("<include file=\"./roads/a.xml\"/>")},
                                         {"m/roads/a.xml", one + other.Text()}}));
  ASSERT_TRUE(zipped.ok()) << zipped.error().Text();
  EXPECT_EQ(Describe(zipped.value()), Describe(whole));
}

TEST_F(Container, WhatIsBehindAnIncludedFileKeepsItsLine) {
  Put("long.xml", "\n\n\n\n" + RoadText().Text());
  const std::string text = Document("<include file=\"long.xml\"/>\n<rode/>\n");
  const auto import = Load(Put("main.xodr", text)).value();
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].line, 5u) << import.warnings[0].Text();
}

TEST_F(Container, AnIncludedFileThatIsNotThereIsLeftOut) {
  Put("lanse.xml", "<x/>");
  const fs::path path = Put("main.xodr", Document(RoadText().Text() + "<include file=\"lanes.xml\"/>\n"));
  const auto import = Load(path).value();
  ASSERT_NE(import.network, nullptr);
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_THAT(import.warnings[0].Text(),
              AllOf(HasSubstr("core.include: 'lanes.xml', which <include> names, is not read: there is no such file"),
                    HasSubstr("did you mean 'lanse.xml'?"), HasSubstr("repaired: it is left out")));
  EXPECT_EQ(Load(path, Tolerance::Strict()).value().errors.size(), 1u);
  EXPECT_THAT(Load(Put("far.xodr", Document(RoadText().Text() + "<include file=\"/etc/hostname\"/>\n")))
                  .value()
                  .warnings[0]
                  .Text(),
              HasSubstr("its path is absolute"));
}

TEST_F(Container, WhatComesToNoEndIsRefused) {
  EXPECT_THAT(Refusal(Put("self.xodr", Document("<include file=\"./self.xodr\"/>"))),
              HasSubstr("'self.xodr' includes itself"));
  Put("b.xml", "<include file=\"a.xodr\"/>");
  EXPECT_THAT(Refusal(Put("a.xodr", Document("<include file=\"b.xml\"/>"))),
              HasSubstr("'a.xodr' includes itself, by <include file=\"a.xodr\"> of 'b.xml'"));
  // Ten times ten times …: each file includes the next ten times.
  std::string ten;
  for (int i = 1; i <= 8; ++i) {
    ten.clear();
    for (int k = 0; k < 10; ++k) ten += "<include file=\"laugh" + std::to_string(i + 1) + ".xml\"/>";
    Put("laugh" + std::to_string(i) + ".xml", ten);
  }
  Put("laugh9.xml", "<userData/>");
  EXPECT_THAT(Refusal(Put("laugh.xodr", Document("<include file=\"laugh1.xml\"/>"))),
              HasSubstr("more than 10000 files are included"));
}

TEST_F(Container, BombsAndPathsThatLeaveTheArchiveAreRefused) {
  const std::string text = Document(RoadText().Text()), blanks(std::size_t{64} << 20, ' ');
  EXPECT_THAT(Refusal(Put("bomb.xodrz", Gzipped(text + blanks))), HasSubstr("zip bomb"));
  EXPECT_THAT(Refusal(Zip("bomb.zip", {{"a.xodr", text + blanks}})),
              AllOf(HasSubstr("'a.xodr' unpacks to more than 250 times its"), HasSubstr("zip bomb")));
  for (const std::string outside : {"../a.xodr", "maps/../../a.xodr", "/a.xodr", "..\\a.xodr", "C:\\a.xodr"})
    EXPECT_THAT(Refusal(Zip("out.zip", {{outside, text}})), HasSubstr("leaves the archive")) << outside;
  EXPECT_THAT(Refusal(Zip("inc.zip", {{"m/a.xodr", Document("<include file=\"../../b.xml\"/>")}})),
              HasSubstr("the path of '../../b.xml', which <include> of 'a.xodr' names, leaves the archive"));
  EXPECT_FALSE(fs::exists(folder_.path().parent_path() / "a.xodr"));
}

// Small elements take many times their length of the memory in which they are read.
TEST_F(Container, AFileOfTooManyElementsOrAttributesIsRefusedBeforeItIsRead) {
  const auto times = [](std::size_t count, std::string_view part) {
    std::string text;
    text.reserve(count * part.size());
    for (std::size_t i = 0; i < count; ++i) text += part;
    return text;
  };
  EXPECT_THAT(Refusal(Put("nodes.xodr", Document(times((std::size_t{1} << 24) + 1, "<a/>")))),
              AllOf(HasSubstr("elements; at most 16777216 were expected"), testing::Not(HasSubstr("\n"))));
  EXPECT_THAT(Refusal(Put("attributes.xodr", Document("<a " + times((std::size_t{1} << 26) + 1, "=") + "/>"))),
              HasSubstr("attributes; at most 67108864"));
}

// Includes of an archive: each name is unpacked once, and those that cannot be read count.
TEST_F(Container, WhatIsIncludedAgainIsCountedAndReadOnce) {
  const auto including = [](const std::string& file, int count) {
    std::string text = RoadText().Text();
    for (int i = 0; i < count; ++i) text += "<include file=\"" + file + "\"/>";
    return Document(text);
  };
  // 24 MiB that are packed by 1000 times: a bomb that is refused each time that it is unpacked.
  const std::string bomb = Gzipped("<a/>" + std::string(std::size_t{24} << 20, ' '));
  const fs::path few = Zip("few.zip", {{"m.xodr", including("b.gz", 9'999)}, {"b.gz", bomb}});
  const auto import = Load(few);
  ASSERT_TRUE(import.ok()) << import.error().Text();
  ASSERT_EQ(import.value().warnings.size(), 1u);
  EXPECT_EQ(import.value().warnings[0].rule, "core.include");
  EXPECT_THAT(Refusal(Zip("many.zip", {{"m.xodr", including("b.gz", 10'001)}, {"b.gz", bomb}})),
              HasSubstr("more than 10000"));
  EXPECT_THAT(Refusal(Zip("none.zip", {{"m.xodr", including("none.xml", 10'001)}})), HasSubstr("more than 10000"));
}

// Each in its way: surrogate pairs (RFC 2781, section 2.1: U+1F6E3 is D83D DEE3), UTF-32, odd counts of bytes, packed.
TEST_F(Container, WideEncodingsAreReadWhereverTheyStand) {
  const std::string motorway = "\xf0\x9f\x9b\xa3";  // U+1F6E3
  std::string wide = Utf16(Declared("UTF-16", "@"), true, true);
  wide.replace(wide.find(std::string("@\0", 2)), 2, "\x3d\xd8\xe3\xde");
  for (const fs::path& path :
       {Put("pair.xodr", wide), Put("pair.xodrz", Gzipped(wide)), Zip("pair.zip", {{"a.xodr", wide}})}) {
    const auto import = Load(path);
    ASSERT_TRUE(import.ok()) << import.error().Text();
    ASSERT_NE(import.value().network, nullptr) << path;
    EXPECT_EQ(import.value().network->roads()[0].spec().name, motorway) << path;
  }
  // Half a character at the end is no crash and no half read road.
  const auto odd = Load(Put("odd.xodr", wide + "x"));
  if (odd.ok()) {
    ASSERT_NE(odd.value().network, nullptr);
    EXPECT_EQ(odd.value().network->roads().size(), 1u);
  } else {
    EXPECT_EQ(odd.error().exit_status(), 2);
  }
  std::string four = std::string("\xff\xfe\0\0", 4);
  for (const char c : Declared("UTF-32", "a")) four += std::string(1, c) + std::string(3, '\0');
  const auto utf32 = Load(Put("four.xodr", four));
  if (utf32.ok()) {
    ASSERT_NE(utf32.value().network, nullptr);
    EXPECT_EQ(utf32.value().network->roads()[0].spec().name, "a");
  } else {
    EXPECT_EQ(utf32.error().exit_status(), 2);
  }
}

TEST_F(Container, ArchivesWithManyFilesOrAPasswordAreRefused) {
  const std::string text = Document(RoadText().Text());
  std::vector<std::pair<std::string, std::string>> files(10'001, {"", "x"});
  for (std::size_t i = 0; i < files.size(); ++i) files[i].first = std::to_string(i);
  EXPECT_THAT(Refusal(Zip("many.zip", files)), HasSubstr("the archive holds more than 10000 files"));
  // Bit 0 of the flags in the local header and in the central directory (APPNOTE 4.4.4).
  const fs::path path = Zip("secret.zip", {{"a.xodr", text}});
  std::string bytes = base::ReadText(path).value();
  bytes[6] = static_cast<char>(bytes[6] | 1);
  const std::size_t central = bytes.find("PK\x01\x02");
  ASSERT_NE(central, std::string::npos);
  bytes[central + 8] = static_cast<char>(bytes[central + 8] | 1);
  EXPECT_THAT(Refusal(Put("secret.zip", bytes)), HasSubstr("'a.xodr' in the archive is encrypted"));
}

TEST_F(Container, FilesThatIncludeOneAnotherTooDeepAreRefused) {
  for (int i = 0; i < 20; ++i)
    Put("p" + std::to_string(i) + ".xml", "<include file=\"p" + std::to_string(i + 1) + ".xml\"/>");
  Put("p20.xml", RoadText().Text());
  EXPECT_THAT(Refusal(Put("deep.xodr", Document("<include file=\"p0.xml\"/>"))), HasSubstr("16 deep"));
  const auto import = Load(Put("less.xodr", Document("<include file=\"p8.xml\"/>")));
  ASSERT_TRUE(import.ok()) << import.error().Text();
  ASSERT_NE(import.value().network, nullptr);
  EXPECT_EQ(import.value().network->roads().size(), 1u);
}

TEST_F(Container, WhatIsNoRoadFileIsSaidInOneSentence) {
  const std::string text = Document(RoadText().Text());
  EXPECT_THAT(Refusal(Put("e.xodr", "")), HasSubstr("e.xodr: the file is empty; an OpenDRIVE file (XML) was expected"));
  EXPECT_THAT(Refusal(Put("blank.xodr", " \n\t\n")), HasSubstr("the file is empty"));
  EXPECT_THAT(Refusal(Put("e.xodrz", Gzipped(""))), HasSubstr("the file is empty"));
  for (const char* page :
       {"<!DOCTYPE html>\n<html lang=\"en\">", "\n<HTML><body>", "\xef\xbb\xbf<!doctype HTML PUBLIC>"})
    EXPECT_THAT(Refusal(Put("page.xodr", page)), HasSubstr("this is a page of the web (HTML)"));
  EXPECT_THAT(Refusal(Put("lfs.xodr", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")),
              HasSubstr("`git lfs pull`"));
  EXPECT_THAT(Refusal(Put("404.xodr", "404: Not Found")), HasSubstr("it begins with '404: Not Found'"));
  EXPECT_THAT(Refusal(Put("net.xml", "<net version=\"1.9\"/>")),
              HasSubstr("the outermost element is <net>; <OpenDRIVE> was expected: `rodeira world import`"));
  const std::string packed = Gzipped(text);
  EXPECT_THAT(Refusal(Put("cut.xodrz", packed.substr(0, packed.size() / 2))), HasSubstr("the gzip data is cut short"));
  std::string damaged = packed;
  damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 0x55);  // of the checksum
  EXPECT_THAT(Refusal(Put("damaged.xodrz", damaged)), HasSubstr("the gzip data is damaged"));
  EXPECT_THAT(Refusal(Zip("none.zip", {{"a.txt", "a"}})),
              HasSubstr("none of the archive's 1 files is an OpenDRIVE file"));
  EXPECT_THAT(Refusal(Zip("two.zip", {{"a.xodr", text}, {"b.xodr", text}})),
              HasSubstr("the archive holds 2 OpenDRIVE files ('a.xodr', 'b.xodr')"));
  EXPECT_THAT(Refusal(Put("cut.zip", "PK\x03\x04 and no more")), HasSubstr("the ZIP archive is damaged or cut short"));
  EXPECT_THAT(Refusal(Put("deep.xodrz", Gzipped(Gzipped(Gzipped(text))))), HasSubstr("packed more than 2 times"));
}

// Of several the one counts that includes the others, itself or by way of a third, in any order and folder.
TEST_F(Container, AnArchivesRootIsTheFileThatNoOtherIncludes) {
  const std::string whole = Describe(MustImport(Document(RoadText().Text())));
  const std::string tile = Document(RoadText().Text()), part = "<include file=\"tile.xodr\"/>";
  const auto root = [](const std::string& file) { return Document("<include file=\"" + file + "\"/>"); };
  const auto loaded = [&](const fs::path& path) {
    const auto import = Load(path);
    EXPECT_TRUE(import.ok()) << import.error().Text();
    return import ? Describe(import.value()) : "";
  };
  EXPECT_EQ(loaded(Zip("a.zip", {{"a/tile.xodr", tile}, {"map.xodr", root("a/tile.xodr")}})), whole);
  EXPECT_EQ(loaded(Zip("b.zip", {{"a/map.xodr", root("..\\tile.xodr")}, {"tile.xodr", tile}})), whole);
  EXPECT_EQ(loaded(Zip("c.zip", {{"map.xodr", root("p.xml")}, {"p.xml", part}, {"tile.xodr", tile}})), whole);
  EXPECT_EQ(loaded(Zip("d.zip", {{"map.xodr.gz", Gzipped(root("tile.xodr"))}, {"tile.xodr", tile}})), whole);
  EXPECT_EQ(loaded(Zip("e.zip", {{"map.xml", root("tile.xml")}, {"tile.xml", tile}})), whole);
  EXPECT_THAT(Refusal(Zip("ring.zip", {{"a.xodr", root("b.xodr")}, {"b.xodr", root("a.xodr")}})),
              HasSubstr("includes itself"));
  EXPECT_THAT(Refusal(Zip("two.zip", {{"a.xodr", root("b.xodr")}, {"b.xodr", tile}, {"c.xodr", tile}})),
              HasSubstr("('a.xodr', 'c.xodr')"));
}

// OpenDRIVE 1.9: the lanes of a site of works stand beside the permanent ones.
TEST_F(Container, OfTwoLayersOfLanesThePermanentOneCounts) {
  const std::string one = RoadText().Text();
  const std::size_t begin = one.find("<lanes>"), end = one.find("</lanes>") + 8;
  std::string temporary = one.substr(begin, end - begin), permanent = temporary;
  temporary.replace(0, 7, "<lanes layer=\"temporary\">");
  permanent.replace(0, 7, "<lanes layer=\"permanent\">");
  temporary.replace(temporary.find("a=\"3.5\""), 7, "a=\"2.5\"");
  for (const bool first : {true, false}) {
    std::string road = one;
    road.replace(begin, end - begin, first ? temporary + "\n" + permanent : permanent + "\n" + temporary);
    const Import import = MustImport(Document(road), Tolerance::Unrepaired());
    ASSERT_NE(import.network, nullptr);
    ASSERT_EQ(import.warnings.size(), 1u);
    EXPECT_EQ(import.warnings[0].Text(),
              "not_read: <lanes> of the layer 'temporary' are not read: those of the layer 'permanent' count");
    EXPECT_EQ(import.network->Span({0, 0, 1}, 50.0)->width_m(), 3.5);
  }
  std::string alone = one;
  alone.replace(begin, end - begin, temporary);
  EXPECT_EQ(MustImport(Document(alone)).network->Span({0, 0, 1}, 50.0)->width_m(), 2.5);
}

// Format specification 1.2 (VI2009.050): counts in the header, lanes of motorway entries and exits, special lanes.
TEST_F(Container, WordsOfOlderVersionsAreKnown) {
  RoadText road;
  road.left =
      "<lane id=\"1\" type=\"mwyEntry\" level=\"0\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  road.right =
      "<lane id=\"-1\" type=\"mwyExit\" level=\"0\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane>"
      "<lane id=\"-2\" type=\"special1\" level=\"0\"><width sOffset=\"0\" a=\"1\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const Import import =
      MustImport("<OpenDRIVE><header revMajor=\"1\" revMinor=\"2\" maxRoad=\"1\" maxJunc=\"0\" maxPrg=\"0\"/>" +
                 road.Text() + "</OpenDRIVE>");
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].rule, "core.version");
  ASSERT_NE(import.network, nullptr);
  EXPECT_TRUE(network::IsDrivable(import.network->Find({0, 0, 1})->type));
  EXPECT_TRUE(network::IsDrivable(import.network->Find({0, 0, -1})->type));
  EXPECT_FALSE(network::IsDrivable(import.network->Find({0, 0, -2})->type));
}

TEST_F(Container, RailwaysAndGroupsOfJunctionsAreOneSentence) {
  RoadText road;
  road.more = "<railroad><switch id=\"1\" name=\"s\" position=\"dynamic\"/></railroad>\n";
  const Import import = MustImport(Document(road.Text() + "<junctionGroup id=\"1\" type=\"roundabout\"/>\n<station/>"));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "not_read: railways and groups of junctions are not read: <railroad> of <road>, <junctionGroup> of "
            "<OpenDRIVE>, <station> of <OpenDRIVE>");
}

}  // namespace
}  // namespace rodeira::opendrive
