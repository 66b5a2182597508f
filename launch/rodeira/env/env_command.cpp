// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/env/env_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "common/core/base/bytes.hpp"
#include "common/core/base/crash_trace.hpp"
#include "common/core/base/hash.hpp"
#include "common/core/base/print_error.hpp"
#include "launch/rodeira/env/agent_run.hpp"

namespace rodeira::cli {
namespace {

constexpr std::uint32_t kMaxRequest_bytes = 1U << 20;

// False at the end of the stream.
bool ReadAll(int fd, std::span<std::byte> into) {
  while (!into.empty()) {
    const ssize_t got = ::read(fd, into.data(), into.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    into = into.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool WriteAll(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(fd, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return true;
}

struct Message {
  char kind = '\0';
  base::Bytes content;
};

// The pipes to and from the process that has started this one.
class Pipes {
 public:
  // What else would be written to standard output goes to standard error from now on.
  Pipes() : in_(STDIN_FILENO), out_(::dup(STDOUT_FILENO)) { ::dup2(STDERR_FILENO, STDOUT_FILENO); }
  ~Pipes() { ::close(out_); }
  Pipes(const Pipes&) = delete;
  Pipes& operator=(const Pipes&) = delete;

  // Nothing where the other side has closed, or where what it says is no request.
  std::optional<Message> Next() const {
    std::uint32_t size = 0;
    Message message;
    if (!ReadAll(in_, std::as_writable_bytes(std::span(&size, 1))) || size == 0 || size > kMaxRequest_bytes)
      return std::nullopt;
    message.content.resize(size - 1);
    if (!ReadAll(in_, std::as_writable_bytes(std::span(&message.kind, 1))) || !ReadAll(in_, message.content))
      return std::nullopt;
    return message;
  }
  bool Send(char kind, std::span<const std::byte> content) const {
    base::ByteWriter out;
    out.Put(static_cast<std::uint32_t>(content.size() + 1));
    out.Put(kind);
    out.PutRaw(content);
    return WriteAll(out_, out.bytes());
  }
  bool Send(const base::Error& error) const {
    base::ByteWriter out;
    out.Put(static_cast<std::uint32_t>(error.exit_status()));
    out.PutString(error.id.text());
    out.PutString(error.Text());
    return Send('E', out.bytes());
  }

 private:
  int in_;
  int out_;
};

base::Bytes HelloOf(const AgentRun& run) {
  const launch::Launch& launch = run.launch();
  const auto& roster = launch.roster();
  base::ByteWriter out;
  out.PutString(launch.path().string());
  out.Put(roster.base_step_ns());
  out.Put(roster.node(run.agent()).period);
  out.Put(launch.seed());
  out.Put(launch.duration_s().value_or(0.0));
  base::ByteWriter sources;
  std::uint32_t count = 0;
  for (std::uint32_t s = 0; s < roster.sources().size(); ++s) {
    const lockstep::Source& source = roster.source(s);
    if (roster.node(source.node).snapshots == s) continue;
    const auto schema = launch.topics().SchemaOf(source.topic);
    RODEIRA_ASSERT(schema.has_value());
    ++count;
    sources.Put(s);
    sources.PutString(roster.node(source.node).name);
    sources.PutString(source.topic);
    sources.PutString(schema->type);
    sources.PutString(schema->idl);
  }
  out.Put(count);
  out.PutRaw(sources.bytes());
  return out.bytes();
}

base::Bytes ObservationOf(const AgentRun& run) {
  const auto samples = run.Observation();
  base::ByteWriter out;
  out.Put(run.step());
  out.Put(static_cast<std::uint32_t>(samples.size()));
  for (const lockstep::Sample& sample : samples) {
    out.Put(sample.source());
    out.Put(static_cast<std::uint32_t>(sample.payload->size()));
    out.PutRaw(*sample.payload);
  }
  return out.bytes();
}

base::Error BadRequest(char kind) {
  return base::WrongInput("message.wrong_env_request",
                          fmt::format("a request '{}' of another form was found; another version of the Python "
                                      "package may have sent it",
                                      kind));
}

base::Result<nodes::AgentControls> ControlsIn(const Message& message) {
  base::ByteReader in(message.content);
  nodes::AgentControls out;
  out.controls.steering_wheel_rad = in.Get<double>();
  out.controls.throttle = in.Get<double>();
  out.controls.brake = in.Get<double>();
  out.controls.clutch = in.Get<double>();
  out.controls.handbrake = in.Get<double>();
  out.controls.gear = in.Get<std::int32_t>();
  out.controls.gearbox =
      in.Get<std::uint32_t>() == 0 ? dynamics::GearboxMode::kAutomatic : dynamics::GearboxMode::kManual;
  out.controls.starter = in.Get<std::uint32_t>() != 0;
  out.signals.indicators = static_cast<input_devices::Indicators>(in.Get<std::uint32_t>() % 4);
  out.signals.headlights = static_cast<input_devices::Headlights>(in.Get<std::uint32_t>() % 3);
  out.signals.horn = in.Get<std::uint32_t>() != 0;
  if (!in.ok() || in.remaining() != 0) return BadRequest(message.kind);
  return out;
}

base::Status Reset(AgentRun& run, const Message& message) {
  base::ByteReader in(message.content);
  const bool has_seed = in.Get<std::uint8_t>() != 0;
  const auto seed = in.Get<std::uint64_t>();
  const std::string record = in.GetString();
  if (!in.ok() || in.remaining() != 0) return BadRequest(message.kind);
  return run.Reset(has_seed ? std::optional(seed) : std::nullopt, record);
}

base::Status Act(AgentRun& run, const Message& message) {
  const auto controls = ControlsIn(message);
  if (!controls) return controls.error();
  return run.Advance(controls.value());
}

// False where the other side has gone.
bool Answer(AgentRun& run, const Pipes& pipes, const Message& message) {
  const bool begins = message.kind == 'R';
  if (!begins && !run.has_episode())
    return pipes.Send(base::WrongInput("run.no_episode", "there is no episode; a reset was expected first"));
  if (begins || message.kind == 'A') {
    const base::Status status = begins ? Reset(run, message) : Act(run, message);
    return status.ok() ? pipes.Send('O', ObservationOf(run)) : pipes.Send(status.error());
  }
  if (message.kind == 'D') {
    const std::string digest = base::Hex(run.digest());
    return pipes.Send('D', std::as_bytes(std::span(digest)));
  }
  if (message.kind != 'F') return pipes.Send(BadRequest(message.kind));
  const base::Status status = run.Finish();
  return status.ok() ? pipes.Send('F', {}) : pipes.Send(status.error());
}

}  // namespace

int Env(const EnvOptions& options) {
  base::TraceCrashes("rodeira: the crash ends this environment; 'rodeira repair' completes its recording\n");
  std::signal(SIGPIPE, SIG_IGN);
  const Pipes pipes;
  auto run = AgentRun::Make(options.launch_file, options.overrides, options.agent);
  if (!run) {
    static_cast<void>(pipes.Send(run.error()));
    return run.error().exit_status();
  }
  bool connected = pipes.Send('H', HelloOf(*run.value()));
  while (connected) {
    const auto message = pipes.Next();
    connected = message && Answer(*run.value(), pipes, *message);
  }
  if (!run.value()->has_episode()) return 0;
  const base::Status finished = run.value()->Finish();
  return finished.ok() ? 0 : base::PrintError("rodeira", finished.error());
}

}  // namespace rodeira::cli
