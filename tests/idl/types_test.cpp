// SPDX-License-Identifier: Apache-2.0
// The IDL as other compilers see it, and the hashes that are made of it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/decode/type_text.hpp"
#include "idl/aliases.hpp"
#include "idl/topic_types.hpp"
#include "idl/topics.hpp"
#include "tests/tree.hpp"

namespace rodeira::idl {
namespace {

using decode::TypePtr;
using TypeMap = std::map<std::string, TypePtr>;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TypeMap TypesIn(const std::string& text) {
  const auto types = decode::IdlTypes::Read(text, "IDL");
  EXPECT_TRUE(types.ok()) << types.error().Text();
  return types.ok() ? types.value().types() : TypeMap();
}

TypeMap AllTypes() {
  TypeMap all;
  for (const IdlText& text : IdlTexts()) all.merge(TypesIn(text.text));
  return all;
}

std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Words of OMG IDL 4.2, in lower case.
const std::set<std::string> kKeywords = {
    "abstract", "alias",      "any",         "attribute",  "bitfield",  "bitmask",   "bitset",     "boolean",
    "case",     "char",       "component",   "connector",  "const",     "consumes",  "context",    "custom",
    "default",  "double",     "emits",       "enum",       "eventtype", "exception", "factory",    "false",
    "finder",   "fixed",      "float",       "getraises",  "home",      "import",    "in",         "inout",
    "int8",     "int16",      "int32",       "int64",      "interface", "local",     "long",       "manages",
    "map",      "mirrorport", "module",      "multiple",   "native",    "object",    "octet",      "oneway",
    "out",      "port",       "porttype",    "primarykey", "private",   "provides",  "public",     "publishes",
    "raises",   "readonly",   "sequence",    "setraises",  "short",     "string",    "struct",     "supports",
    "switch",   "true",       "truncatable", "typedef",    "typeid",    "typename",  "typeprefix", "uint8",
    "uint16",   "uint32",     "uint64",      "union",      "unsigned",  "uses",      "valuebase",  "valuetype",
    "void",     "wchar",      "wstring"};

// Names that a compiler refuses because IDL does not tell upper from lower case: two types of a module, two members, a
// member and a type of its module, a keyword.
std::vector<std::string> Collisions(const TypeMap& types) {
  std::vector<std::string> found;
  std::map<std::string, std::string> known;  // lower case: as it is written
  for (const auto& [full, type] : types) {
    const auto [place, fresh] = known.emplace(Lower(full), full);
    if (!fresh) found.push_back(full + " and " + place->second);
    if (kKeywords.contains(Lower(full.substr(full.rfind(':') + 1)))) found.push_back(full + " is a keyword");
  }
  for (const auto& [full, type] : types) {
    const std::string module = full.substr(0, full.rfind(':') + 1);
    std::set<std::string> members;
    for (const decode::Member& member : type->members) {
      const std::string name = Lower(member.name);
      if (!members.insert(name).second) found.push_back(full + "." + member.name + " twice");
      if (kKeywords.contains(name)) found.push_back(full + "." + member.name + " is a keyword");
      const auto other = known.find(Lower(module) + name);
      if (other != known.end()) found.push_back(full + "." + member.name + " and " + other->second);
    }
  }
  return found;
}

TEST(Idl, NoTwoNamesDifferByCaseAlone) {
  ASSERT_GE(AllTypes().size(), 30u);
  EXPECT_THAT(Collisions(AllTypes()), IsEmpty());
}

TEST(Idl, TheCheckOfNamesFindsEachKind) {
  EXPECT_THAT(Collisions(TypesIn("module m { struct Header { long x; }; struct A { Header header; }; };")),
              ElementsAre("m::A.header and m::Header"));
  EXPECT_THAT(Collisions(TypesIn("module m { struct A { long x; }; struct a { long y; }; };")),
              ElementsAre("m::a and m::A"));
  EXPECT_THAT(Collisions(TypesIn("struct A { long speed; long Speed; };")), ElementsAre("A.Speed twice"));
  EXPECT_THAT(Collisions(TypesIn("struct A { long Port; };")), ElementsAre("A.Port is a keyword"));
}

TEST(Idl, EveryTypeIsMarkedFinal) {
  ASSERT_FALSE(AllTypes().empty());
  for (const auto& [name, type] : AllTypes()) EXPECT_EQ(type->extensibility, decode::Extensibility::kFinal) << name;
}

// The hash of each topic, of this program's texts in which `before` is replaced by `after`.
std::map<std::string, base::Digest> HashesWith(const std::string& before, const std::string& after) {
  std::map<std::string, base::Digest> hashes;
  bool replaced = false;
  for (const TopicInfo& info : Topics()) {
    std::string text = IdlTextOf(info.subject);
    const std::size_t at = text.find(before);
    replaced = replaced || at != std::string::npos;
    if (at != std::string::npos) text.replace(at, before.size(), after);
    const auto type = decode::ReadType(text, std::string(info.type));
    EXPECT_TRUE(type.ok()) << type.error().Text();
    if (type.ok()) hashes[std::string(info.topic)] = decode::TypeHash(*type.value());
  }
  EXPECT_TRUE(replaced) << before;
  return hashes;
}

// The topics with another hash after the replacement.
std::vector<std::string> ChangedBy(const std::string& before, const std::string& after) {
  std::vector<std::string> changed;
  for (const auto& [topic, hash] : HashesWith(before, after)) {
    if (hash != TypeHash(topic)) changed.push_back(topic);
  }
  return changed;
}

TEST(TopicHash, IgnoresCommentsAndLayout) {
  EXPECT_THAT(ChangedBy("// positive to the left", "// left is positive"), IsEmpty());
  EXPECT_THAT(ChangedBy("double throttle;", "double\n\n  throttle;"), IsEmpty());
}

TEST(TopicHash, ChangesForTheTopicThatUsesTheTypeAlone) {
  EXPECT_THAT(ChangedBy("double throttle;", "double accelerator;"), ElementsAre("rodeira/controls"));
  EXPECT_THAT(ChangedBy("double throttle;", "float throttle;"), ElementsAre("rodeira/controls"));
  EXPECT_THAT(ChangedBy("unsigned long starter;", "unsigned long starter; unsigned long wipers;"),
              ElementsAre("rodeira/controls"));
  EXPECT_THAT(ChangedBy("float penetration_m;", ""), ElementsAre("rodeira/collisions"));
  EXPECT_THAT(ChangedBy("@final\n    struct Controls", "@appendable\n    struct Controls"),
              ElementsAre("rodeira/controls"));
  EXPECT_THAT(ChangedBy("Vector3f hub_b_m;\n      float steer_rad; ", "float steer_rad; Vector3f hub_b_m;"),
              ElementsAre("rodeira/vehicle_state"));
}

TEST(TopicHash, OfAnIncludedTypeChangesForAllThatUseIt) {
  std::vector<std::string> lockstep;
  for (const TopicInfo& info : Topics()) {
    if (info.lockstep) lockstep.emplace_back(info.topic);
  }
  ASSERT_GE(lockstep.size(), 10u);
  EXPECT_THAT(ChangedBy("unsigned long incarnation;         // grows with each restart",
                        "unsigned long life;         // grows with each restart"),
              ::testing::UnorderedElementsAreArray(lockstep));
}

TEST(ProtocolHash, IsOfTheTopicsThatAreNamed) {
  const auto texts = TextsOf({"rodeira/controls", "rodeira/pulse"});
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts[1].type, "rodeira::msg::Pulse");
  auto changed = texts;
  changed[1].idl.replace(changed[1].idl.find("unsigned long long value"), 24, "double value");
  EXPECT_NE(ProtocolHash(texts), ProtocolHash(changed));
  EXPECT_EQ(ProtocolHash(std::span(texts).first(1)), ProtocolHash(std::span(changed).first(1)));
  EXPECT_NE(ProtocolHash(texts), ProtocolHash());
  EXPECT_EQ(TypeDifference("rodeira/pulse", {texts[1].idl, texts[1].type}), std::nullopt);
  EXPECT_EQ(TypeDifference("rodeira/pulse", {changed[1].idl, changed[1].type}),
            "rodeira::msg::Pulse, member 2: found 'double value', expected 'unsigned long long value'");
  EXPECT_EQ(TypeDifference("rodeira/puls", {texts[1].idl, texts[1].type}), "this program has no topic 'rodeira/puls'");
  EXPECT_EQ(TypeDifference("rodeira/pulse", {"struct", "Pulse"}),
            "IDL of 'Pulse':1: 'the end of the text' was found, a name was expected");
}

TEST(Aliases, LeadFromNamesThatAreGoneToTodays) {
  const decode::Aliases& aliases = Aliases();
  const TypeMap types = AllTypes();
  ASSERT_FALSE(aliases.topics.empty() || aliases.types.empty() || aliases.members.empty());
  for (const auto& [before, today] : aliases.topics) {
    EXPECT_EQ(FindTopic(before), nullptr) << before;
    EXPECT_NE(FindTopic(today), nullptr) << today;
  }
  for (const auto& [before, today] : aliases.types) {
    EXPECT_FALSE(types.contains(before)) << before;
    EXPECT_TRUE(types.contains(today)) << today;
  }
  for (const auto& [key, today] : aliases.members) {
    const auto type = types.find(key.first);
    ASSERT_NE(type, types.end()) << key.first;
    EXPECT_EQ(decode::FindMember(*type->second, key.second), nullptr) << key.first << "." << key.second;
    EXPECT_NE(decode::FindMember(*type->second, today), nullptr) << key.first << "." << today;
  }
}

// The text of rodeira/collisions before the names were changed.
constexpr const char* kFormerCollisions = R"(module rodeira { module msg {
  struct Header { long long step; long long time_ns; unsigned long source; unsigned long incarnation;
                  unsigned long long state_digest; };
  struct Collision {
    double position_x_m; double position_y_m; double position_z_m;
    double impulse_x_ns; double impulse_y_ns; double impulse_z_ns;
    float normal_x; float normal_y; float normal_z; float depth_m; float closing_mps;
    unsigned long partner; unsigned long partner_source; unsigned long partner_id; string partner_name;
    unsigned long begins; unsigned long index; unsigned long end; };
  struct Collisions { Header header; sequence<Collision> collisions; unsigned long end; };
}; };)";

