// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace rodeira::decode {
namespace {

constexpr std::size_t kEncapsulation = 4;
constexpr std::size_t kTransportPadding = 3;

class Walker {
 public:
  Walker(std::span<const std::byte> bytes, bool big_endian, Visitor& visitor)
      : bytes_(bytes), big_endian_(big_endian), visitor_(visitor) {}

  base::Status Run(const Type& type) {
    if (!Visit(type)) return *error_;
    const std::size_t left = bytes_.size() - at_;
    if (left > kTransportPadding) return Fault(fmt::format("{} bytes are left behind the last value", left));
    return {};
  }

 private:
  // False where the walk has come to its end before the message's; error_ says why.
  bool Visit(const Type& type) {
    if (!Holds(type.least_bytes)) return false;
    switch (type.kind) {
      case Kind::kStruct:
        for (const Member& member : type.members) {
          path_.push_back({&member.name, 0});
          if (!Visit(*member.type)) return false;
          path_.pop_back();
        }
        return true;
      case Kind::kArray:
        return Elements(*type.element, type.length);
      case Kind::kSequence:
        return Sequence(type);
      case Kind::kString:
        return String(type);
      default:
        return Plain(type.kind);
    }
  }

  bool Sequence(const Type& type) {
    std::uint32_t length = 0;
    if (!Get(length)) return false;
    if (type.bound != 0 && length > type.bound) {
      return Refuse(fmt::format("a sequence of {} elements was found, at most {} were expected", length, type.bound));
    }
    if (length > (bytes_.size() - at_) / type.element->least_bytes) {
      return Refuse(
          fmt::format("a sequence of {} elements was found, but only {} bytes are left", length, bytes_.size() - at_));
    }
    if (type.element->kind == Kind::kOctet) return Elements(*type.element, length);
    visitor_.OnSequence(path_, length);
    if (!Elements(*type.element, length)) return false;
    visitor_.OnSequenceEnd(path_);
    return true;
  }

  bool Elements(const Type& element, std::uint64_t length) {
    if (element.kind == Kind::kOctet) {
      if (!Holds(length)) return false;
      const auto from = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
      at_ += static_cast<std::size_t>(length);
      visitor_.OnValue(path_, base::Bytes(from, bytes_.begin() + static_cast<std::ptrdiff_t>(at_)));
      return true;
    }
    for (std::uint64_t i = 0; i < length; ++i) {
      path_.push_back({nullptr, i});
      if (!Visit(element)) return false;
      path_.pop_back();
    }
    return true;
  }

  // The length counts a terminating zero. As Fast-CDR reads: without one all bytes are text, and a length of 0 is no
  // text.
  bool String(const Type& type) {
    std::uint32_t length = 0;
    if (!Get(length) || !Holds(length)) return false;
    std::string text(reinterpret_cast<const char*>(bytes_.data()) + at_, length);
    at_ += length;
    if (!text.empty() && text.back() == '\0') text.pop_back();
    if (type.bound != 0 && text.size() > type.bound) {
      return Refuse(fmt::format("a text of {} bytes was found, at most {} were expected", text.size(), type.bound));
    }
    visitor_.OnValue(path_, std::move(text));
    return true;
  }

  bool Plain(Kind kind) {
    switch (kind) {
      case Kind::kBool: {
        std::uint8_t value = 0;
        if (!Get(value)) return false;
        if (value > 1) return Refuse(fmt::format("a boolean of {} was found, 0 or 1 was expected", value));
        visitor_.OnValue(path_, value == 1);
        return true;
      }
      case Kind::kChar:
      case Kind::kOctet:
      case Kind::kUint8:
        return Number<std::uint8_t, std::uint64_t>();
      case Kind::kInt8:
        return Number<std::int8_t, std::int64_t>();
      case Kind::kInt16:
        return Number<std::int16_t, std::int64_t>();
      case Kind::kUint16:
        return Number<std::uint16_t, std::uint64_t>();
      case Kind::kInt32:
        return Number<std::int32_t, std::int64_t>();
      case Kind::kEnum:
      case Kind::kUint32:
        return Number<std::uint32_t, std::uint64_t>();
      case Kind::kInt64:
        return Number<std::int64_t, std::int64_t>();
      case Kind::kUint64:
        return Number<std::uint64_t, std::uint64_t>();
      case Kind::kFloat:
        return Number<float, float>();
      case Kind::kDouble:
        return Number<double, double>();
      default:
        break;
    }
    RODEIRA_ASSERT(false);
    return false;
  }

  template <class Wire, class Wide>
  bool Number() {
    Wire value{};
    if (!Get(value)) return false;
    visitor_.OnValue(path_, static_cast<Wide>(value));
    return true;
  }

  // A number lies on a multiple of its size, counted from behind the encapsulation.
  template <class T>
  bool Get(T& value) {
    const std::size_t padding = (sizeof(T) - at_ % sizeof(T)) % sizeof(T);
    if (!Holds(padding + sizeof(T))) return false;
    at_ += padding;
    std::byte raw[sizeof(T)];
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), sizeof(T), raw);
    if (big_endian_) std::reverse(raw, raw + sizeof(T));
    std::memcpy(&value, raw, sizeof(T));
    at_ += sizeof(T);
    return true;
  }

  bool Holds(std::uint64_t size) {
    if (size <= bytes_.size() - at_) return true;
    return Refuse(fmt::format("the message ends after {} bytes, where at least {} more were expected",
                              bytes_.size() - at_, size));
  }
  bool Refuse(const std::string& what) {
    error_ = Fault(what);
    return false;
  }
  base::Error Fault(const std::string& what) const {
    const std::string path = path_.empty() ? "" : fmt::format(" ('{}')", Text(path_));
    return base::WrongInput("message.damaged", fmt::format("byte {}{}: {}", kEncapsulation + at_, path, what));
  }

  std::span<const std::byte> bytes_;  // behind the encapsulation
  bool big_endian_;
  Visitor& visitor_;
  std::size_t at_ = 0;
  Path path_;
  std::optional<base::Error> error_;
};

class Gatherer final : public Visitor {
 public:
  void OnValue(const Path& path, Value value) override { entries.push_back({Text(path), std::move(value)}); }
  std::vector<Entry> entries;
};

}  // namespace

std::string Text(const Path& path) {
  std::string text;
  for (const PathStep& step : path) {
    if (step.member == nullptr) {
      text += fmt::format("[{}]", step.index);
    } else {
      if (!text.empty()) text += '.';
      text += *step.member;
    }
  }
  return text;
}

base::Status Walk(const Type& type, std::span<const std::byte> payload, Visitor& visitor) {
  if (payload.size() < kEncapsulation) {
    return base::WrongInput(
        "message.damaged",
        fmt::format("the message has {} bytes, the four of its encapsulation were expected", payload.size()));
  }
  const auto first = std::to_integer<unsigned>(payload[0]);
  const auto second = std::to_integer<unsigned>(payload[1]);
  if (first != 0 || second > 1) {
    constexpr const char* kText = "the encapsulation is {:02x} {:02x}, 00 00 or 00 01 (CDR version 1) was expected";
    return base::WrongInput("message.damaged", fmt::format(kText, first, second));
  }
  return Walker(payload.subspan(kEncapsulation), second == 0, visitor).Run(type);
}

base::Result<std::vector<Entry>> Flatten(const Type& type, std::span<const std::byte> payload) {
  Gatherer gatherer;
  if (auto status = Walk(type, payload, gatherer); !status) return status.error();
  return std::move(gatherer.entries);
}

}  // namespace rodeira::decode
