#include "launch/recorded_moments.hpp"

#include <algorithm>
#include <utility>

#include "nodes/view/from_wire.hpp"

namespace rodeira::front {

using lockstep::Step;

RecordedMoments::RecordedMoments(const replay::RecordedRun& run, std::vector<lockstep::SourceIndex> sources, Step view_period)
    : run_(run), tape_(run, std::move(sources)), view_period_(view_period) {}

base::Result<scene::Moment> RecordedMoments::Exactly(Step step) {
  auto samples = tape_.At(step);
  if (!samples) return samples.error();
  view::NewestSamples newest;
  for (const auto& sample : samples.value()) {
    if (sample) newest[sample->source()] = sample->payload;
  }
  auto moment = view::MakeMoment(run_.roster(), step, newest);
  if (!moment) return base::Error{moment.error().code, moment.error().Text(), run_.path().string()};
  return moment;
}

base::Result<scene::Moment> RecordedMoments::At(std::int64_t time_ns) {
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

}  // namespace rodeira::front
