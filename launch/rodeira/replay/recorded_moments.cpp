// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/recorded_moments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/view/run_connection/from_wire.hpp"

namespace rodeira::cli {

using lockstep::Step;

namespace {
constexpr double kRepeat_s = 1.0;  // details of the traffic are said ten times a second: all that drive are in them
}

RecordedMoments::RecordedMoments(const replay::RecordedRun& run, std::vector<lockstep::SourceIndex> sources,
                                 Step view_period)
    : run_(run), sample_reader_(run, std::move(sources)), view_period_(view_period) {}

base::Result<scene::SceneSnapshot> RecordedMoments::Exactly(Step step) {
  auto samples = sample_reader_.At(step);
  if (!samples) return samples.error();
  nodes::NewestSamples newest;
  for (auto& sample : samples.value()) {
    if (auto status = FindWhatSays(sample); !status) return status.error();
    if (sample) newest[sample->source()] = sample->payload;
  }
  auto moment = nodes::MakeMoment(run_.roster(), step, newest);
  if (!moment) return moment.error().In(run_.path().string());
  return moment;
}

base::Status RecordedMoments::FindWhatSays(std::optional<lockstep::Sample>& sample) {
  if (!sample) return {};
  const lockstep::Source& source = run_.roster().source(sample->source());
  const Step longest = std::llround(kRepeat_s * 1e9 / static_cast<double>(run_.roster().base_step_ns()));
  const Step oldest = std::max<Step>(0, sample->valid() - longest);
  while (sample && !nodes::SaysSomething(source.topic, *sample->payload)) {
    const Step before = sample->valid() - source.period;
    if (before < oldest) return {};
    auto found = sample_reader_.Newest(sample->source(), before);
    if (!found) return found.error();
    sample = std::move(found).value();
  }
  return {};
}

base::Result<scene::SceneSnapshot> RecordedMoments::At(std::int64_t time_ns) {
  const Step now = std::clamp<Step>(time_ns / run_.roster().base_step_ns(), 0, run_.last_step());
  const Step from = lockstep::FloorTo(now, view_period_);
  if (from != between_from_) {
    scene::PoseHistory between;
    for (const Step step : {from, std::min(from + view_period_, run_.last_step())}) {
      auto moment = Exactly(step);
      if (!moment) return moment.error();
      between.Add(std::move(moment).value());
    }
    between_ = std::move(between);
    between_from_ = from;
  }
  return between_.At(static_cast<double>(time_ns));
}

}  // namespace rodeira::cli
