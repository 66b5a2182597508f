// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/remote_keys.hpp"

#include <utility>

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using launch::LiveKey;

class RemoteKeysSender final : public launch::LiveKeysSender {
 public:
  explicit RemoteKeysSender(std::unique_ptr<Writer> writer) : writer_(std::move(writer)) {}
  void Say(std::vector<LiveKey> keys) override {
    msg::WindowKeys out;
    out.window_id(window_);
    out.number(++number_);
    out.keys().resize(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      out.keys()[i].key(keys[i].key);
      out.keys()[i].pressed(keys[i].held ? 1 : 0);
      out.keys()[i].press_count(keys[i].presses);
    }
    (void)writer_->Write(idl::Encode(out));  // it is said again soon
  }

 private:
  std::unique_ptr<Writer> writer_;
  const std::uint64_t window_ = launch::DrawWindow();
  std::uint64_t number_ = 0;
};

class RemoteKeysReceiver final : public launch::LiveKeysReceiver {
 public:
  base::Status Open(Participant& participant) {
    auto reader = participant.MakeReader(idl::topics::kWindowKeys, Delivery::kBestEffortRepeated,
                                         [this](base::Bytes&& bytes) { Hear(bytes); });
    if (!reader) return reader.error();
    reader_ = std::move(reader).value();
    return {};
  }
  launch::KeysNow Take() override { return memory_.Take(launch::WallSeconds()); }

 private:
  void Hear(const base::Bytes& bytes) {
    const auto in = idl::Decode<msg::WindowKeys>(bytes);
    if (!in) return;
    launch::LiveKeysSaid said{in.value().window_id(), in.value().number(), {}};
    said.keys.reserve(in.value().keys().size());
    for (const msg::KeyState& key : in.value().keys())
      said.keys.push_back({key.key(), key.pressed() != 0, key.press_count()});
    memory_.Hear(said, launch::WallSeconds());
  }

  launch::LiveKeysMemory memory_;
  std::unique_ptr<Reader> reader_;  // last: its callback uses the memory
};

}  // namespace

base::Result<std::unique_ptr<launch::LiveKeysSender>> OpenKeysSender(Participant& participant) {
  auto writer = participant.MakeWriter(idl::topics::kWindowKeys, Delivery::kBestEffortRepeated);
  if (!writer) return writer.error();
  return std::unique_ptr<launch::LiveKeysSender>(std::make_unique<RemoteKeysSender>(std::move(writer).value()));
}

base::Result<std::unique_ptr<launch::LiveKeysReceiver>> OpenKeysReceiver(Participant& participant) {
  auto receiver = std::make_unique<RemoteKeysReceiver>();
  if (auto status = receiver->Open(participant); !status) return status.error();
  return std::unique_ptr<launch::LiveKeysReceiver>(std::move(receiver));
}

}  // namespace rodeira::dds
