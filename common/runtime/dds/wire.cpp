// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/wire.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "common/core/base/assert.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/recycled_bytes.hpp"
#include "common/data/decode/type_text.hpp"
#include "common/runtime/dds/hello_change.hpp"
#include "common/runtime/launch/agreement.hpp"
#include "common/runtime/launch/used_topics.hpp"
#include "idl/codec.hpp"
#include "idl/idl_source.hpp"
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
  return base::WrongInput("dds.node_refused", fmt::format("its {} is {}, the clock's is {}; {}", what, base::Hex(other),
                                                          base::Hex(own), advice));
}

// What an external node's program was compiled with counts, not what its manifest names today.
void UseCompiledTypes(const idl::TopicTable& table, std::vector<idl::TopicText>& topics) {
  for (idl::TopicText& text : topics) {
    if (table.FindAdded(text.topic) == nullptr) continue;
    if (const decode::TypePtr compiled = idl::CompiledType(text.type)) text.idl = decode::CanonicalIdl(*compiled);
  }
}

const idl::TopicText* FindText(const std::vector<idl::TopicText>& topics, std::string_view topic) {
  const auto found = std::ranges::find(topics, topic, &idl::TopicText::topic);
  return found == topics.end() ? nullptr : &*found;
}

// Why two protocol hashes differ.
std::string ProtocolDifference(const Hello& own, const Hello& other) {
  constexpr std::string_view kAdvice = "all programs of a run need the same version of Rodeira";
  constexpr std::string_view kBuildAgain = "build its program again, from the IDL that its manifest names";
  if (other.topics != nullptr && own.topics != nullptr) {
    for (const idl::TopicText& text : *other.topics) {
      const idl::TopicText* expected = FindText(*own.topics, text.topic);
      if (expected == nullptr)
        return fmt::format("it uses topic {}, which the clock does not expect of it; {}", text.topic, kAdvice);
      const bool is_added = idl::FindTopic(text.topic) == nullptr;
      const idl::OtherType found{text.idl, text.type};
      const auto difference = is_added ? idl::DifferenceBetween(found, {expected->idl, expected->type})
                                       : idl::TypeDifference(text.topic, found);
      if (!difference) continue;
      return fmt::format("its type of topic {} differs from the clock's: {}; {}", text.topic, *difference,
                         is_added ? kBuildAgain : kAdvice);
    }
    for (const idl::TopicText& text : *own.topics) {
      if (FindText(*other.topics, text.topic) == nullptr)
        return fmt::format("it does not use topic {}, which the clock expects of it; {}", text.topic, kAdvice);
    }
  }
  return fmt::format("its protocol hash is {}, the clock's is {}; {}", base::Hex(other.protocol),
                     base::Hex(own.protocol), kAdvice);
}

base::Digest ReportHash() {
  static const base::Digest kHash = idl::TypeHash(idl::topics::kReport);
  return kHash;
}
base::Digest GrantHash() {
  static const base::Digest kHash = idl::TypeHash(idl::topics::kGrant);
  return kHash;
}
base::Error Unreadable(const base::Error& error) {
  return base::WrongInput("dds.wrong_message",
                          "a report cannot be read; is a node of another version?: " + error.Text());
}
// The first member of grants and reports: the hash of their type.
base::Digest FirstMember(const base::Bytes& payload) {
  base::ByteReader in(payload);
  (void)in.GetRaw(4);
  return in.Get<base::Digest>();
}

}  // namespace

HelloChange& ChangeOfHellos() {
  static HelloChange change;
  return change;
}

Hello OwnHello(const launch::Launch& launch, lockstep::NodeIndex node) {
  std::vector<idl::TopicText> topics = launch.topics().TextsOf(launch::UsedTopics(launch, node));
  UseCompiledTypes(launch.topics(), topics);
  const HelloChange& change = ChangeOfHellos();
  if (change.type) change.type(topics);
  Hello hello;
  hello.report = base::Hash(FindText(topics, idl::topics::kReport)->idl);
  hello.protocol = idl::ProtocolHash(topics);
  hello.roster = launch::Agreement(launch);
  hello.mathematics = base::MathLibraryFingerprint();
  hello.host = HostName();
  hello.pid = static_cast<std::uint32_t>(::getpid());
  hello.topics = std::make_shared<const std::vector<idl::TopicText>>(std::move(topics));
  if (change.mathematics != 0) hello.mathematics = change.mathematics;
  return hello;
}

base::Status CheckHello(const Hello& own, const Hello& other) {
  if (own.protocol != other.protocol) return base::WrongInput("dds.node_refused", ProtocolDifference(own, other));
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
  out.identity().report_hash(in.hello.report);
  out.identity().node(in.node);
  out.identity().host(in.hello.host);
  out.identity().pid(in.hello.pid);
  out.hello().protocol_hash(in.hello.protocol);
  out.hello().roster_hash(in.hello.roster);
  out.hello().world_hash(in.hello.world);
  out.hello().math_library_hash(in.hello.mathematics);
  if (in.hello.topics != nullptr) {
    for (const idl::TopicText& text : *in.hello.topics) {
      msg::TopicType& topic = out.hello().topics().emplace_back();
      topic.topic(text.topic);
      topic.type(text.type);
      topic.idl(text.idl);
    }
  }
  out.clock_id(in.clock_id);
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
  out.recorded_step(report.safe);
  out.granted_step(report.granted);
  out.granted_final(report.granted_final);
  out.cannot_save(report.cannot_save);
  out.message(report.message);
  return idl::Encode(out);
}

