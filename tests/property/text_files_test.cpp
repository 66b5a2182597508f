// SPDX-License-Identifier: Apache-2.0
// Every reader of a text file that a person writes, against many seeded mutations of good files: what comes is the
// thing itself, which then can be used, or one sentence (law L6); never a crash, never a hang. RODEIRA_FUZZ_FILES sets
// how many texts a format is tried with, RODEIRA_FUZZ_FIRST with which number they begin.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>

#include "common/core/config/config.hpp"
#include "common/data/decode/type_text.hpp"
#include "common/driving/driver/autopilot.hpp"
#include "common/driving/scenario/scenario_file.hpp"
#include "common/runtime/launch/lab.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/manifest.hpp"
#include "common/vehicle/dynamics/tir_file.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/multibody/mechanism.hpp"
#include "common/world/road/world.hpp"
#include "idl/idl_source.hpp"
#include "nodes/input/script_source.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/property/fuzz.hpp"
#include "tests/property/good_file.hpp"
#include "tests/tree.hpp"

namespace rodeira::property {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

// For readers that take a path.
class OnDisk {
 public:
  OnDisk() { fs::create_directories(folder_); }
  ~OnDisk() { fs::remove_all(folder_); }
  OnDisk(const OnDisk&) = delete;
  OnDisk& operator=(const OnDisk&) = delete;
  fs::path Put(const std::string& text, const char* name = "file.yaml") const {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << text;
    return folder_ / name;
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("rodeira-property-" + std::to_string(::getpid()));
};

// Asks a mapping for everything in all the ways there are.
void AskAll(const config::Map& map, int depth) {
  for (const std::string& key : map.Keys()) {
    (void)map.Number(key, config::Range::Positive());
    (void)map.Integer(key, -5, 5);
    (void)map.Text(key);
    (void)map.Choice(key, {"a", "b"});
    (void)map.Numbers(key);
    (void)map.Path(key);
    (void)map.Place(key);
    const config::List list = map.OptionalItems(key);
    for (std::size_t i = 0; i < list.size(); ++i) {
      (void)list.Number(i);
      (void)list.Text(i);
      (void)list.Numbers(i);
      if (depth > 0) AskAll(list.At(i), depth - 1);
    }
    if (depth > 0) AskAll(map.OptionalChild(key), depth - 1);
  }
}

TEST(TextFiles, AnyYaml) {
  const std::string special =
      "a: &d [1, {e: f}]\nb: *d\nc: >\n  folded\n  text\nd: |-\n  x\ne: &x {f: 'g'}\nh: {<<: *x}\n? k\n: \"\\u00e9\"\n";
  Fuzz("yaml", {GoodFile("launch/demo.yaml"), GoodFile("configs/vehicles/default.yaml"), special},
       [](const std::string& text) -> std::optional<base::Error> {
         auto file = config::File::Parse(text, "some.yaml");
         if (!file) return file.error();
         AskAll(file.value().root(), 4);
         for (const base::Error& problem : file.value().Problems()) ExpectSentence(problem);
         for (const char* key : {"a", "nodes.ego.period_s", "body.mass_kg", "nodes"}) {
           if (const auto status = file.value().Override(key, "{a: [1, 2]}"); !status) ExpectSentence(status.error());
         }
         AskAll(file.value().root(), 4);
         return std::nullopt;
       });
}

TEST(TextFiles, LaunchFiles) {
  Fuzz("launch",
       {GoodFile("launch/demo.yaml"), GoodFile("launch/first_drive.yaml"), GoodFile("launch/empty.yaml"),
        GoodFile("tests/data/drive_without_recorder.yaml"), GoodFile("launch/keyboard.yaml")},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto launch = launch::Launch::Parse(text, kRoot / "launch/fuzz.yaml");
         if (!launch) return launch.error();
         const auto& roster = launch.value().roster();
         EXPECT_EQ(roster.nodes().size(), launch.value().nodes().size());
         EXPECT_GT(roster.base_step_ns(), 0);
         for (const auto& node : roster.nodes()) EXPECT_EQ(node.delay % node.period, 0);
         return std::nullopt;
       });
}

// Of external nodes: the manifest, and the IDL file that it names.
TEST(TextFiles, Manifests) {
  const OnDisk disk;
  disk.Put(GoodFile("examples/own_node/gaze.idl"), "gaze.idl");
  Fuzz("manifest", {GoodFile("examples/own_node/eye.yaml"), GoodFile("examples/own_node/monitor.yaml")},
       [&](const std::string& text) -> std::optional<base::Error> {
         const auto manifest = launch::ReadManifest(disk.Put(text));
         if (!manifest) return manifest.error();
         const launch::Manifest& read = manifest.value();
         EXPECT_GT(read.kind.default_period_s, 0.0);
         EXPECT_EQ(read.topics.size(), read.topic_places.size());
         EXPECT_EQ(read.kind.inputs.size(), read.input_places.size());
         idl::TopicTable table;
         for (const idl::AddedTopic& topic : read.topics) EXPECT_TRUE(table.Add(topic).ok());
         if (const auto status = launch::CheckInputs(read, table); !status) ExpectSentence(status.error());
         return std::nullopt;
       });
}

TEST(TextFiles, IdlOfExternalNodes) {
  const std::string header = GoodFile("idl/sample_header.idl");
  const std::string nested =
      "#include \"sample_header.idl\"\nmodule lab {\n  enum Eye { kLeft, kRight };\n  @final struct Point { double "
      "x_m; "
      "float y_m[3]; };\n  @final struct Gaze {\n    rodeira::msg::SampleHeader header;\n    sequence<Point> points;\n"
      "    string name;  // a comment\n    Eye eye;\n  };\n};\n";
  Fuzz("idl", {GoodFile("examples/own_node/gaze.idl"), nested},
       [&](const std::string& text) -> std::optional<base::Error> {
         const auto source = idl::IdlSource::Read("gaze.idl", [&](const fs::path& file) -> base::Result<std::string> {
           if (file == "gaze.idl") return text;
           if (file.filename() == "sample_header.idl") return header;
           return base::WrongInput("file.not_found", "no such file", file.string());
         });
         if (!source) return source.error();
         const auto type = source.value().Find("lab::Gaze");
         if (!type) return type.error();
         EXPECT_FALSE(decode::CanonicalIdl(*type.value()).empty());
         return std::nullopt;
       });
}

TEST(TextFiles, Laboratories) {
  const launch::Launch launch =
      launch::Launch::Parse("rodeira: launch/1\nnodes: {a: {kind: empty}}\n", "empty.yaml").value();
  Fuzz("laboratory", {GoodFile("configs/labs/two_pcs.yaml"), GoodFile("configs/labs/three_pcs.yaml")},
       [&launch](const std::string& text) -> std::optional<base::Error> {
         const auto lab = launch::Lab::Parse(text, "fuzz.yaml");
         if (!lab) return lab.error();
         EXPECT_FALSE(lab.value().hosts().empty());
         EXPECT_TRUE(lab.value().Host(lab.value().clock()).ok());
         // What it says to the processes of a host must be a launch file's language, whatever stands in it.
         for (const launch::LabHost& host : lab.value().hosts()) {
           const auto told = launch::Launch::Parse(launch.text(), "empty.yaml", lab.value().For(host));
           EXPECT_TRUE(told.ok()) << (told.ok() ? "" : told.error().Text());
         }
         return std::nullopt;
       });
}

TEST(TextFiles, TyreProperties) {
  const std::string good =
      "[UNITS]\nLENGTH ='meter'\nANGLE = 'radians'\n[MODEL]\nFITTYP = 61 $version\n[VERTICAL]\nFNOMIN = "
      "4000\n[LONGITUDINAL_COEFFICIENTS]\n"
      "PCX1 = 1.6\nPDX1 = 1.1\nPKX1 = 2.1E1\n{x y}\n 1.0 2\n[LATERAL_COEFFICIENTS]\nPCY1=1.3\nPDY1 = 1.0\nPKY1 = "
      "-18\n! end\n";
  Fuzz("tyre", {good, good + "PHY3 = +.04\r\nFZMAX = 9e3"}, [](const std::string& text) -> std::optional<base::Error> {
    const auto tyre = dynamics::ParseTir(text, "fuzz.tir");
    if (!tyre) return tyre.error();
    EXPECT_LT(tyre.value().pky1, 0.0);
    (void)dynamics::SteadyForces(tyre.value(), {0.1, -0.1, 0.05}, 3000.0, 1.0);
    return std::nullopt;
  });
}

TEST(TextFiles, Worlds) {
  Fuzz("world", {road::kSample, road::kSample, GoodFile("configs/worlds/plane.yaml")},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto world = road::World::Parse(text, "fuzz.yaml");
         if (!world) return world.error();
         const auto ground = world.value()->MakeGround();
         std::vector<ground::GroundQuery> queries;
         for (const double x : {0.0, -50.25, 37.5, 1e6, -1e300}) queries.push_back({x, 0.3 * x, 0.0});
         std::vector<ground::GroundPoint> points(queries.size());
         ground->Query(queries, points);
         for (const auto& point : points) EXPECT_TRUE(std::isfinite(point.z_m) || !point.inside);
         return std::nullopt;
       });
}

