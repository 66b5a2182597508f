// SPDX-License-Identifier: Apache-2.0
// rodeira-test-shared-process: as rodeira-nodes, with empty nodes, recorders and a road server without roads. It
// links little, so that it is built under every sanitizer.
#include "common/runtime/dds/run.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "nodes/empty/empty_node.hpp"
#include "nodes/recorder/recorder_node.hpp"

namespace rodeira {
namespace {

class NoRoad final : public launch::Service {
 public:
  base::Digest world_hash() const override { return 1; }
  base::Bytes Announcement() const override {
    msg::WorldInfo info;
    info.content_hash(world_hash());
    info.name("no road");
    return idl::Encode(info);
  }
  base::Result<base::Bytes> Answer(std::span<const std::byte>) override {
    return base::WrongInput("run.wrong_sample", "there is no road");
  }
};

base::Result<dds::SharedProcess::Factory> FactoryIn(const launch::LaunchNode& node) {
  if (node.kind->name == "road") {
    return dds::SharedProcess::Factory{nullptr,
                                       [](launch::NodeContext&) -> base::Result<std::unique_ptr<launch::Service>> {
                                         return std::unique_ptr<launch::Service>(std::make_unique<NoRoad>());
                                       }};
  }
  if (node.kind->name == "empty") return dds::SharedProcess::Factory{nodes::MakeEmptyNode, nullptr};
  return dds::SharedProcess::Factory{nodes::MakeRecorderNode, nullptr};
}

}  // namespace
}  // namespace rodeira

int main(int argc, char** argv) {
  return rodeira::dds::RunSharedProcess("rodeira-test-shared-process", argc, argv, {rodeira::FactoryIn, nullptr});
}
