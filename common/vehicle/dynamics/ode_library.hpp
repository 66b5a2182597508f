// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dynamics {

// Before anything of ODE's is used on a thread: its tables are made once a process, its collision buffers once a
// thread.
void PrepareOde();

}  // namespace rodeira::dynamics