TEST(TextFiles, Vehicles) {
  const OnDisk disk;
  Fuzz("vehicle", {GoodFile("configs/vehicles/default.yaml"), GoodFile("configs/vehicles/prototype.yaml")},
       [&disk](const std::string& text) -> std::optional<base::Error> {
         const auto loaded = dynamics::LoadVehicle(disk.Put(text));
         if (!loaded) return loaded.error();
         dynamics::VehicleModel& model = *loaded.value();
         dynamics::HillGround ground(1, {});
         dynamics::InitialCondition initial;
         initial.speed_mps = 10.0;
         if (!model.Initialise(initial, ground)) return std::nullopt;
         dynamics::Controls controls;
         controls.throttle = 0.5;
         controls.steering_wheel_rad = 0.3;
         for (int i = 0; i < 20; ++i) model.Step(controls, ground, 0.001);
         return std::nullopt;
       });
}

TEST(TextFiles, Mechanisms) {
  const std::string forces =
      "rodeira: mechanism/1\npoints: {O: {at_m: [0, 0, 0], fixed: true}, P: {at_m: [1, 0, 0], velocity_mps: [0, 1, "
      "0]}}\n"
      "vectors: {u: {direction: [1, 0, 0]}, v: {direction: [0, 1, 0]}, w: {direction: [0, 0, 1], fixed: true}}\n"
      "bodies: {b: {points: [P], vectors: [u, v, w], mass_kg: 2, centre_m: [1, 0, 0.1], inertia_kgm2: [1, 1, 1, 0, 0, "
      "0.1]}}\n"
      "markers: {M: {body: b, at_m: [2, 0, 0]}}\nangles: {a: {of: [u], from: [world x], to: [world y], rate_radps: "
      "2}}\n"
      "distances: {s: {points: [O, P]}}\nforces:\n"
      "  f: {kind: spring, coordinate: s, spring_m_N: [[-1, -10], [1, 10]], damper_mps_N: [[-1, -5], [1, 3]], stops_m: "
      "[0.5, 2], stop_stiffness_Npm: 100}\n"
      "  t: {kind: torsion, coordinate: a, stiffness_Nmprad: 5, damping_Nmsprad: 0.1}\n"
      "  g: {kind: force, point: M, direction: [0, 1, 1], force_N: 3, sine: {amplitude: 2, frequency_Hz: 3}}\n"
      "  d: {kind: drag, point: M, drag_area_m2: 0.1}\noutputs: {x: M.x, v: M.vz, a: a.rate, f: force f, e: energy}\n";
  Fuzz("mechanism",
       {GoodFile("configs/mechanisms/pendulum.yaml"), GoodFile("configs/mechanisms/four_bar_2.yaml"),
        GoodFile("configs/mechanisms/andrews.yaml"), GoodFile("configs/mechanisms/bricard.yaml"), forces},
       [](const std::string& text) -> std::optional<base::Error> {
         auto loaded = multibody::ParseMechanism(text, "fuzz.yaml");
         if (!loaded) return loaded.error();
         multibody::Mechanism& mechanism = loaded.value();
         for (int i = 0; i < 20; ++i) {
           if (!mechanism.system->Step(1e-4).converged) break;
         }
         for (const auto& output : mechanism.outputs) (void)output.ValueOf(*mechanism.system);
         return std::nullopt;
       });
}

