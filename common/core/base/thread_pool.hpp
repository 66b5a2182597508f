// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace rodeira::base {

// Threads that wait for work. The only pool of Rodeira's own: all parallel loops run on one. The results do not depend
// on the number of threads if no part reads what another part writes.
class ThreadPool {
 public:
  // `threads`: at least 1, the calling thread included. 0: one for each core. Where the system gives fewer, the pool
  // has these.
  explicit ThreadPool(unsigned threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  unsigned threads() const;
  // Calls work(begin, end) for disjoint parts of [0, count) at the same time and returns when all are done. The calling
  // thread does the part that begins at 0. One caller at a time. An exception of `work` is thrown here once all parts
  // have ended, of several the first one.
  void ParallelFor(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The same; null: the calling thread does everything.
void ParallelFor(ThreadPool* pool, std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace rodeira::base
