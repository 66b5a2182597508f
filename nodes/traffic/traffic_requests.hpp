// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>

#include "common/runtime/lockstep/sample.hpp"
#include "common/traffic/traffic_model.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// Requests of nodes that control the traffic, and the answers of one step. What cannot be carried out is answered, and
// ends no run.
class TrafficRequests {
 public:
  // `name`: the node's, for the log.
  explicit TrafficRequests(std::string name) : name_(std::move(name)) {}

  // Before the step's requests.
  void BeginStep() { answers_.answers().clear(); }
  // Carries out the requests of a sample, one after the other.
  base::Status Take(const lockstep::Sample& sample, traffic::TrafficModel& model);
  const msg::TrafficAnswers& answers() const { return answers_; }

 private:
  std::string name_;
  msg::TrafficAnswers answers_;
  std::set<std::pair<lockstep::SourceIndex, std::string>> told_;  // refusals by source and error: each once in the log
};

}  // namespace rodeira::nodes
