// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/remote_requests.hpp"

#include <utility>

#include "common/runtime/launch/live_keys.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

class RemoteRequestsSender final : public launch::LiveRequestsSender {
 public:
  explicit RemoteRequestsSender(std::unique_ptr<Writer> writer) : writer_(std::move(writer)) {}
  void Say(std::vector<launch::LiveRequest> requests) override {
    msg::OperatorRequests out;
    out.client_id(window_);
    out.requests().resize(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      out.requests()[i].number(requests[i].number);
      out.requests()[i].name(requests[i].name);
      out.requests()[i].argument(requests[i].argument);
      out.requests()[i].x_m(requests[i].x_m);
      out.requests()[i].y_m(requests[i].y_m);
      out.requests()[i].value(requests[i].value);
    }
    (void)writer_->Write(idl::Encode(out));  // it is said again soon
  }

 private:
  std::unique_ptr<Writer> writer_;
  const std::uint64_t window_ = launch::DrawWindow();
};

class RemoteRequestsReceiver final : public launch::LiveRequestsReceiver {
 public:
  base::Status Open(Participant& participant) {
    auto reader = participant.MakeReader(idl::topics::kOperatorRequests, Delivery::kBestEffortRepeated,
                                         [this](base::Bytes&& bytes) { Hear(bytes); });
    if (!reader) return reader.error();
    reader_ = std::move(reader).value();
    return {};
  }
  std::vector<launch::LiveRequest> Take() override { return memory_.Take(); }

 private:
  void Hear(const base::Bytes& bytes) {
    const auto in = idl::Decode<msg::OperatorRequests>(bytes);
    if (!in) return;
    launch::LiveRequestsSaid said{in.value().client_id(), {}};
    for (const msg::OperatorRequest& request : in.value().requests()) {
      said.requests.push_back(
          {request.number(), request.name(), request.argument(), request.x_m(), request.y_m(), request.value()});
    }
    memory_.Hear(said);
  }

  launch::LiveRequestsMemory memory_;
  std::unique_ptr<Reader> reader_;  // last: its callback uses the memory
};

}  // namespace

base::Result<std::unique_ptr<launch::LiveRequestsSender>> OpenRequestsSender(Participant& participant) {
  auto writer = participant.MakeWriter(idl::topics::kOperatorRequests, Delivery::kBestEffortRepeated);
  if (!writer) return writer.error();
  return std::unique_ptr<launch::LiveRequestsSender>(std::make_unique<RemoteRequestsSender>(std::move(writer).value()));
}

base::Result<std::unique_ptr<launch::LiveRequestsReceiver>> OpenRequestsReceiver(Participant& participant) {
  auto receiver = std::make_unique<RemoteRequestsReceiver>();
  if (auto status = receiver->Open(participant); !status) return status.error();
  return std::unique_ptr<launch::LiveRequestsReceiver>(std::move(receiver));
}

}  // namespace rodeira::dds
