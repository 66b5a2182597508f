// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/recycled_bytes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace rodeira::base {
namespace {

constexpr std::size_t kLeast_bytes = 256;
constexpr std::size_t kSizes = static_cast<std::size_t>(std::countr_zero(kMaxRecycled_bytes / kLeast_bytes)) + 1;
constexpr std::size_t kMaxOfOneSize_bytes = std::size_t{1} << 20;  // of buffers that wait, all together
constexpr std::size_t kMaxCount = 256;

constexpr std::size_t CapacityOf(std::size_t size_class) { return kLeast_bytes << size_class; }

template <class T>
class Shelf {
 public:
  explicit Shelf(std::size_t limit) : limit_(limit) { kept_.reserve(limit); }
  // False where there is none.
  bool Take(T& taken) {
    const std::lock_guard lock(mutex_);
    if (kept_.empty()) return false;
    taken = std::move(kept_.back());
    kept_.pop_back();
    return true;
  }
  // False where there are enough.
  bool Keep(T& given) {
    const std::lock_guard lock(mutex_);
    if (kept_.size() >= limit_) return false;
    kept_.push_back(std::move(given));
    return true;
  }

 private:
  std::mutex mutex_;
  const std::size_t limit_;
  std::vector<T> kept_;
};

// Never deleted: threads of libraries outlive statics.
template <std::size_t... kClass>
Shelf<Bytes>* ShelvesOf(std::index_sequence<kClass...>) {
  return new Shelf<Bytes>[sizeof...(kClass)] {
    Shelf<Bytes>(std::min(kMaxCount, kMaxOfOneSize_bytes / CapacityOf(kClass)))...
  };
}

Shelf<Bytes>& ShelfOf(std::size_t size_class) {
  static Shelf<Bytes>* const shelves = ShelvesOf(std::make_index_sequence<kSizes>());
  return shelves[size_class];
}

struct Owner {
  explicit Owner(Bytes&& given) : bytes(std::move(given)) {}
  ~Owner() { RecycleBytes(std::move(bytes)); }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  Bytes bytes;
};

// For the block of a shared Owner and its counts.
template <class T>
struct BlockAllocator {
  using value_type = T;
  BlockAllocator() = default;
  template <class U>
  explicit(false) BlockAllocator(const BlockAllocator<U>&) {}
  T* allocate(std::size_t count) {
    void* block = nullptr;
    if (count == 1 && Blocks().Take(block)) return static_cast<T*>(block);
    return static_cast<T*>(::operator new(count * sizeof(T)));
  }
  void deallocate(T* allocated, std::size_t count) {
    void* block = allocated;
    if (count != 1 || !Blocks().Keep(block)) ::operator delete(allocated);
  }
  static Shelf<void*>& Blocks() {
    static auto* const blocks = new Shelf<void*>(4 * kMaxCount);
    return *blocks;
  }
  template <class U>
  bool operator==(const BlockAllocator<U>&) const {
    return true;
  }
};

}  // namespace

Bytes TakeBytes(std::size_t size) {
  Bytes bytes;
  if (size > kMaxRecycled_bytes) {
    bytes.reserve(size);
    return bytes;
  }
  const std::size_t units = (std::max(size, kLeast_bytes) + kLeast_bytes - 1) / kLeast_bytes;
  const auto size_class = static_cast<std::size_t>(std::countr_zero(std::bit_ceil(units)));
  if (!ShelfOf(size_class).Take(bytes)) bytes.reserve(CapacityOf(size_class));
  return bytes;
}

void RecycleBytes(Bytes&& bytes) {
  Bytes given = std::move(bytes);
  const std::size_t capacity = given.capacity();
  if (capacity < kLeast_bytes || capacity >= 2 * kMaxRecycled_bytes) return;
  given.clear();
  (void)ShelfOf(static_cast<std::size_t>(std::bit_width(capacity / kLeast_bytes)) - 1).Keep(given);
}

std::shared_ptr<const Bytes> ShareBytes(Bytes bytes) {
  auto owner = std::allocate_shared<Owner>(BlockAllocator<Owner>(), std::move(bytes));
  const Bytes* shared = &owner->bytes;
  return {std::move(owner), shared};
}

}  // namespace rodeira::base
