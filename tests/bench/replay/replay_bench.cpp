// SPDX-License-Identifier: Apache-2.0
// How long the viewer of a recording waits: to another place in an hour's file, and from picture to picture.
// The hour is a real recording again and again (RODEIRA_RECORDING=FILE; its view, cars and traffic are shown),
// or, without one, a car at 1 kHz and twenty others at 100 Hz that were never computed. It needs 2 to 5 GB in the
// temporary folder.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "common/core/base/random.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/renderer/renderer.hpp"
#include "tests/common/runtime/replay/made_recording.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;

constexpr Step kHour = 3'600'000;

constexpr const char* kLaunch =
    "rodeira: launch/1\nname: made\nnodes:\n  hands: {kind: input}\n  ego: {kind: vehicle}\n  others: {kind: "
    "traffic}\n  "
    "picture: {kind: view}\n";

// Numbers with low bits as good as random, as a vehicle's are.
base::Bytes Payload(const lockstep::Source& source, Step step) {
  const auto n = static_cast<std::uint64_t>(step);
  const auto noise = [n](std::uint64_t which) { return base::RandomUniform({which, n % 4000}); };
  if (source.topic == idl::topics::kControls) return idl::Encode(msg::Controls());
  if (source.topic == idl::topics::kVehicleState) {
    msg::VehicleState car;
    car.attitude_wb().w(1.0);
    car.position_w_m().x(20e-3 * static_cast<double>(step) + noise(1));
    for (std::size_t i = 0; i < car.wheels().size(); ++i) {
      car.wheels()[i].hub_b_m().z(noise(2 + i));
      car.wheels()[i].spin_rad(noise(6 + i));
    }
    return idl::Encode(car);
  }
  if (source.topic == idl::topics::kSignalsState) return idl::Encode(msg::SignalsState());
  if (source.topic == idl::topics::kTrafficDetails) return idl::Encode(msg::TrafficDetails());
  msg::TrafficState traffic;
  for (std::uint32_t id = 0; id < 20; ++id) {
    msg::TrafficAgent agent;
    agent.id(id);
    agent.position_x_m(10e-3 * static_cast<double>(step) + noise(10 + id));
    agent.position_y_m(noise(40 + id));
    agent.heading_rad(noise(70 + id));
    traffic.agents().push_back(agent);
  }
  return idl::Encode(traffic);
}

// The samples of a recording from its steps (0, last], said again and again with later steps.
class Loop {
 public:
  explicit Loop(const replay::RecordedRun& run) : last_(run.last_step()) {
    auto stream = run.Samples();
    for (auto sample = stream.Next(); sample && sample.value(); sample = stream.Next()) {
      payloads_[sample.value()->source()].push_back(sample.value()->payload);
    }
  }
  base::Bytes At(lockstep::SourceIndex index, const lockstep::Source& source, Step step) const {
    const auto& all = payloads_.at(index);
    return all.empty() ? base::Bytes() : *all[static_cast<std::size_t>((step % last_) / source.period) % all.size()];
  }

 private:
  Step last_;
  std::map<lockstep::SourceIndex, std::vector<std::shared_ptr<const base::Bytes>>> payloads_;
};

std::filesystem::path HourFile() {
  return std::filesystem::temp_directory_path() / ("rodeira-hour-" + std::to_string(::getpid()) + ".mcap");
}

void MakeHour() {
  replay::MadeRecording spec;
  spec.launch_text = kLaunch;
  spec.last_step = kHour;
  spec.payload = Payload;
  const char* real = std::getenv("RODEIRA_RECORDING");
  if (real == nullptr) return replay::Make(spec, HourFile());
  // Its own sources by the roster of the small launch text: cars and traffic are what is looked at.
  const auto run = replay::Must(replay::RecordedRun::Open(real));
  const auto loop = std::make_shared<Loop>(run);
  std::map<std::string, lockstep::SourceIndex> of_topic;
  for (lockstep::SourceIndex s = 0; s < run.roster().sources().size(); ++s) of_topic[run.roster().source(s).topic] = s;
  spec.payload = [loop, of_topic](const lockstep::Source& source, Step step) {
    const auto known = of_topic.find(source.topic);
    return known == of_topic.end() ? Payload(source, step) : loop->At(known->second, source, step);
  };
  replay::Make(spec, HourFile());
}

