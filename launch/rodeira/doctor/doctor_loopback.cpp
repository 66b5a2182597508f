// SPDX-License-Identifier: Apache-2.0
// Two processes that talk over DDS, for CheckLoopBack: with both ends in one process Fast DDS would pass the transport
// by.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <memory>
#include <mutex>
#include <random>
#include <thread>

#include "common/runtime/dds/participant.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/doctor/doctor_network.hpp"
#include "launch/rodeira/run/processes.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;
namespace topics = idl::topics;

constexpr int kPoints = 4;  // a car's wheels
constexpr auto kStartPatience = 20s;

const char* TransportName(launch::Transport transport) {
  return transport == launch::Transport::kSharedMemory ? "shared_memory" : "udp";
}

// Payloads move from the listener to the thread that waits for them.
class Queue {
 public:
  void Push(base::Bytes&& bytes) {
    const std::lock_guard lock(mutex_);
    payloads_.push_back(std::move(bytes));
    woken_.notify_one();
  }
  // None where nothing came in time.
  std::optional<base::Bytes> Pop(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    if (!woken_.wait_for(lock, limit, [this] { return !payloads_.empty(); })) return std::nullopt;
    base::Bytes first = std::move(payloads_.front());
    payloads_.pop_front();
    return first;
  }

 private:
  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<base::Bytes> payloads_;
};

// One end: writes on one topic, reads from the other.
struct End {
  Queue queue;  // outlives the reader
  std::unique_ptr<dds::Participant> participant;
  std::unique_ptr<dds::Writer> writer;
  std::unique_ptr<dds::Reader> reader;

  base::Status Open(const dds::DomainSettings& settings, std::string_view out, std::string_view in) {
    auto opened = dds::Participant::Open(settings);
    if (!opened) return opened.error();
    participant = std::move(opened).value();
    auto made_writer = participant->MakeWriter(out, dds::Delivery::kBestEffortRepeated);
    if (!made_writer) return made_writer.error();
    writer = std::move(made_writer).value();
    auto made_reader = participant->MakeReader(in, dds::Delivery::kBestEffortRepeated,
                                               [this](base::Bytes&& bytes) { queue.Push(std::move(bytes)); });
    if (!made_reader) return made_reader.error();
    reader = std::move(made_reader).value();
    return {};
  }
  ~End() {
    reader.reset();
    writer.reset();
  }
};

dds::DomainSettings SettingsOf(const std::string& run, const std::string& name, std::uint32_t domain,
                               launch::Transport transport, std::uint32_t segment_kib) {
  dds::DomainSettings settings;
  settings.run = run;
  settings.name = name;
  settings.domain = domain;
  settings.transport = transport;
  settings.segment_kib = segment_kib;
  return settings;
}

base::Bytes Question(std::uint64_t number) {
  msg::GroundRequest request;
  request.request_number(number);
  request.points().resize(kPoints);
  return idl::Encode(request);
}

// Until the answer with this number is here. The other end may not have met us yet, so the question is said again while
// `again` holds; then once is enough, and saying it twice would hide a loss.
base::Status RequestAnswer(End& end, std::uint64_t number, bool again, const LoopBackSettings& settings) {
  const auto until = WallClock::now() + settings.patience;
  const base::Bytes question = Question(number);
  for (bool first = true; WallClock::now() < until && !settings.cancelled(); first = false) {
    if (first || again) {
      if (auto status = end.writer->Write(question); !status) return status;
    }
    while (const auto payload = end.queue.Pop(20ms)) {
      const auto reply = idl::Decode<msg::GroundReply>(*payload);
      if (!reply)
        return base::Failed("system.no_loopback", "an answer came that cannot be read: " + reply.error().Text());
      if (reply.value().request_number() == number && reply.value().points().size() == kPoints) return {};
    }
  }
  if (settings.cancelled()) return base::Failed("run.interrupted", "stopped by a signal");
  return base::Failed(
      "system.no_loopback",
      fmt::format("question {} of {} between two processes over {} in domain {} was not answered within {:g} s", number,
                  settings.round_trips, TransportName(settings.transport), settings.domain,
                  std::chrono::duration<double>(settings.patience).count()));
}