base::Result<NamedReport> DecodeReport(const base::Bytes& payload) {
  if (payload.size() >= 12 && FirstMember(payload) != ReportHash()) {
    const auto identity = idl::Decode<msg::NodeIdentity>(payload);
    if (!identity) return Unreadable(identity.error());
    const msg::NodeIdentity& node = identity.value();
    return base::WrongInput("dds.node_refused",
                            fmt::format("node '{}' (process {} on host {}) was refused: its type of topic {} differs "
                                        "from the clock's: its hash is {}, "
                                        "the clock's is {}; all programs of a run need the same version of Rodeira",
                                        node.node(), node.pid(), node.host(), idl::topics::kReport,
                                        base::Hex(node.report_hash()), base::Hex(ReportHash())));
  }
  auto decoded = idl::Decode<msg::Report>(payload);
  if (!decoded) return Unreadable(decoded.error());
  msg::Report& in = decoded.value();
  if (in.phase() > static_cast<std::uint32_t>(lockstep::Phase::kAborted) ||
      in.waiting() > static_cast<std::uint32_t>(lockstep::Waiting::kOutput)) {
    return base::WrongInput("dds.wrong_message",
                            fmt::format("a report of phase {} and waiting {} was found", in.phase(), in.waiting()));
  }
  NamedReport out;
  out.node = in.identity().node();
  out.clock_id = in.clock_id();
  out.hello.report = in.identity().report_hash();
  out.hello.protocol = in.hello().protocol_hash();
  out.hello.roster = in.hello().roster_hash();
  out.hello.world = in.hello().world_hash();
  out.hello.mathematics = in.hello().math_library_hash();
  out.hello.host = in.identity().host();
  out.hello.pid = in.identity().pid();
  if (!in.hello().topics().empty()) {
    std::vector<idl::TopicText> topics;
    for (const msg::TopicType& topic : in.hello().topics())
      topics.push_back({topic.topic(), topic.type(), topic.idl()});
    out.hello.topics = std::make_shared<const std::vector<idl::TopicText>>(std::move(topics));
  }
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
  out.report.safe = in.recorded_step();
  out.report.granted = in.granted_step();
  out.report.granted_final = in.granted_final();
  out.report.cannot_save = in.cannot_save();
  out.report.message = in.message();
  return out;
}

base::Bytes EncodeGrant(const NumberedGrant& in) {
  msg::Grant out;
  out.grant_hash(GrantHash());
  out.clock_id(in.clock_id);
  out.serial(in.serial);
  out.roster_hash(in.grant.roster);
  out.through_step(in.grant.through);
  out.final_step(in.grant.final);
  out.abort(in.grant.abort);
  out.finished(in.grant.over);
  out.recorded_step(in.grant.safe);
  out.resume_step(in.grant.resume);
  out.incarnations(in.grant.incarnations);
  out.reason(in.grant.reason);
  return idl::Encode(out);
}

base::Result<NumberedGrant> DecodeGrant(const base::Bytes& payload) {
  if (payload.size() >= 12 && FirstMember(payload) != GrantHash())
    return base::WrongInput("dds.wrong_message", "a grant of another version was found");
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
  out.grant.over = in.finished();
  out.grant.safe = in.recorded_step();
  out.grant.resume = in.resume_step();
  out.grant.incarnations = in.incarnations();
  out.grant.reason = in.reason();
  return out;
}

base::Bytes EncodeNack(base::Digest roster_hash, const lockstep::Nack& nack) {
  msg::Nack out;
  out.roster_hash(roster_hash);
  out.from_step(nack.gap.from);
  out.source(nack.gap.source);
  out.requester(nack.requester);
  return idl::Encode(out);
}

std::optional<lockstep::Nack> DecodeNack(base::Digest roster_hash, const base::Bytes& payload) {
  const auto in = idl::Decode<msg::Nack>(payload);
  if (!in || in.value().roster_hash() != roster_hash) return std::nullopt;
  return lockstep::Nack{in.value().requester(), {in.value().source(), in.value().from_step()}};
}

base::Bytes EncodeSampleBatch(lockstep::NodeIndex to, std::span<const lockstep::Sample> samples) {
  std::size_t size = 0;
  for (const lockstep::Sample& sample : samples) size += sizeof(std::uint32_t) + sample.payload->size();
  msg::SampleBatch out;
  out.consumer(to);
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

base::Result<Opened> DecodeSampleBatch(const base::Bytes& payload) {
  const auto in = idl::Decode<msg::SampleBatch>(payload);
  if (!in) return in.error();
  const auto all = std::as_bytes(std::span(in.value().samples()));
  Opened opened{in.value().consumer(), {}};
  for (std::size_t at = 0; at < all.size();) {
    std::uint32_t length = 0;
    if (all.size() - at < sizeof(length))
      return base::WrongInput("dds.wrong_message", fmt::format("a batch of {} bytes ends within a length", all.size()));
    std::memcpy(&length, all.data() + at, sizeof(length));
    at += sizeof(length);
    if (length > all.size() - at)
      return base::WrongInput("dds.wrong_message", fmt::format("a batch of {} bytes has {} left for a sample of {}",
                                                               all.size(), all.size() - at, length));
    base::Bytes& sample = opened.samples.emplace_back(base::TakeBytes(length));
    const std::span<const std::byte> content = all.subspan(at, length);
    sample.assign(content.begin(), content.end());
    at += length;
  }
  return opened;
}

}  // namespace rodeira::dds
