// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/raw_type.hpp"

#include <cstring>
#include <utility>

#include "common/core/base/recycled_bytes.hpp"

namespace rodeira::dds {

using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

namespace {
constexpr std::uint32_t kFirstPayloadSize = 1024;  // buffers begin with this and grow where a sample is larger
}

RawType::RawType(const std::string& type_name) {
  setName(type_name.c_str());
  m_typeSize = kFirstPayloadSize;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* data, SerializedPayload_t* payload) {
  const base::Bytes& bytes = *static_cast<RawSample*>(data)->to_send;
  if (bytes.size() > payload->max_size) return false;
  std::memcpy(payload->data, bytes.data(), bytes.size());
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool RawType::deserialize(SerializedPayload_t* payload, void* data) {
  const auto* begin = reinterpret_cast<const std::byte*>(payload->data);
  base::Bytes& bytes = static_cast<RawSample*>(data)->bytes;
  if (bytes.capacity() < payload->length) {
    base::RecycleBytes(std::move(bytes));
    bytes = base::TakeBytes(payload->length);
  }
  bytes.assign(begin, begin + payload->length);
  return true;
}

std::function<std::uint32_t()> RawType::getSerializedSizeProvider(void* data) {
  return [data] { return static_cast<std::uint32_t>(static_cast<RawSample*>(data)->to_send->size()); };
}

void* RawType::createData() { return new RawSample; }
void RawType::deleteData(void* data) { delete static_cast<RawSample*>(data); }
bool RawType::getKey(void*, InstanceHandle_t*, bool) { return false; }

}  // namespace rodeira::dds
