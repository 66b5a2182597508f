// What mutated files found: each is a road or a sentence.
#include <gmock/gmock.h>

#include "tests/common/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

std::string Roads(const std::string& axis, const std::string& more) {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [" + axis + "]\n    section: {template: rural}\n" + more;
}

TEST(OddFiles, ARoadOfACentimetreIsARoad) {
  const Design design = SoundDesign(Roads("line: {length_m: 0.01}", ""));
  ASSERT_NE(design.network, nullptr);
  EXPECT_DOUBLE_EQ(design.network->roads()[0].length_m(), 0.01);
}

TEST(OddFiles, ASurfaceWithoutAFileIsASentence) {
  EXPECT_THAT(FirstProblem(Roads("line: {length_m: 50}", "    surfaces: [{crg: {a: 1}}]\n")), HasSubstr("made.yaml:6: 'roads[0].surfaces[0].crg'"));
}

// A path that no file system takes.
TEST(OddFiles, AnIncludedNameThatIsTooLongIsASentence) {
  EXPECT_THAT(FirstProblem("rodeira: world/2\ninclude: [" + std::string(5000, 'x') + ".yaml]\n" + Roads("line: {length_m: 50}", "").substr(17)), HasSubstr("made.yaml:2: "));
}

}  // namespace
}  // namespace rodeira::design
