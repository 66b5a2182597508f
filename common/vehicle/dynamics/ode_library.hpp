// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dynamics {

// The most points at which two bodies touch that ODE is asked for.
inline constexpr int kMaxContacts = 8;

// Before anything of ODE's is used on a thread: its tables are made once a process, its collision buffers once a
// thread.
void PrepareOde();

}  // namespace rodeira::dynamics