// Until the partner has said "ready" on its standard output.
base::Status WaitUntilReady(Child& partner, const LoopBackSettings& settings) {
  std::string said;
  const auto until = WallClock::now() + kStartPatience;
  while (WallClock::now() < until && !settings.cancelled()) {
    pollfd waiting{partner.out(), POLLIN, 0};
    char buffer[256];
    if (::poll(&waiting, 1, 20) <= 0) continue;
    const ssize_t size = ::read(partner.out(), buffer, sizeof(buffer));
    if (size > 0) said.append(buffer, static_cast<std::size_t>(size));
    if (said.find("ready\n") != std::string::npos) return {};
    if (size <= 0) break;
  }
  if (settings.cancelled()) return base::Failed("run.interrupted", "stopped by a signal");
  const std::string sentence = said.substr(0, said.find('\n'));
  return base::Failed("system.no_loopback", fmt::format("the second process ({}) did not become ready{}{}",
                                                        settings.program, sentence.empty() ? "" : ": ", sentence));
}

base::Result<LoopBack> Measure(End& end, const LoopBackSettings& settings) {
  if (auto status = RequestAnswer(end, 0, true, settings); !status) return status.error();
  std::vector<double> times_us;
  for (int i = 1; i <= settings.round_trips; ++i) {
    const auto begin = WallClock::now();
    if (auto status = RequestAnswer(end, static_cast<std::uint64_t>(i), false, settings); !status)
      return status.error();
    times_us.push_back(std::chrono::duration<double, std::micro>(WallClock::now() - begin).count());
  }
  std::sort(times_us.begin(), times_us.end());
  return LoopBack{times_us[times_us.size() / 2], times_us[times_us.size() * 99 / 100]};
}

}  // namespace

base::Result<LoopBack> MeasureLoopBack(const LoopBackSettings& settings) {
  RODEIRA_ASSERT(settings.round_trips > 0);
  std::random_device device;
  const std::string run = fmt::format("doctor-{:08x}{:08x}", device(), device());
  const auto before = SharedMemoryFiles();
  base::Result<LoopBack> measured = base::Failed("system.no_loopback", "not measured");
  auto partner = Child::Start(
      "doctor",
      {settings.program, "doctor", "--answer", run, "--domain", std::to_string(settings.domain), "--transport",
       TransportName(settings.transport), "--segment-kib", std::to_string(settings.segment_kib)},
      true);
  if (!partner) return partner.error();
  {
    End end;
    base::Status status = end.Open(SettingsOf(run, "doctor", settings.domain, settings.transport, settings.segment_kib),
                                   topics::kGroundRequest, topics::kGroundReply);
    if (status.ok()) status = WaitUntilReady(partner.value(), settings);
    measured = status.ok() ? Measure(end, settings) : base::Result<LoopBack>(status.error());
  }
  partner.value().CloseInput();
  const auto until = WallClock::now() + 2s;
  for (partner.value().Poll(); !partner.value().ended(); partner.value().Poll()) {
    if (WallClock::now() > until) partner.value().Signal(SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
  RemoveLeftOvers(before);
  return measured;
}

int AnswerLoopBack(const std::string& run, std::uint32_t domain, launch::Transport transport,
                   std::uint32_t segment_kib) {
  ::signal(SIGTERM, SIG_IGN);  // the end of standard input ends it, with nothing left in shared memory
  End end;
  if (auto status = end.Open(SettingsOf(run, "doctor's second process", domain, transport, segment_kib),
                             topics::kGroundReply, topics::kGroundRequest);
      !status) {
    fmt::print("{}\n", status.error().Text());
    return status.error().exit_status();
  }
  fmt::print("ready\n");
  std::fflush(stdout);
  for (;;) {
    if (const auto payload = end.queue.Pop(50ms)) {
      const auto request = idl::Decode<msg::GroundRequest>(*payload);
      if (!request) continue;
      msg::GroundReply reply;
      reply.request_number(request.value().request_number());
      reply.points().resize(request.value().points().size());
      if (!end.writer->Write(idl::Encode(reply))) return 1;
      continue;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char byte = 0;
    if (::poll(&input, 1, 0) > 0 && ::read(STDIN_FILENO, &byte, 1) <= 0) return 0;
  }
}

}  // namespace rodeira::cli
