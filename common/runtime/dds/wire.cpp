// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/wire.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <span>

#include "common/core/base/mathematics.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

std::string HostName() {
  char name[256] = {};
  return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

base::Status Compare(std::string_view what, base::Digest own, base::Digest other, std::string_view advice) {
  if (own == other) return {};
  return base::WrongInput(
      fmt::format("its {} is {}, the clock's is {}; {}", what, base::Hex(other), base::Hex(own), advice));
}

}  // namespace

Hello OwnHello(base::Digest roster_hash) {
  Hello hello;
  hello.protocol = idl::ProtocolHash();
  hello.roster = roster_hash;
  hello.mathematics = base::MathematicsDigest();
  hello.host = HostName();
  hello.pid = static_cast<std::uint32_t>(::getpid());
  // For the tests of the refusal: a build of another version and a machine of other mathematics.
  if (const char* pretend = std::getenv("RODEIRA_PRETEND_PROTOCOL")) hello.protocol = base::Hash(pretend);
  if (const char* pretend = std::getenv("RODEIRA_PRETEND_MATHEMATICS")) hello.mathematics = base::Hash(pretend);
  return hello;
}

base::Status CheckHello(const Hello& own, const Hello& other) {
  if (auto status = Compare("protocol hash", own.protocol, other.protocol, "both PCs need the same version of Rodeira");
      !status)
    return status;
  if (auto status =
          Compare("roster hash", own.roster, other.roster, "both need the same launch file and the same --set");
      !status)
    return status;
  if (auto status = Compare("mathematics hash", own.mathematics, other.mathematics,
                            "its mathematics library computes other bits");
      !status)
    return status;
  if (own.world == 0 || other.world == 0) return {};
  return Compare("world hash", own.world, other.world, "both need the same world files");
}

base::Bytes EncodeReport(const NamedReport& in) {
  msg::Report out;
  out.clock_id(in.clock_id);
  out.node(in.node);
  out.hello().protocol_hash(in.hello.protocol);
  out.hello().roster_hash(in.hello.roster);
  out.hello().world_hash(in.hello.world);
  out.hello().mathematics_hash(in.hello.mathematics);
  out.hello().host(in.hello.host);
  out.hello().pid(in.hello.pid);
  const lockstep::Report& report = in.report;
  out.incarnation(report.incarnation);
  out.phase(static_cast<std::uint32_t>(report.phase));
  out.progress_step(report.progress);
  out.waiting(static_cast<std::uint32_t>(report.waiting));
  out.waiting_source(report.waiting_source);
  out.since_ms(report.since_ms);
  out.digest(report.digest);
  out.steps(report.steps);
  out.busy_ns(report.busy_ns);
  out.worst_ns(report.worst_ns);
  out.server_calls(report.server_calls);
  out.median_interval_ns(report.median_interval_ns);
  out.p99_interval_ns(report.p99_interval_ns);
  out.safe_step(report.safe);
  out.granted_step(report.granted);
  out.granted_final(report.granted_final);
  out.cannot_save(report.cannot_save);
  out.message(report.message);
  return idl::Encode(out);
}

base::Result<NamedReport> DecodeReport(const base::Bytes& payload) {
  auto decoded = idl::Decode<msg::Report>(payload);
  if (!decoded) return decoded.error();
  msg::Report& in = decoded.value();
  if (in.phase() > static_cast<std::uint32_t>(lockstep::Phase::kLost) ||
      in.waiting() > static_cast<std::uint32_t>(lockstep::Waiting::kOutput)) {
    return base::WrongInput(fmt::format("a report of phase {} and waiting {} was found", in.phase(), in.waiting()));
  }
  NamedReport out;
  out.node = in.node();
  out.clock_id = in.clock_id();
  out.hello = {in.hello().protocol_hash(),    in.hello().roster_hash(), in.hello().world_hash(),
               in.hello().mathematics_hash(), in.hello().host(),        in.hello().pid()};
  out.report.incarnation = in.incarnation();
  out.report.phase = static_cast<lockstep::Phase>(in.phase());
  out.report.progress = in.progress_step();
  out.report.waiting = static_cast<lockstep::Waiting>(in.waiting());
  out.report.waiting_source = in.waiting_source();
  out.report.since_ms = in.since_ms();
  out.report.digest = in.digest();
  out.report.steps = in.steps();
  out.report.busy_ns = in.busy_ns();
  out.report.worst_ns = in.worst_ns();
  out.report.server_calls = in.server_calls();
  out.report.median_interval_ns = in.median_interval_ns();
  out.report.p99_interval_ns = in.p99_interval_ns();
  out.report.safe = in.safe_step();
  out.report.granted = in.granted_step();
  out.report.granted_final = in.granted_final();
  out.report.cannot_save = in.cannot_save();
  out.report.message = in.message();
  return out;
}

