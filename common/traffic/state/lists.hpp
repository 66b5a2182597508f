// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rodeira::traffic {

// One list for each of many keys, most of them empty, each in the order in which it was added to: four bytes a key, and
// all that is added in one piece of memory.
template <class Item>
class Lists {
  struct Entry {
    Item item;
    std::uint32_t key, next;
  };

 public:
  explicit Lists(std::size_t keys) : firsts_(keys, kNone) {}

  // All lists become empty.
  void Clear() {
    for (const Entry& entry : entries_) firsts_[entry.key] = kNone;
    entries_.clear();
  }
  // Precondition: key is below the number of keys.
  void Add(std::size_t key, const Item& item) {
    std::uint32_t* at = &firsts_[key];
    while (*at != kNone) at = &entries_[*at].next;
    *at = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({item, static_cast<std::uint32_t>(key), kNone});
  }

  class Iterator {
   public:
    Iterator(const Lists& lists, std::uint32_t at) : lists_(&lists), at_(at) {}
    const Item& operator*() const { return lists_->entries_[at_].item; }
    Iterator& operator++() {
      at_ = lists_->entries_[at_].next;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const Lists* lists_;
    std::uint32_t at_;
  };
  // A list's items; valid until the next Add or Clear.
  struct Range {
    Iterator first, last;
    Iterator begin() const { return first; }
    Iterator end() const { return last; }
    bool empty() const { return !(first != last); }
  };
  Range Of(std::size_t key) const { return {{*this, firsts_[key]}, {*this, kNone}}; }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> firsts_;
  std::vector<Entry> entries_;
};

}  // namespace rodeira::traffic
