// SPDX-License-Identifier: Apache-2.0
// A road server that hangs in its request number HANG_AT_REQUEST.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <utility>

#include "common/runtime/dds/run.hpp"
#include "nodes/road/road_service.hpp"

namespace {

using rodeira::base::Bytes;
using rodeira::base::Result;
using rodeira::launch::Service;

class HangingRoad final : public Service {
 public:
  HangingRoad(std::unique_ptr<Service> road, long hang_at) : road_(std::move(road)), hang_at_(hang_at) {}
  rodeira::base::Digest world_hash() const override { return road_->world_hash(); }
  Bytes Announcement() const override { return road_->Announcement(); }
  Result<Bytes> Answer(std::span<const std::byte> request) override {
    if (++requests_ == hang_at_) {
      for (;;) ::pause();
    }
    return road_->Answer(request);
  }

 private:
  std::unique_ptr<Service> road_;
  long hang_at_;
  std::atomic<long> requests_ = 0;
};

Result<std::unique_ptr<Service>> Make(rodeira::launch::NodeContext& context) {
  auto road = rodeira::nodes::MakeRoadService(context);
  const char* hang_at = std::getenv("HANG_AT_REQUEST");
  if (!road || hang_at == nullptr) return road;
  return std::unique_ptr<Service>(std::make_unique<HangingRoad>(std::move(road).value(), std::atol(hang_at)));
}

}  // namespace

int main(int argc, char** argv) { return rodeira::dds::RunService("road", argc, argv, Make); }
