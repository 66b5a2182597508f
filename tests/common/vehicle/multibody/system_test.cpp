// SPDX-License-Identifier: Apache-2.0
// What a node needs of a mechanism: no allocation, the same bits, and again after a restore. Counts every allocation of
// this program.
#include <cstdlib>
#include <new>

#include "common/core/base/state.hpp"
#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace {
thread_local long g_allocations = 0;
}

// NOLINTBEGIN: replacing them all is the point
void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t align) {
  ++g_allocations;
  const auto a = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++g_allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
// NOLINTEND

namespace rodeira::multibody {
namespace {

TEST(System, AStepAllocatesNothing) {
  for (const char* name : {"pendulum", "four_bar_2", "four_bar_40", "andrews", "bricard"}) {
    Mechanism mechanism = Example(name);
    System& system = *mechanism.system;
    const long before = g_allocations;
    bool converged = true;
    for (int i = 0; i < 50; ++i) converged = system.Step(1e-5).converged && converged;
    const double energy = system.Energy() + system.Violation() + system.RateViolation();
    const bool found = system.FindAccelerations();
    EXPECT_EQ(g_allocations - before, 0) << name;
    EXPECT_TRUE(converged && found && std::isfinite(energy));
  }
  // The counter counts.
  const long before = g_allocations;
  std::vector<int> some(100);
  EXPECT_GT(g_allocations, before) << some.size();
}

TEST(System, RestoredItGoesOnWithTheSameBits) {
  for (const char* name : {"four_bar_40", "andrews", "bricard"}) {
    Mechanism first = Example(name);
    Mechanism second = Example(name);
    const double step = std::string(name) == "andrews" ? 1e-5 : 1e-3;
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(first.system->Step(step).converged);
    base::StateWriter snapshot;
    first.system->Save(snapshot);
    base::StateReader reader(snapshot.bytes());
    second.system->Restore(reader);
    ASSERT_TRUE(reader.Finish().ok());
    ASSERT_FALSE(first.system->q().empty());
    for (int i = 0; i < 1000; ++i) {
      first.system->Step(step);
      second.system->Step(step);
      for (std::size_t k = 0; k < first.system->q().size(); ++k) {
        ASSERT_EQ(first.system->q()[k], second.system->q()[k]) << name << " step " << i << " coordinate " << k;
        ASSERT_EQ(first.system->qd()[k], second.system->qd()[k]) << name << " step " << i << " velocity " << k;
      }
    }
    base::StateWriter a, b;
    first.system->Save(a);
    second.system->Save(b);
    EXPECT_EQ(a.bytes(), b.bytes());
  }
}

TEST(System, UndoGoesBackToTheStepsBeginning) {
  Mechanism bars = Example("four_bar_2");
  for (int i = 0; i < 10; ++i) bars.system->Step(1e-3);
  base::StateWriter before, after;
  bars.system->Save(before);
  bars.system->Step(1e-3);
  bars.system->Undo();
  bars.system->Save(after);
  EXPECT_EQ(before.bytes(), after.bytes());
}

}  // namespace
}  // namespace rodeira::multibody
