// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/parked_source.hpp"

#include <cmath>
#include <utility>

#include "nodes/input/car_seen.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kStands_mps = 0.1;
constexpr double kPressed = 0.02, kPulled = 0.5;  // of the throttle's way, of the handbrake's

class Parked final : public Source {
 public:
  explicit Parked(std::unique_ptr<Source> person) : person_(std::move(person)) {}

  dynamics::Controls First() override { return person_->First(); }

  base::Result<dynamics::Controls> Step(const lockstep::StepInfo& step, std::int64_t valid_ns,
                                        const lockstep::Inbox& inbox) override {
    auto controls = person_->Step(step, valid_ns, inbox);
    if (!controls) return controls;
    if (!begun_) {
      const auto car = SeeCar(inbox);
      if (!car) return car.error();
      begun_ = true;
      parked_ = std::fabs(car.value().speed_mps) < kStands_mps;
    }
    dynamics::Controls& now = controls.value();
    const bool pulls = now.handbrake > kPulled;
    if (now.throttle > kPressed || (pulls_ && !pulls)) parked_ = false;
    pulls_ = pulls;
    if (parked_) now.handbrake = 1.0;
    return controls;
  }

  input_devices::Signals signals() const override { return person_->signals(); }
  bool runs_inline() const override { return person_->runs_inline(); }

  void Save(base::StateWriter& out) const override {
    out.Put("person", *person_);
    out.Put("begun", begun_);
    out.Put("parked", parked_);
    out.Put("pulls", pulls_);
  }
  void Restore(base::StateReader& in) override {
    in.Get("person", *person_);
    in.Get("begun", begun_);
    in.Get("parked", parked_);
    in.Get("pulls", pulls_);
  }

  // A car with its handbrake pulled is taken over so.
  void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& signals) override {
    person_->InitialiseFrom(last, signals);
    begun_ = true;
    parked_ = last.handbrake > kPulled && last.throttle <= kPressed;
    pulls_ = false;
  }

 private:
  std::unique_ptr<Source> person_;
  bool begun_ = false;
  bool parked_ = false;
  bool pulls_ = false;  // by the person, at the last activation
};

}  // namespace

std::unique_ptr<Source> ParkedSource(std::unique_ptr<Source> person) {
  return std::make_unique<Parked>(std::move(person));
}

}  // namespace rodeira::nodes
