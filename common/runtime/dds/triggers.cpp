// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/triggers.hpp"

#include <utility>

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {

Triggers::Triggers(std::unique_ptr<Writer> writer, std::string run, std::int64_t base_step_ns)
    : writer_(std::move(writer)), run_(std::move(run)), base_step_ns_(base_step_ns) {}

base::Result<Triggers> Triggers::Open(Participant& participant, std::string run, std::int64_t base_step_ns) {
  auto writer = participant.MakeWriter(idl::topics::kTrigger, Delivery::kHistory);
  if (!writer) return writer.error();
  return Triggers(std::move(writer).value(), std::move(run), base_step_ns);
}

void Triggers::Say(const lockstep::Remark& remark) {
  if (remark.kind == lockstep::RemarkKind::kStart) Write(1, remark.step, remark.utc_ns, remark.text);
  if (remark.kind == lockstep::RemarkKind::kMark) Write(3, remark.step, remark.utc_ns, remark.text);
}

void Triggers::SayEnd(lockstep::Step step, std::int64_t utc_ns, const std::string& how) { Write(2, step, utc_ns, how); }

void Triggers::Write(std::uint32_t code, lockstep::Step step, std::int64_t utc_ns, const std::string& text) {
  msg::Trigger out;
  out.number(++number_);
  out.step(step);
  out.time_ns(step * base_step_ns_);
  out.utc_ns(utc_ns);
  out.code(code);
  out.run(run_);
  out.text(text);
  (void)writer_->Write(idl::Encode(out));  // no node of the run depends on it
}

}  // namespace rodeira::dds
