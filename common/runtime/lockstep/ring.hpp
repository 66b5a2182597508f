// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {

// A queue of values that allocates only where more lie in it than ever before (std::deque allocates all the time).
template <class T>
class Ring {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t at) { return places_[Place(at)]; }
  const T& operator[](std::size_t at) const { return places_[Place(at)]; }
  T& front() { return (*this)[0]; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }

  void push_back(T value) {
    if (size_ == places_.size()) Grow(size_ + 1);
    ++size_;
    (*this)[size_ - 1] = std::move(value);
  }
  void pop_front() {
    RODEIRA_ASSERT(size_ > 0);
    front() = T();
    first_ = Place(1);
    --size_;
  }
  // Adds empty values at the end. Precondition: not fewer than size().
  void resize(std::size_t size) {
    RODEIRA_ASSERT(size >= size_);
    if (size > places_.size()) Grow(size);
    size_ = size;  // places outside of the queue hold T()
  }

  class const_iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;
    const_iterator() = default;
    const_iterator(const Ring* ring, difference_type at) : ring_(ring), at_(at) {}
    reference operator*() const { return (*ring_)[static_cast<std::size_t>(at_)]; }
    pointer operator->() const { return &**this; }
    const_iterator& operator++() { return *this += 1; }
    const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
    const_iterator& operator--() { return *this += -1; }
    const_iterator operator--(int) { return std::exchange(*this, *this - 1); }
    const_iterator& operator+=(difference_type by) {
      at_ += by;
      return *this;
    }
    const_iterator& operator-=(difference_type by) { return *this += -by; }
    reference operator[](difference_type by) const { return *(*this + by); }
    friend const_iterator operator+(const_iterator a, difference_type by) { return a += by; }
    friend const_iterator operator+(difference_type by, const_iterator a) { return a += by; }
    friend const_iterator operator-(const_iterator a, difference_type by) { return a -= by; }
    friend difference_type operator-(const const_iterator& a, const const_iterator& b) { return a.at_ - b.at_; }
    friend bool operator==(const const_iterator& a, const const_iterator& b) { return a.at_ == b.at_; }
    friend auto operator<=>(const const_iterator& a, const const_iterator& b) { return a.at_ <=> b.at_; }

   private:
    const Ring* ring_ = nullptr;
    difference_type at_ = 0;
  };
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, static_cast<std::ptrdiff_t>(size_)}; }

 private:
  std::size_t Place(std::size_t at) const { return (first_ + at) & (places_.size() - 1); }
  void Grow(std::size_t least) {
    std::vector<T> places(std::bit_ceil(least));
    for (std::size_t i = 0; i < size_; ++i) places[i] = std::move((*this)[i]);
    places_ = std::move(places);
    first_ = 0;
  }

  std::vector<T> places_;  // none, or a power of two
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace rodeira::lockstep