base::Bytes EncodeGrant(const NumberedGrant& in) {
  msg::Grant out;
  out.clock_id(in.clock_id);
  out.serial(in.serial);
  out.roster_hash(in.grant.roster);
  out.through_step(in.grant.through);
  out.final_step(in.grant.final);
  out.abort(in.grant.abort);
  out.over(in.grant.over);
  out.safe_step(in.grant.safe);
  out.resume_step(in.grant.resume);
  out.lives(in.grant.lives);
  out.reason(in.grant.reason);
  return idl::Encode(out);
}

base::Result<NumberedGrant> DecodeGrant(const base::Bytes& payload) {
  auto decoded = idl::Decode<msg::Grant>(payload);
  if (!decoded) return decoded.error();
  msg::Grant& in = decoded.value();
  NumberedGrant out;
  out.clock_id = in.clock_id();
  out.serial = in.serial();
  out.grant.roster = in.roster_hash();
  out.grant.through = in.through_step();
  out.grant.final = in.final_step();
  out.grant.abort = in.abort();
  out.grant.over = in.over();
  out.grant.safe = in.safe_step();
  out.grant.resume = in.resume_step();
  out.grant.lives = in.lives();
  out.grant.reason = in.reason();
  return out;
}

base::Bytes EncodeAsk(base::Digest roster_hash, const lockstep::Question& question) {
  msg::Ask out;
  out.roster_hash(roster_hash);
  out.from_step(question.gap.from);
  out.source(question.gap.source);
  out.asker(question.asker);
  return idl::Encode(out);
}

std::optional<lockstep::Question> DecodeAsk(base::Digest roster_hash, const base::Bytes& payload) {
  const auto in = idl::Decode<msg::Ask>(payload);
  if (!in || in.value().roster_hash() != roster_hash) return std::nullopt;
  return lockstep::Question{in.value().asker(), {in.value().source(), in.value().from_step()}};
}

base::Bytes EncodeParcel(lockstep::NodeIndex to, std::span<const lockstep::Sample> samples) {
  std::size_t size = 0;
  for (const lockstep::Sample& sample : samples) size += sizeof(std::uint32_t) + sample.payload->size();
  msg::Parcel out;
  out.to(to);
  auto& bytes = out.samples();
  bytes.resize(size);
  std::uint8_t* at = bytes.data();
  for (const lockstep::Sample& sample : samples) {
    const auto length = static_cast<std::uint32_t>(sample.payload->size());
    std::memcpy(at, &length, sizeof(length));
    std::memcpy(at + sizeof(length), sample.payload->data(), length);
    at += sizeof(length) + length;
  }
  return idl::Encode(out);
}

base::Result<Opened> DecodeParcel(const base::Bytes& payload) {
  const auto in = idl::Decode<msg::Parcel>(payload);
  if (!in) return in.error();
  const auto all = std::as_bytes(std::span(in.value().samples()));
  Opened opened{in.value().to(), {}};
  for (std::size_t at = 0; at < all.size();) {
    std::uint32_t length = 0;
    if (all.size() - at < sizeof(length))
      return base::WrongInput(fmt::format("a parcel of {} bytes ends within a length", all.size()));
    std::memcpy(&length, all.data() + at, sizeof(length));
    at += sizeof(length);
    if (length > all.size() - at)
      return base::WrongInput(
          fmt::format("a parcel of {} bytes has {} left for a sample of {}", all.size(), all.size() - at, length));
    opened.samples.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                                all.begin() + static_cast<std::ptrdiff_t>(at + length));
    at += length;
  }
  return opened;
}

}  // namespace rodeira::dds
