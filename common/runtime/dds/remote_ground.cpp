// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/remote_ground.hpp"

#include <chrono>
#include <utility>

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {

namespace topics = idl::topics;

RemoteGround::RemoteGround(lockstep::NodeIndex requester, std::uint32_t incarnation, std::function<bool()> over)
    : requester_(requester), incarnation_(incarnation), over_(std::move(over)) {}

base::Result<std::unique_ptr<RemoteGround>> RemoteGround::Open(Participant& participant, lockstep::NodeIndex requester,
                                                               std::uint32_t incarnation, std::function<bool()> over) {
  std::unique_ptr<RemoteGround> ground(new RemoteGround(requester, incarnation, std::move(over)));
  auto requests = participant.MakeWriter(topics::kGroundRequest, Delivery::kBestEffortRepeated);
  if (!requests) return requests.error();
  ground->requests_ = std::move(requests).value();
  auto replies = participant.MakeReader(topics::kGroundReply, Delivery::kBestEffortRepeated,
                                        [raw = ground.get()](base::Bytes&& bytes) { raw->OnReply(std::move(bytes)); });
  if (!replies) return replies.error();
  ground->replies_ = std::move(replies).value();
  return ground;
}

void RemoteGround::Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) {
  RODEIRA_ASSERT(queries.size() == points.size());
  msg::GroundRequest request;
  request.requester(requester_);
  request.incarnation(incarnation_);
  request.points().resize(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    request.points()[i].x_m(queries[i].x_m);
    request.points()[i].y_m(queries[i].y_m);
    request.points()[i].z_hint_m(queries[i].z_hint_m);
  }
  if (runner_ != nullptr) runner_->BeginServerCall();
  std::unique_lock lock(mutex_);
  request.request_number(++number_);
  answered_ = false;
  points_ = points;
  const base::Bytes payload = idl::Encode(request);
  // Until an answer to this very request has come: request or answer may be lost, or the server has not met us yet.
  // The same request again does no harm, SUELO is a function.
  auto patience = std::chrono::milliseconds(5);
  while (!answered_) {
    lock.unlock();
    (void)requests_->Write(payload);
    lock.lock();
    if (woken_.wait_for(lock, patience, [this] { return answered_; })) break;
    if (over_()) {
      for (ground::GroundPoint& point : points) point = {};
      answered_ = true;
    }
    patience = std::min(2 * patience, std::chrono::milliseconds(100));
  }
  points_ = {};
  lock.unlock();
  if (runner_ != nullptr) runner_->EndServerCall();
}

void RemoteGround::OnReply(base::Bytes&& payload) {
  // Replies go to all clients; the one that is meant stands in the first eight bytes behind the encapsulation.
  base::ByteReader head(payload);
  (void)head.GetRaw(4);
  if (head.Get<std::uint32_t>() != requester_ || head.Get<std::uint32_t>() != incarnation_) return;
  const auto reply = idl::Decode<msg::GroundReply>(payload);
  if (!reply) return;
  const std::lock_guard lock(mutex_);
  const auto& answers = reply.value().points();
  if (answered_ || reply.value().request_number() != number_ || answers.size() != points_.size()) return;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto& answer = answers[i];
    points_[i] = {answer.z_m(),
                  {answer.normal_x(), answer.normal_y(), answer.normal_z()},
                  answer.friction(),
                  static_cast<ground::Surface>(answer.surface()),
                  answer.inside_world() != 0};
  }
  answered_ = true;
  woken_.notify_all();
}

}  // namespace rodeira::dds