TEST(Aliases, MatchARecordingWithFormerNames) {
  const OtherType former{kFormerCollisions, "rodeira::msg::Collisions"};
  EXPECT_EQ(RecordedTypeDifference("rodeira/collisions", former), std::nullopt);
  EXPECT_EQ(TypeDifference("rodeira/collisions", former),
            "rodeira::msg::Collisions, member 1: found 'rodeira::msg::Header header', expected "
            "'rodeira::msg::SampleHeader header'")
      << "on the wire there are no aliases";
  std::string changed = kFormerCollisions;
  changed.replace(changed.find("float depth_m"), 13, "double depth_m");
  EXPECT_EQ(RecordedTypeDifference("rodeira/collisions", {changed, former.type}),
            "rodeira::msg::Contact, member 10: found 'double penetration_m', expected 'float penetration_m'");
}

// fastddsgen writes a preprocessed text to a temporary folder by the name of its IDL file, and reads it back: two of
// them in one folder read half a text of the other, and make headers without types.
TEST(Generator, EachHasAFolderOfItsOwnForPreprocessedTexts) {
  const auto build = base::ReadText(BinaryDir() + "/build.ninja");
  ASSERT_TRUE(build.ok()) << build.error().Text();
  std::istringstream lines(build.value());
  std::multiset<std::string> folders;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("COMMAND = ") == std::string::npos || line.find("/fastddsgen -") == std::string::npos) continue;
    std::smatch folder;
    ASSERT_TRUE(std::regex_search(line, folder, std::regex(" -t (\\S+) "))) << line;
    EXPECT_EQ(folder.str(1).find(BinaryDir()), 0u) << folder.str(1);
    folders.insert(folder.str(1));
  }
  ASSERT_FALSE(folders.empty());
  for (const std::string& folder : folders) EXPECT_EQ(folders.count(folder), 1u) << folder;
  ASSERT_FALSE(IdlTexts().empty());
  for (const IdlText& text : IdlTexts()) {
    const auto preprocessed = base::ReadText(fmt::format("{}/idl/preprocessed/{}.idl.cc", BinaryDir(), text.subject));
    EXPECT_TRUE(preprocessed.ok() && !preprocessed.value().empty()) << text.subject;
  }
}

}  // namespace
}  // namespace rodeira::idl
