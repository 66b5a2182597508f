// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace rodeira::base {

// Threads that wait for work to share: much of it, again and again. Which of them does what changes no result where no
// part reads what another one writes.
class Crew {
 public:
  // The caller is one of them; 1: nobody else.
  explicit Crew(unsigned threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  unsigned threads() const;
  // work(begin, end) for parts that make up [0, count), at the same time; comes back when all are done. One caller at a
  // time.
  void Share(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The same by the caller alone where there is no crew.
void Share(Crew* crew, std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace rodeira::base
