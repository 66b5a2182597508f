// SPDX-License-Identifier: Apache-2.0
#include "common/data/decode/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "common/data/decode/walk.hpp"

namespace rodeira::decode {
namespace {

// What was visited, without the paths: they are made once the place is known.
class Log final : public Visitor {
 public:
  struct Item {
    bool is_length = false;
    Value value;
  };
  void OnValue(const Path&, Value value) override { items.emplace_back().value = std::move(value); }
  void OnSequence(const Path&, std::uint64_t length) override {
    Item& item = items.emplace_back();
    item.is_length = true;
    item.value.emplace<std::uint64_t>(length);
  }
  std::vector<Item> items;
};

class PathOf final : public Visitor {
 public:
  explicit PathOf(std::size_t item) : left_(item) {}
  void OnValue(const Path& at, Value) override { Count(at); }
  void OnSequence(const Path& at, std::uint64_t) override { Count(at); }
  std::string path;

 private:
  void Count(const Path& at) {
    if (left_-- == 0) path = Text(at);
  }
  std::size_t left_;
};

std::string Describe(const Log::Item& item) {
  return item.is_length ? fmt::format("{} elements", std::get<std::uint64_t>(item.value)) : TextWithBits(item.value);
}

bool Same(const Log::Item& a, const Log::Item& b) { return a.is_length == b.is_length && SameBits(a.value, b.value); }

std::string ByteText(std::span<const std::byte> bytes, std::size_t at) {
  return at < bytes.size() ? fmt::format("0x{:02x}", std::to_integer<unsigned>(bytes[at])) : "nothing";
}

// Of two runs of octets only the octet that differs is said.
Difference OfOctets(const std::string& path, const base::Bytes& a, const base::Bytes& b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto at = static_cast<std::size_t>(differs.first - a.begin());
  return {fmt::format("{}[{}]", path, at), ByteText(a, at), ByteText(b, at)};
}

}  // namespace

std::optional<Difference> FirstDifference(const Type& type, std::span<const std::byte> a,
                                          std::span<const std::byte> b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (differs.first == a.end() && differs.second == b.end()) return std::nullopt;
  const auto byte = static_cast<std::size_t>(differs.first - a.begin());
  Log of_a;
  Log of_b;
  const auto status_a = Walk(type, a, of_a);
  const auto status_b = Walk(type, b, of_b);
  const auto items = std::mismatch(of_a.items.begin(), of_a.items.end(), of_b.items.begin(), of_b.items.end(), Same);
  if (items.first != of_a.items.end() && items.second != of_b.items.end()) {
    PathOf at(static_cast<std::size_t>(items.first - of_a.items.begin()));
    (void)Walk(type, a, at);  // it came so far before
    const auto* octets = std::get_if<base::Bytes>(&items.first->value);
    if (octets != nullptr) return OfOctets(at.path, *octets, std::get<base::Bytes>(items.second->value));
    return Difference{at.path, Describe(*items.first), Describe(*items.second)};
  }
  const auto found = [byte](const base::Status& status, std::span<const std::byte> payload) {
    return status ? ByteText(payload, byte) : status.error().message;
  };
  return Difference{fmt::format("byte {}", byte), found(status_a, a), found(status_b, b)};
}

}  // namespace rodeira::decode
