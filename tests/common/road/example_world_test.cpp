// The example says every key that a world file may say, and the document tells of each of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "common/base/files.hpp"
#include "common/network/line_kinds.hpp"
#include "common/road/world.hpp"
#include "common/road/world_report.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

// The keys that the readers of version 2 ask for, as they stand in the program.
std::set<std::string> AskedKeys() {
  std::set<std::string> keys;
  const std::regex asked(R"re((?:Number|Integer|Flag|Text|Choice|Path|OptionalPath|Child|OptionalChild|Items|OptionalItems|MaterialOf|Has)\((?:item, )?"([a-z_0-9]+)")re");
  const std::regex tables(R"re(Read(?:Table|Knots)\([^"]*"([a-z_]+)", "([a-z_]+)"(?:, "([a-z_]+)")?)re");
  std::vector<fs::path> files = {kRoot / "common/road/world_reader.cpp", kRoot / "common/road/picture_reader.cpp", kRoot / "common/lights/light_plan.cpp"};
  for (const auto& entry : fs::directory_iterator(kRoot / "common/design")) {
    if (entry.path().extension() == ".cpp") files.push_back(entry.path());
  }
  for (const fs::path& file : files) {
    const std::string text = base::ReadText(file).value();
    for (std::sregex_iterator i(text.begin(), text.end(), asked), end; i != end; ++i) keys.insert((*i)[1]);
    for (std::sregex_iterator i(text.begin(), text.end(), tables), end; i != end; ++i) {
      for (std::size_t k = 1; k <= 3; ++k) {
        if ((*i)[k].matched) keys.insert((*i)[k]);
      }
    }
  }
  return keys;
}

TEST(ExampleWorld, SaysEveryKeyAndTheDocumentTellsOfIt) {
  const std::string example = base::ReadText(kRoot / "configs/worlds/example/world.yaml").value() +
                              base::ReadText(kRoot / "configs/worlds/example/village.yaml").value();
  const std::string document = base::ReadText(kRoot / "docs/formats.md").value();
  const std::set<std::string> keys = AskedKeys();
  EXPECT_GT(keys.size(), 90u);
  // A world stands on a plane, on a terrain, which is a file or made, or on an OpenDRIVE file, under a picture that is draped or repeats: these
  // are the others.
  const std::set<std::string> elsewhere = {"ground", "network", "file", "registration", "slope_x", "slope_y", "template", "repeat_m"};
  for (const std::string& key : keys) {
    const std::regex said("(^|[\n {,\\[])" + key + ":");
    EXPECT_TRUE(std::regex_search(example, said) || elsewhere.contains(key)) << "the example does not say " << key;
    EXPECT_NE(document.find(key), std::string::npos) << "docs/formats.md does not tell of " << key;
  }
}

// Each type of object and each kind of line that a reader takes stands in it once.
TEST(ExampleWorld, HasEveryTypeOfObjectAndKindOfLine) {
  const std::string example = base::ReadText(kRoot / "configs/worlds/example/world.yaml").value();
  const std::string reader = base::ReadText(kRoot / "common/design/object_reader.cpp").value();
  const std::regex row(R"re(\{"([a-z_]+)", "[a-z]+", [0-9.]+, )re");
  int types = 0;
  for (std::sregex_iterator i(reader.begin(), reader.end(), row), end; i != end; ++i, ++types) EXPECT_NE(example.find("type: " + (*i)[1].str() + ","), std::string::npos) << (*i)[1];
  EXPECT_GE(types, 8);
  for (const network::LineKind& kind : network::kLineKinds) EXPECT_NE(example.find("kind: " + std::string(kind.name) + ","), std::string::npos) << kind.name;
}

TEST(ExampleWorld, IsAWorld) {
  const fs::path path = kRoot / "configs/worlds/example/world.yaml";
  for (const auto& problem : WorldProblems(path)) ADD_FAILURE() << problem.Text();
  const auto world = World::Load(path);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->network()->junctions().size(), 1u);
}

// Files beside a world are found from wherever one stands.
TEST(ExampleWorld, LoadsByARelativePathToo) {
  const fs::path before = fs::current_path();
  fs::current_path(kRoot);
  const auto world = World::Load("configs/worlds/example/world.yaml");
  fs::current_path(before);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->content_hash(), World::Load(kRoot / "configs/worlds/example/world.yaml").value()->content_hash());
}

}  // namespace
}  // namespace rodeira::road
