// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/view_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/core/base/log.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/view/run_connection/from_wire.hpp"
#include "nodes/view/view_settings.hpp"
#include "nodes/view/visual_database/find_built.hpp"
#include "nodes/view/window/render_thread.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;
using lockstep::Sample;
using lockstep::SourceIndex;
using lockstep::Step;

base::Result<std::vector<scenario::Event>> EventsOf(const base::Bytes& payload) {
  const auto message = idl::Decode<msg::ScenarioEvents>(payload);
  if (!message) return message.error();
  std::vector<scenario::Event> events;
  for (const msg::ScenarioEvent& event : message.value().events())
    events.push_back({event.name(), event.argument(), event.value()});
  return events;
}

class ViewNode final : public lockstep::Node {
 public:
  ViewNode(const lockstep::Roster& roster, std::string name, nodes::ViewSettings settings,
           std::unique_ptr<nodes::RenderThread> render_thread)
      : roster_(roster),
        name_(std::move(name)),
        settings_(std::move(settings)),
        render_thread_(std::move(render_thread)) {}

  base::Status Initialise(lockstep::Outbox&) override { return {}; }

  // A view that takes a dead one's place begins at its last activation at the earliest: pictures of those before must
  // be written.
  base::Status Flush() override {
    return render_thread_ == nullptr || settings_.frame_steps.empty() ? base::Status() : render_thread_->Drain();
  }

  base::Status Step(const lockstep::StepInfo& info, const lockstep::Inbox& inbox, lockstep::Outbox&) override {
    if (auto status = Take(inbox, info.step - info.period, info.step); !status) return status;
    if (render_thread_ == nullptr) return {};
    if (auto status = render_thread_->status(); !status) return status;
    if (!render_thread_->has_window()) return {};
    if (auto status = TellEvents(inbox); !status) return status;
    auto moment = nodes::MakeMoment(roster_, info.step, newest_);
    if (!moment) return moment.error();
    render_thread_->Show(std::move(moment).value());
    return {};
  }

  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step last_step, bool complete) override {
    const lockstep::Step after = taken_through_;
    if (auto status = Take(rest, after, last_step); !status) return status;
    if (render_thread_ != nullptr) {
      if (auto status = render_thread_->Drain(); !status) return status;
    }
    const auto missed = std::upper_bound(settings_.frame_steps.begin(), settings_.frame_steps.end(), last_step);
    if (complete && missed != settings_.frame_steps.end()) {
      base::Log(base::LogLevel::kWarning, name_,
                fmt::format("the run ended at step {}, before {} of the frames asked for (the first of them is of "
                            "step {})",
                            last_step, settings_.frame_steps.end() - missed, *missed));
    }
    return {};
  }

  void Save(base::StateWriter& out) const override {
    out.Put("taken_through", taken_through_);
    out.Put("sources", static_cast<std::uint32_t>(newest_.size()));
    for (const auto& [source, payload] : newest_) {
      out.Put("source", source);
      out.Put("payload",
              std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(payload->data()), payload->size()));
    }
  }

  void Restore(base::StateReader& in) override {
    newest_.clear();
    std::uint32_t count = 0;
    in.Get("taken_through", taken_through_);
    in.Get("sources", count);
    for (std::uint32_t i = 0; i < count && i < roster_.sources().size(); ++i) {
      SourceIndex source = 0;
      std::vector<std::uint8_t> payload;
      in.Get("source", source);
      in.Get("payload", payload);
      const auto bytes = std::as_bytes(std::span(payload));
      newest_[source] = std::make_shared<const base::Bytes>(bytes.begin(), bytes.end());
    }
  }

 private:
  // Takes the samples in their order and orders the frames of steps in (after, through] on the way.
  base::Status Take(const lockstep::Inbox& inbox, lockstep::Step after, lockstep::Step through) {
    std::vector<const Sample*> samples;
    for (const std::string_view topic : {topics::kVehicleState, topics::kTrafficState, topics::kTrafficDetails,
                                         topics::kSignalsState, topics::kWeatherState}) {
      if (!inbox.Has(topic)) continue;
      for (const Sample& sample : inbox.All(topic)) {
        if (nodes::SaysSomething(topic, *sample.payload)) samples.push_back(&sample);
      }
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample* a, const Sample* b) { return a->valid() < b->valid(); });
    auto next = samples.begin();
    const auto take_through = [&](lockstep::Step step) {
      for (; next != samples.end() && (*next)->valid() <= step; ++next) newest_[(*next)->source()] = (*next)->payload;
    };
    const auto first = std::upper_bound(settings_.frame_steps.begin(), settings_.frame_steps.end(), after);
    for (auto frame = first; frame != settings_.frame_steps.end() && *frame <= through; ++frame) {
      take_through(*frame);
      if (auto status = WriteFrame(*frame); !status) return status;
    }
    take_through(through);
    taken_through_ = through;
    return {};
  }

  // A window that has asked for something waits for it here.
  base::Status TellEvents(const lockstep::Inbox& inbox) {
    if (!settings_.can_ask || !inbox.Has(topics::kScenarioEvents)) return {};
    for (const Sample& sample : inbox.All(topics::kScenarioEvents)) {
      auto events = EventsOf(*sample.payload);
      if (!events) return events.error();
      if (!events.value().empty()) render_thread_->Tell(events.value());
    }
    return {};
  }

  base::Status WriteFrame(lockstep::Step step) {
    auto moment = nodes::MakeMoment(roster_, step, newest_);
    if (!moment) return moment.error();
    return render_thread_->Order(nodes::PictureOf(settings_, std::move(moment).value()),
                                 settings_.folder / nodes::FrameName(step));
  }

  const lockstep::Roster& roster_;
  std::string name_;
  nodes::ViewSettings settings_;
  std::unique_ptr<nodes::RenderThread> render_thread_;  // null: nothing is drawn
  nodes::NewestSamples newest_;
  lockstep::Step taken_through_ = -1;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeViewNode(launch::NodeContext& context) {
  auto settings = nodes::ReadViewSettings(context);
  if (!settings) return settings.error();
  const auto read = [&context]() -> base::Result<nodes::ReadWorld> {
    auto world = nodes::WorldOf(context.launch());
    if (!world) return world.error();
    if (!context.launch().world().empty()) context.set_world_hash(world.value()->content_hash());
    nodes::FoundBuilt built = nodes::FindBuilt(context.launch().world(), *world.value());
    if (!built.remark.empty()) base::Log(base::LogLevel::kInfo, context.spec().name, built.remark);
    return nodes::ReadWorld{std::move(world).value(), std::move(built.folder)};
  };
  auto render_thread =
      nodes::RenderThread::Open(settings.value(), read, settings.value().drives ? context.KeysSender() : nullptr,
                                settings.value().can_ask ? context.RequestsSender() : nullptr);
  if (!render_thread) return render_thread.error();
  return std::unique_ptr<lockstep::Node>(std::make_unique<ViewNode>(
      context.roster(), context.spec().name, std::move(settings).value(), std::move(render_thread).value()));
}

}  // namespace rodeira::nodes
