// SPDX-License-Identifier: Apache-2.0
#include "nodes/traffic/traffic_requests.hpp"

#include <fmt/format.h>

#include "common/core/base/log.hpp"
#include "common/traffic/traffic_requests.hpp"
#include "idl/codec.hpp"

namespace rodeira::nodes {
namespace {

traffic::TrafficRequest FromMessage(const msg::TrafficRequest& in) {
  return {in.name(),   in.agent(), in.speed_mps(), in.lane(),      in.station_m(),
          in.choice(), in.roads(), in.light(),     in.duration_s()};
}

msg::TrafficAnswer ToMessage(const traffic::TrafficAnswer& answer) {
  msg::TrafficAnswer out;
  out.agent(answer.agent);
  out.lane(answer.lane);
  out.station_m(answer.station_m);
  out.roads(answer.roads);
  if (!answer.refusal) return out;
  out.refused(1);
  out.error_id(std::string(answer.refusal->id.text()));
  out.sentence(answer.refusal->message);
  return out;
}

}  // namespace

base::Status TrafficRequests::Take(const lockstep::Sample& sample, traffic::TrafficModel& model) {
  const auto requests = idl::Decode<msg::TrafficRequests>(*sample.payload);
  if (!requests) return requests.error();
  for (const msg::TrafficRequest& request : requests.value().requests()) {
    answers_.answers().push_back(ToMessage(traffic::Answer(model, FromMessage(request))));
    msg::TrafficAnswer& answer = answers_.answers().back();
    answer.source(sample.source());
    answer.number(request.number());
    if (answer.refused() != 0 && told_.emplace(sample.source(), answer.error_id()).second)
      base::Log(base::LogLevel::kWarning, name_,
                fmt::format("refused at step {}, number {}: {}", sample.valid(), request.number(), answer.sentence()));
  }
  return {};
}

}  // namespace rodeira::nodes
