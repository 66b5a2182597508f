// SPDX-License-Identifier: Apache-2.0
// A sink: counts the samples of lab/gaze and prints the farthest glance when the run ends.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/runtime/dds/external_node.hpp"
#include "gaze.h"
#include "idl/codec.hpp"

namespace {

using namespace rodeira;

class GazeMonitor final : public lockstep::Node {
 public:
  base::Status Initialise(lockstep::Outbox&) override { return {}; }
  base::Status Step(const lockstep::StepInfo&, const lockstep::Inbox& inbox, lockstep::Outbox&) override {
    return Take(inbox);
  }
  // The samples after the last activation.
  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step, bool complete) override {
    if (auto status = Take(rest); !status) return status;
    if (complete) std::printf("gaze_monitor: %d samples, farthest glance %.2f m\n", samples_, farthest_m_);
    return {};
  }
  // Nothing: a sink that is started again begins anew.
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  base::Status Take(const lockstep::Inbox& inbox) {
    for (const lockstep::Sample& sample : inbox.All("lab/gaze")) {
      const auto gaze = idl::Decode<lab::Gaze>(*sample.payload);
      if (!gaze) return gaze.error();
      ++samples_;
      farthest_m_ = std::max(farthest_m_, gaze.value().distance_m());
    }
    return {};
  }
  int samples_ = 0;
  double farthest_m_ = 0.0;
};

base::Result<std::unique_ptr<lockstep::Node>> MakeGazeMonitor(launch::NodeContext&) {
  return std::unique_ptr<lockstep::Node>(std::make_unique<GazeMonitor>());
}

}  // namespace

RODEIRA_NODE(MakeGazeMonitor);
