// SPDX-License-Identifier: Apache-2.0
// Manifests of nodes outside Rodeira: what a launch makes of them, and one sentence with its place for each that is
// wrong.
#include "common/runtime/launch/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/runtime/launch/files_of.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/sample_difference.hpp"
#include "common/runtime/launch/used_topics.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::launch {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr const char* kGaze = R"(#ifndef GAZE
#define GAZE
#include "sample_header.idl"
#include "point.idl"
module lab {
  @final
  struct Gaze {
    rodeira::msg::SampleHeader header;
    Point target;
  };
  struct Plain { double x; };
  struct Late { double x; rodeira::msg::SampleHeader header; };
};
#endif
)";
constexpr const char* kPoint = "module lab {\n  @final\n  struct Point { double x_m; double y_m; };\n};\n";
constexpr const char* kEye = R"(rodeira: node/1
period_s: 0.01
outputs:
  - {topic: lab/gaze, type: "lab::Gaze", idl: gaze.idl}
inputs:
  - {topic: rodeira/vehicle_state, port: state}
)";
constexpr const char* kMonitor = R"(rodeira: node/1
period_s: 0.05
inputs:
  - {topic: lab/gaze, port: event, many: true}
)";
constexpr const char* kLaunch = R"(rodeira: launch/1
nodes:
  driver: {kind: input, config: {source: script}}
  ego: {kind: vehicle}
  eye: {kind: external, program: ./eye_tracker, manifest: eye.yaml}
  monitor: {kind: external, program: monitor, manifest: monitor.yaml}
  recorder: {kind: recorder}
)";

class ManifestFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.Write("gaze.idl", kGaze);
    folder_.Write("point.idl", kPoint);
    folder_.Write("eye.yaml", kEye);
    folder_.Write("monitor.yaml", kMonitor);
    folder_.Write("lab.yaml", kLaunch);
  }
  base::Result<Launch> Load(const Overrides& overrides = {}) const {
    return Launch::Load(folder_.path() / "lab.yaml", overrides);
  }
  // The sentence for the launch with one piece of a file replaced; the file is whole again afterwards.
  std::string With(const std::string& file, std::string text, const std::string& before,
                   const std::string& after) const {
    const std::string whole = text;
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    folder_.Write(file, text.replace(at, before.size(), after));
    const auto launch = Load();
    folder_.Write(file, whole);
    EXPECT_FALSE(launch.ok()) << after;
    if (launch.ok()) return "";
    EXPECT_EQ(launch.error().exit_status(), 2);
    const std::string folder = folder_.path().string() + "/";
    std::string said = launch.error().Text();
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said.starts_with(folder) ? said.substr(folder.size()) : said;
  }
  std::string Eye(const std::string& before, const std::string& after) const {
    return With("eye.yaml", kEye, before, after);
  }
  std::string Gaze(const std::string& before, const std::string& after) const {
    return With("gaze.idl", kGaze, before, after);
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(ManifestFiles, GiveANodeItsPorts) {
  const Launch launch = Load().value();
  const auto& roster = launch.roster();
  const auto& eye = roster.node(roster.Find("eye"));
  EXPECT_EQ(eye.kind, "external");
  EXPECT_EQ(eye.period, 10);
  EXPECT_EQ(eye.delay, 10);
  ASSERT_EQ(eye.inputs.size(), 1u);
  EXPECT_EQ(roster.SourceName(eye.inputs[0].sources[0]), "ego.rodeira/vehicle_state");
  ASSERT_EQ(eye.outputs.size(), 1u);
  EXPECT_EQ(roster.source(eye.outputs[0]).topic, "lab/gaze");
  EXPECT_TRUE(eye.snapshots.has_value());
  const auto& monitor = roster.node(roster.Find("monitor"));
  EXPECT_TRUE(monitor.is_sink());
  ASSERT_EQ(monitor.inputs.size(), 1u);
  EXPECT_EQ(monitor.inputs[0].kind, lockstep::PortKind::kEvent);
  EXPECT_EQ(roster.SourceName(monitor.inputs[0].sources[0]), "eye.lab/gaze");
  const LaunchNode& node = launch.node(roster.Find("eye"));
  EXPECT_TRUE(node.is_external());
  EXPECT_FALSE(node.is_live());
  EXPECT_EQ(node.kind->program, (folder_.path() / "eye_tracker").string());
  EXPECT_TRUE(node.kind->can_save);
}

TEST_F(ManifestFiles, TopicsAreRecordedWithASelfContainedType) {
  const Launch launch = Load().value();
  const auto& roster = launch.roster();
  const auto& inputs = roster.node(roster.Find("recorder")).inputs;
  EXPECT_TRUE(std::ranges::any_of(inputs, [](const auto& port) { return port.topic == "lab/gaze"; }));
  const auto schema = launch.topics().SchemaOf("lab/gaze");
  ASSERT_TRUE(schema.has_value());
  EXPECT_EQ(schema->type, "lab::Gaze");
  EXPECT_EQ(schema->idl.find('#'), std::string::npos);
  EXPECT_FALSE(idl::DifferenceBetween({schema->idl, schema->type}, {schema->idl, "lab::Gaze"}).has_value());
  EXPECT_TRUE(UsedTopics(launch, roster.Find("eye")).contains("lab/gaze"));
  EXPECT_FALSE(UsedTopics(launch, roster.Find("ego")).contains("lab/gaze"));
  EXPECT_EQ(idl::FindTopic("lab/gaze"), nullptr) << "another launch has no such topic";
}

TEST_F(ManifestFiles, AreEmbeddedWithEverythingThatTheyInclude) {
  folder_.Write("eye_tracker", "a program");
  folder_.Write("monitor", "a program");
  folder_.Write("eye.so", "a shared object");
  const auto files = FilesOf(Load({{"nodes.eye.library", "eye.so"}}).value());
  ASSERT_TRUE(files.ok());
  std::vector<std::string> names;
  for (const NamedFile& file : files.value()) names.push_back(file.name);
  EXPECT_THAT(names, UnorderedElementsAre("lab.yaml", "eye.yaml", "gaze.idl", "point.idl", "monitor.yaml"));
  const cli::TemporaryFolder other;
  const auto laid_out = LayOut(files.value(), other.path());
  ASSERT_TRUE(laid_out.ok());
  const auto again = Launch::Load(laid_out.value());
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_EQ(again.value().roster().hash(), Load().value().roster().hash());
}

TEST_F(ManifestFiles, TheLaunchFileMaySetRatesAndWires) {
  const Launch launch = Load({{"nodes.eye.period_s", "0.02"}, {"nodes.eye.delay_s", "0.04"}}).value();
  const auto& eye = launch.roster().node(launch.roster().Find("eye"));
  EXPECT_EQ(eye.period, 20);
  EXPECT_EQ(eye.delay, 40);
  const Launch wired = Load({{"nodes.other", "{kind: external, program: eye_tracker, manifest: eye.yaml}"},
                             {"nodes.monitor.inputs", "{lab/gaze: [other]}"}})
                           .value();
  const auto& monitor = wired.roster().node(wired.roster().Find("monitor"));
  ASSERT_EQ(monitor.inputs[0].sources.size(), 1u);
  EXPECT_EQ(wired.roster().SourceName(monitor.inputs[0].sources[0]), "other.lab/gaze");
  folder_.Write("eye.yaml", std::string(kEye) + "delay_s: 0.03\ncan_save: false\n");
  const Launch late = Load().value();
  EXPECT_EQ(late.roster().node(late.roster().Find("eye")).delay, 30);
  EXPECT_FALSE(late.node(late.roster().Find("eye")).kind->can_save);
}

TEST_F(ManifestFiles, MayPublishATopicOfRodeira) {
  folder_.Write("eye.yaml", "rodeira: node/1\nperiod_s: 0.01\noutputs:\n  - {topic: rodeira/controls}\n");
  const auto launch = Load({{"nodes.driver.kind", "none"}, {"nodes.monitor.kind", "none"}});
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  const auto& roster = launch.value().roster();
  EXPECT_EQ(roster.SourceName(roster.node(roster.Find("ego")).inputs[0].sources[0]), "eye.rodeira/controls");
  EXPECT_TRUE(launch.value().topics().added().empty());
}

TEST_F(ManifestFiles, ADifferenceOfTwoSamplesHasItsField) {
  const Launch launch = Load().value();
  const auto& roster = launch.roster();
  const lockstep::SourceIndex source = roster.node(roster.Find("eye")).outputs[0];
  const auto sample = [&](double y_m) {
    base::Bytes payload{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
    base::ByteWriter out;
    for (int i = 0; i < 4; ++i) out.Put(std::uint64_t{0});  // the header
    out.Put(1.5);
    out.Put(y_m);
    payload.insert(payload.end(), out.bytes().begin(), out.bytes().end());
    lockstep::SampleHeader header;
    header.source = source;
    header.Write(payload);
    return lockstep::Sample{header, std::make_shared<const base::Bytes>(payload)};
  };
  const auto found = SampleDifference(roster, launch.topics()).Between(sample(2.0), sample(2.5));
  EXPECT_EQ(found.path, "target.y_m");
  EXPECT_EQ(found.a, "2");
  EXPECT_EQ(found.b, "2.5");
}

TEST_F(ManifestFiles, WrongManifestsAreRefused) {
  EXPECT_THAT(Eye("node/1", "node/2"), HasSubstr("eye.yaml:1: 'rodeira' is 'node/2'"));
  EXPECT_THAT(Eye("period_s: 0.01\n", ""), HasSubstr("'period_s' is missing"));
  EXPECT_THAT(Eye("period_s: 0.01", "period_ms: 10"), HasSubstr("eye.yaml:2: unknown key 'period_ms'"));
  EXPECT_THAT(Eye("period_s: 0.01", "period_s: 0.0015"), HasSubstr("lab.yaml:5: 'period_s' is 0.0015 s; a multiple"));
  EXPECT_THAT(Eye(", port: state", ""), HasSubstr("eye.yaml:6: key 'inputs[0].port' is missing"));
  EXPECT_THAT(Eye("port: state", "port: stat"),
              HasSubstr("eye.yaml:6: 'inputs[0].port' is 'stat'; did you mean 'state'?"));
  EXPECT_THAT(Eye("vehicle_state", "vehicle_stat"),
              HasSubstr("eye.yaml:6: no node can publish the topic 'rodeira/vehicle_stat'; did you mean "
                        "'rodeira/vehicle_state'?"));
  EXPECT_THAT(Eye("rodeira/vehicle_state", "rodeira/snapshot"), HasSubstr("eye.yaml:6: no node can publish the topic"));
  EXPECT_THAT(Eye("inputs:", "inputs:\n  - {topic: rodeira/vehicle_state, port: event}"),
              HasSubstr("eye.yaml:7: input 'rodeira/vehicle_state' is there twice"));
  EXPECT_THAT(With("monitor.yaml", kMonitor, "lab/gaze", "lab/gase"),
              HasSubstr("monitor.yaml:4: no node can publish the topic 'lab/gase'; did you mean 'lab/gaze'?"));
}

TEST_F(ManifestFiles, WrongOutputsAreRefused) {
  EXPECT_THAT(Eye("lab/gaze", "rodeira/gaze"), HasSubstr("eye.yaml:4: 'rodeira/gaze' is not a topic that a node can"));
  EXPECT_THAT(Eye("lab/gaze", "rodeira/snapshot"), HasSubstr("eye.yaml:4: 'rodeira/snapshot' is not a topic that a"));
  EXPECT_THAT(Eye("lab/gaze", "Gaze!"), HasSubstr("eye.yaml:4: 'Gaze!' is not the name of a topic"));
  EXPECT_THAT(Eye("lab/gaze", "rodeira/controls"), HasSubstr("eye.yaml:4: 'rodeira/controls' is a topic of Rodeira"));
  EXPECT_THAT(Eye("type: \"lab::Gaze\", ", ""), HasSubstr("eye.yaml:4: key 'outputs[0].type' is missing"));
  EXPECT_THAT(Eye(", idl: gaze.idl", ""), HasSubstr("eye.yaml:4: key 'idl' of output 'lab/gaze' is missing"));
  EXPECT_THAT(Eye("gaze.idl", "gase.idl"), HasSubstr("eye.yaml:4: gase.idl: there is no such file"));
  EXPECT_THAT(Eye("gaze.idl", "eye.yaml"), HasSubstr("a file NAME.idl was expected"));
  EXPECT_THAT(Eye("lab::Gaze", "lab::Gase"), Names("eye.yaml:4: gaze.idl: … 'lab::Gase' … 'lab::Gaze'"));
  for (const char* type : {"lab::Plain", "lab::Late"})
    EXPECT_THAT(Eye("lab::Gaze", type),
                HasSubstr("eye.yaml:4: the first member of '" + std::string(type) + "' is not the sample header"));
  EXPECT_THAT(Eye("outputs:", "outputs:\n  - {topic: lab/gaze, type: \"lab::Gaze\", idl: gaze.idl}"),
              HasSubstr("eye.yaml:5: output 'lab/gaze' is there twice"));
}

TEST_F(ManifestFiles, WrongIdlIsRefusedWithItsOwnLine) {
  EXPECT_THAT(Gaze("Point target;", "Point target"), HasSubstr("gaze.idl:10: "));
  EXPECT_THAT(Gaze("Point target;", "Pont target;"), HasSubstr("gaze.idl:9: "));
  EXPECT_THAT(With("point.idl", kPoint, "double y_m;", "union y_m;"), HasSubstr("point.idl:3: "));
  EXPECT_THAT(Gaze("#include \"point.idl\"", "#include \"pint.idl\""),
              HasSubstr("gaze.idl:4: cannot open 'pint.idl': no such file beside this one, nor in Rodeira's IDL"));
  EXPECT_THAT(Gaze("#include \"point.idl\"", "#include \"/point.idl\""),
              HasSubstr("gaze.idl:4: '/point.idl' was found"));
  EXPECT_THAT(Gaze("#include \"point.idl\"", "#include <point.idl>"), HasSubstr("gaze.idl:4: #include \"FILE\" was"));
  EXPECT_THAT(Gaze("#ifndef GAZE", "#if GAZE"), HasSubstr("gaze.idl:1: '#if' was found"));
}

TEST_F(ManifestFiles, OneTopicHasOneType) {
  const std::string other = std::string(kEye).replace(std::string(kEye).find("gaze.idl"), 8, "old_.idl");
  folder_.Write("old_.idl", std::string(kGaze).replace(std::string(kGaze).find("Point target"), 12, "double target"));
  folder_.Write("other.yaml", other);
  const auto launch = Load({{"nodes.second", "{kind: external, program: x, manifest: other.yaml}"}});
  ASSERT_FALSE(launch.ok());
  EXPECT_THAT(
      launch.error().Text(),
      HasSubstr("other.yaml:4: topic 'lab/gaze' has another type than in the node before: lab::Gaze, member 2"));
}

TEST_F(ManifestFiles, TheLaunchFileNamesProgramAndManifest) {
  const auto said = [&](const std::string& node) {
    const auto launch = Load({{"nodes.eye", node}});
    return launch.ok() ? std::string() : launch.error().Text();
  };
  EXPECT_THAT(said("{kind: external, manifest: eye.yaml}"), HasSubstr("key 'nodes.eye.program' is missing"));
  EXPECT_THAT(said("{kind: external, program: eye_tracker}"), HasSubstr("key 'nodes.eye.manifest' is missing"));
  EXPECT_THAT(said("{kind: external, program: eye_tracker, manifest: none.yaml}"),
              HasSubstr("none.yaml: there is no such"));
  EXPECT_THAT(said("{kind: external, program: eye_tracker, manifest: gaze.idl}"), HasSubstr("a file NAME.yaml was"));
  EXPECT_THAT(said("{kind: empty, program: eye_tracker}"), HasSubstr("unknown key 'nodes.eye.program'"));
  EXPECT_THAT(said("{kind: extern}"), HasSubstr("did you mean 'external'?"));
}

TEST_F(ManifestFiles, MayIncludeRodeirasTypes) {
  folder_.Write("gaze.idl", std::string("#include \"vehicle.idl\"\n#include \"sample_header.idl\"\n") +
                                "module lab { struct Gaze { rodeira::msg::SampleHeader header; rodeira::msg::Vector3 "
                                "target; }; };\n");
  const auto launch = Load();
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
}

}  // namespace
}  // namespace rodeira::launch
