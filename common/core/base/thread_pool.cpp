// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/thread_pool.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace rodeira::base {

struct ThreadPool::Parts {
  std::mutex mutex;
  std::condition_variable begins, ends;
  std::uint64_t round = 0;
  std::size_t count = 0, busy = 0;
  bool over = false;
  const std::function<void(std::size_t, std::size_t)>* work = nullptr;
  std::exception_ptr thrown;
  std::vector<std::jthread> others;  // last: they end before what they use

  void Do(std::size_t part) {
    const std::size_t parts = others.size() + 1;
    const std::size_t begin = count * part / parts, end = count * (part + 1) / parts;
    if (begin >= end) return;
    try {
      (*work)(begin, end);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  }
  void Wait(std::size_t part) {
    std::uint64_t done = 0;
    std::unique_lock lock(mutex);
    while (true) {
      begins.wait(lock, [&] { return over || round != done; });
      if (over) return;
      done = round;
      lock.unlock();
      Do(part);
      lock.lock();
      if (--busy == 0) ends.notify_one();
    }
  }
};

ThreadPool::ThreadPool(unsigned threads) : parts_(std::make_unique<Parts>()) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  parts_->others.reserve(threads - 1);
  const std::scoped_lock lock(parts_->mutex);  // no thread reads `others` before it is whole
  for (std::size_t part = 1; part < threads; ++part) {
    try {
      parts_->others.emplace_back([parts = parts_.get(), part] { parts->Wait(part); });
    } catch (const std::system_error&) {
      return;  // the limit of threads is reached
    }
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::scoped_lock lock(parts_->mutex);
    parts_->over = true;
  }
  parts_->begins.notify_all();
}

unsigned ThreadPool::threads() const { return static_cast<unsigned>(parts_->others.size() + 1); }

void ThreadPool::ParallelFor(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  {
    const std::scoped_lock lock(parts_->mutex);
    parts_->work = &work;
    parts_->count = count;
    parts_->busy = parts_->others.size();
    ++parts_->round;
  }
  parts_->begins.notify_all();
  parts_->Do(0);
  std::unique_lock lock(parts_->mutex);
  parts_->ends.wait(lock, [&] { return parts_->busy == 0; });
  if (const std::exception_ptr thrown = std::exchange(parts_->thrown, nullptr)) std::rethrow_exception(thrown);
}

void ParallelFor(ThreadPool* pool, std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  if (pool != nullptr)
    pool->ParallelFor(count, work);
  else
    work(0, count);
}

}  // namespace rodeira::base
