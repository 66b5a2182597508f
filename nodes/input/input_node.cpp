// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/input_node.hpp"

#include <utility>

#include "common/core/base/files.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/input/autopilot_source.hpp"
#include "nodes/input/joystick_source.hpp"
#include "nodes/input/keyboard_source.hpp"
#include "nodes/input/pad_source.hpp"
#include "nodes/input/parked_source.hpp"
#include "nodes/input/script_source.hpp"
#include "nodes/input/source.hpp"
#include "nodes/messages/controls.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

msg::Controls MessageOf(const dynamics::Controls& controls, const input_devices::Signals& signals) {
  msg::Controls out = ToMessage(controls);
  out.indicators(static_cast<std::uint32_t>(signals.indicators));
  out.headlights(static_cast<std::uint32_t>(signals.headlights));
  out.horn(signals.horn ? 1 : 0);
  return out;
}

input_devices::Signals SignalsOf(const msg::Controls& in) {
  return {static_cast<input_devices::Indicators>(in.indicators() % 4),
          static_cast<input_devices::Headlights>(in.headlights() % 3), in.horn() != 0};
}

class InputNode final : public lockstep::Node {
 public:
  InputNode(std::unique_ptr<Source> source, std::int64_t base_step_ns)
      : source_(std::move(source)), base_step_ns_(base_step_ns) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    const dynamics::Controls first = source_->First();
    outbox.Put(topics::kControls, idl::Encode(MessageOf(first, source_->signals())));
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    const auto controls = source_->Step(step, step.output_valid * base_step_ns_, inbox);
    if (!controls) return controls.error();
    outbox.Put(topics::kControls, idl::Encode(MessageOf(controls.value(), source_->signals())));
    return {};
  }
  base::Status InitialiseFrom(const std::vector<lockstep::Sample>& published) override {
    if (published.empty()) return base::WrongInput("run.cannot_restore", "no published controls were found");
    const auto last = idl::Decode<msg::Controls>(*published.back().payload);
    if (!last) return last.error();
    source_->InitialiseFrom(FromMessage(last.value()), SignalsOf(last.value()));
    return {};
  }
  bool runs_inline() const override { return source_->runs_inline(); }
  void Save(base::StateWriter& out) const override { out.Put("source", *source_); }
  void Restore(base::StateReader& in) override { in.Get("source", *source_); }

 private:
  std::unique_ptr<Source> source_;
  std::int64_t base_step_ns_;
};

base::Result<std::unique_ptr<Source>> MakeScript(const config::Map& config, launch::NodeContext& context) {
  const std::filesystem::path path = config.Path("script");
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  const auto text = base::ReadText(path);
  if (!text) return text.error();
  auto script = Script::Parse(text.value(), path);
  if (!script) return script.error();
  return MakeScriptSource(std::move(script).value());
}

base::Result<std::unique_ptr<Source>> MakePerson(const std::string& device, const config::Map& config,
                                                 launch::NodeContext& context) {
  if (device == "keyboard") return MakeKeyboardSource(config, context);
  if (device == "joystick") return MakeJoystickSource(config, context);
  return MakePadSource(config, context);
}

base::Result<std::unique_ptr<Source>> MakeSource(const config::Map& config, launch::NodeContext& context) {
  const std::string source =
      config.Choice("source", {"script", "autopilot", "keyboard", "joystick", "gamepad", "agent"});
  if (source == "autopilot") return MakeAutopilotSource(config, context);
  if (source == "script") return MakeScript(config, context);
  if (source == "agent")
    return base::WrongInput("node.no_agent",
                            "'source: agent' was found, but no agent drives here; rodeira.Env of the Python package "
                            "starts a run with one");
  auto person = MakePerson(source, config, context);
  if (!person) return person.error();
  return ParkedSource(std::move(person).value());
}

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeInputNode(launch::NodeContext& context) {
  auto source = MakeSource(context.config(), context);
  if (!source) return source.error();
  return InputNodeOf(std::move(source).value(), context.roster().base_step_ns());
}

std::unique_ptr<lockstep::Node> InputNodeOf(std::unique_ptr<Source> source, std::int64_t base_step_ns) {
  return std::make_unique<InputNode>(std::move(source), base_step_ns);
}

}  // namespace rodeira::nodes