TEST(TextFiles, Drivers) {
  const OnDisk disk;
  Fuzz("driver", {GoodFile("configs/drivers/default.yaml")},
       [&disk](const std::string& text) -> std::optional<base::Error> {
         const auto driver = driver::LoadDriver(disk.Put(text));
         if (!driver) return driver.error();
         return std::nullopt;
       });
}

TEST(TextFiles, Keyboards) {
  const OnDisk disk;
  Fuzz("keyboard", {GoodFile("configs/drivers/keyboard.yaml")},
       [&disk](const std::string& text) -> std::optional<base::Error> {
         const auto settings = input_devices::LoadKeyboard(disk.Put(text));
         if (!settings) return settings.error();
         EXPECT_FALSE(input_devices::KeyboardHelp(settings.value()).empty());
         input_devices::KeyboardDriver driver(settings.value());
         input_devices::KeyboardInput all;
         for (bool& held : all.held) held = true;
         all.held[1] = false;
         all.lever = {1, 3, 1, 2};
         for (int i = 0; i < 20; ++i) {
           const dynamics::Controls controls = driver.Step(all, 0.1);
           EXPECT_TRUE(std::isfinite(controls.steering_wheel_rad) && controls.throttle >= 0.0 &&
                       controls.throttle <= 1.0 && controls.brake <= 1.0);
         }
         return std::nullopt;
       });
}

