// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <string>

#include "common/core/base/bytes.hpp"

namespace rodeira::dds {

// What a writer hands over and a reader gets: a serialised sample with its encapsulation bytes.
struct RawSample {
  base::Bytes bytes;                     // received
  const base::Bytes* to_send = nullptr;  // sent; lives until write() returns
};

// A type of any name with samples that travel as they were serialised: other DDS programs with the real type read them,
// and nothing is serialised twice.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawType(const std::string& type_name);
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override;
};

}  // namespace rodeira::dds
