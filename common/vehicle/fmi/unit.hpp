// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/vehicle/fmi/description.hpp"

namespace rodeira::fmi {

// One running instance of an FMU. Every call may fail: what it says then is "fmi2DoStep: error: WHAT THE FMU LOGGED".
// After a failure nothing but the destructor may be called. A crash of its code ends the process as any crash does;
// base::ForeignCall names the function and the FMU.
class Instance {
 public:
  virtual ~Instance() = default;

  // Back to where Instantiate leaves it, for an FMU of which a process may have one instance only. Wrong input where
  // its binary has no fmi2Reset.
  virtual base::Status Reset() = 0;
  // Before the first step: values are set between these two.
  virtual base::Status EnterInitialisation(double time_s) = 0;
  virtual base::Status ExitInitialisation() = 0;
  // Whole numbers and truths are numbers, too (rounded; 0 or 1).
  virtual base::Status Set(const Variable& variable, double value) = 0;
  // In the unit of the FMU's variable.
  virtual base::Result<double> Get(const Variable& variable) = 0;
  // From time_s on, over step_s; the times of successive calls join.
  virtual base::Status DoStep(double time_s, double step_s) = 0;
  // The whole state, where the description offers it (can_get_state and can_serialize_state).
  virtual base::Result<base::Bytes> State() = 0;
  // Bytes of State() of an instance of the same FMU.
  virtual base::Status SetState(std::span<const std::byte> bytes) = 0;
};

// An FMU for co-simulation, FMI 2.0, of this platform (linux64): unpacked and loaded. Instances must not outlive it.
class Unit {
 public:
  // The FMU is tried in a process of its own first (trial.hpp). Wrong input if the file is no FMU, is of another
  // platform or does not pass the trial.
  static base::Result<std::unique_ptr<Unit>> Load(const std::filesystem::path& fmu);
  // An FMU that is unpacked in `folder`, which outlives it, without a trial. `file`: its path for messages.
  static base::Result<std::unique_ptr<Unit>> LoadUnpacked(const std::filesystem::path& folder, const std::string& file);
  virtual ~Unit() = default;

  virtual const Description& description() const = 0;
  // Wrong input where the FMU makes none, or where this process has one of an FMU that allows one only.
  virtual base::Result<std::unique_ptr<Instance>> Instantiate(const std::string& name) = 0;
  // Its state can be saved and set in another process. The trial finds out: the bytes of some FMUs hold addresses.
  virtual bool can_save_state() const = 0;
  // A sentence where the description promises states that the trial could not take over; otherwise empty.
  virtual const std::string& note() const = 0;
};

}  // namespace rodeira::fmi