struct Hour {
  Hour() {
    MakeHour();
    run = std::make_unique<replay::RecordedRun>(replay::Must(replay::RecordedRun::Open(HourFile())));
  }
  ~Hour() { std::filesystem::remove(HourFile()); }
  std::unique_ptr<replay::RecordedRun> run;
};

const replay::RecordedRun& TheHour() {
  static const Hour kHourRun;
  return *kHourRun.run;
}

RecordedMoments MomentsOf(const replay::RecordedRun& run) {
  const Seen seen = replay::Must(LookAt(run, {}));
  return {run, seen.sources, seen.period};
}

// What of the file the system has in its memory is forgotten.
void ForgetFile() {
  const int file = ::open(HourFile().c_str(), O_RDONLY);
  if (file < 0) return;
  ::fdatasync(file);
  ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  ::close(file);
}

void Seek(benchmark::State& state) {
  const auto& run = TheHour();
  RecordedMoments moments = MomentsOf(run);
  const bool cold = state.range(0) != 0;
  std::uint64_t n = 0;
  double worst_s = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    if (cold) ForgetFile();
    const auto time_ns = static_cast<std::int64_t>(base::RandomUniform({7, n++}) * 3.6e12);
    state.ResumeTiming();
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(replay::Must(moments.At(time_ns)));
    worst_s = std::max(worst_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  state.counters["worst_ms"] = worst_s * 1e3;
  state.counters["chunks_a_seek"] = static_cast<double>(moments.sample_reader().chunks_read()) / static_cast<double>(n);
  state.counters["file_GB"] = static_cast<double>(run.reader().condition().file_bytes) * 1e-9;
}
BENCHMARK(Seek)->ArgName("cold")->Arg(0)->Arg(1)->Iterations(200)->Unit(benchmark::kMillisecond)->UseRealTime();

// The same until it is seen: drawn at 1280 x 720 and read back, in the real recording's world.
void SeekAndDraw(benchmark::State& state) {
  const char* real = std::getenv("RODEIRA_RECORDING");
  if (real == nullptr) return state.SkipWithError("a world is needed: RODEIRA_RECORDING=FILE");
  RecordedMoments moments = MomentsOf(TheHour());
  const auto recorded = replay::Must(replay::RecordedRun::Open(real));
  const auto world = replay::Must(nodes::WorldOf(recorded.launch()));
  auto settings = replay::Must(LookAt(recorded, {})).settings;
  auto surface = replay::Must(nodes::Surface::Open(nodes::SurfaceKind::kOffscreen, 1280, 720, "bench"));
  const auto renderer = replay::Must(nodes::RendererOf(*surface, *world, {}));
  renderer->DrawWhole(nodes::PictureOf(settings, replay::Must(moments.At(0))));
  std::uint64_t n = 0;
  double worst_s = 0.0;
  for (auto _ : state) {
    const auto time_ns = static_cast<std::int64_t>(base::RandomUniform({7, n++}) * 3.6e12);
    const auto begin = std::chrono::steady_clock::now();
    renderer->Draw(nodes::PictureOf(settings, replay::Must(moments.At(time_ns))));
    benchmark::DoNotOptimize(renderer->Read());
    worst_s = std::max(worst_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  state.counters["worst_ms"] = worst_s * 1e3;
  state.SetLabel(surface->renderer());
}
BENCHMARK(SeekAndDraw)->Iterations(200)->Unit(benchmark::kMillisecond)->UseRealTime();

// A picture after the other at 60 a second: speeds in tenths of real time, backward where negative.
void Play(benchmark::State& state) {
  const auto& run = TheHour();
  RecordedMoments moments = MomentsOf(run);
  const auto step_ns = static_cast<std::int64_t>(1e9 / 60.0 * 0.1 * static_cast<double>(state.range(0)));
  std::int64_t time_ns = 1'800'000'000'000;
  for (auto _ : state) {
    benchmark::DoNotOptimize(replay::Must(moments.At(time_ns)));
    time_ns += step_ns;
  }
}
BENCHMARK(Play)
    ->ArgName("tenths")
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Arg(-10)
    ->Arg(-100)
    ->Iterations(600)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void Open(benchmark::State& state) {
  TheHour();
  for (auto _ : state) benchmark::DoNotOptimize(replay::Must(replay::RecordedRun::Open(HourFile())).last_step());
}
BENCHMARK(Open)->Iterations(20)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace rodeira::cli