TEST(TextFiles, Wheels) {
  const OnDisk disk;
  const std::string rich =
      "rodeira: wheel/1\ndevices:\n  rim: 030000006d0400004fc2000011010000\n  feet: 03000000b70400004fc2000011010000\n"
      "steering: {device: rim, axis: 0, centre: 12, dead_zone: 0.01, exponent: 1.5, lock_deg: 540}\npedals: {device: "
      "feet, axis: 1, inverted: true}\n"
      "clutch: {device: feet, axis: 2, min: 0, max: 255}\nbuttons:\n  starter: {device: rim, button: 3}\nlever:\n  "
      "reverse: {device: rim, button: 8}\n  1: {device: rim, button: 9}\n";
  Fuzz("wheel", {GoodFile("configs/drivers/wheel.yaml"), rich},
       [&disk](const std::string& text) -> std::optional<base::Error> {
         const auto settings = input_devices::LoadWheel(disk.Put(text));
         if (!settings) return settings.error();
         input_devices::WheelDriver driver(settings.value());
         std::vector<input_devices::DeviceReading> readings(settings.value().devices.size());
         for (const double raw : {0.0, 32767.0, -32768.0, 100.0}) {
           for (auto& reading : readings)
             reading = {true, std::vector<double>(3, raw), std::vector<std::uint8_t>(10, raw > 0.0)};
           const dynamics::Controls controls = driver.Step(readings, 1);
           EXPECT_TRUE(std::isfinite(controls.steering_wheel_rad));
           for (const double pedal : {controls.throttle, controls.brake, controls.clutch, controls.handbrake})
             EXPECT_TRUE(pedal >= 0.0 && pedal <= 1.0) << pedal;
         }
         return std::nullopt;
       });
}

TEST(TextFiles, Scenarios) {
  const OnDisk disk;
  Fuzz("scenario", {GoodFile("configs/scenarios/car_ahead_brakes.yaml")},
       [&disk](const std::string& text) -> std::optional<base::Error> {
         const auto scenario = scenario::LoadScenario(disk.Put(text), {1'000'000, 10, 10});
         if (!scenario) return scenario.error();
         std::int64_t before = 10;
         for (const auto& event : scenario.value().scheduled) {
           EXPECT_TRUE(event.step >= before && event.step % 10 == 0) << event.step;
           EXPECT_NE(scenario::FindEventKind(event.event.name), nullptr) << event.event.name;
           before = event.step;
         }
         return std::nullopt;
       });
}

TEST(TextFiles, InputScripts) {
  Fuzz("script",
       {GoodFile("configs/scenarios/first_drive.csv"),
        "time_s,clutch,gear,manual,starter\n0,1,1,1,1\n0.5,0.5,1,1,0\n2,0,2,1,0\n"},
       [](const std::string& text) -> std::optional<base::Error> {
         const auto script = nodes::Script::Parse(text, "fuzz.csv");
         if (!script) return script.error();
         for (const double t : {-1.0, 0.0, 0.3, 6.5, 1e7, 1e9}) {
           const dynamics::Controls controls = script.value().At(t);
           EXPECT_TRUE(std::isfinite(controls.steering_wheel_rad));
           EXPECT_TRUE(controls.throttle >= 0.0 && controls.throttle <= 1.0 && controls.brake >= 0.0 &&
                       controls.brake <= 1.0);
         }
         return std::nullopt;
       });
}

}  // namespace
}  // namespace rodeira::property
