// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/runtime/launch/launch.hpp"

namespace rodeira::cli {

// `rodeira env LAUNCH.yaml --agent NODE`: the process behind rodeira.Env (python/rodeira/env.py).
//
// It reads requests from standard input and writes one answer to each to standard output, after a first answer without
// a request. Both are: the length of what follows (uint32), a letter, the content. All is little-endian and without
// padding; a text is its length (uint32) and its UTF-8 bytes. It ends when standard input is closed.
//
//   request                                            answer
//   (the first)                                        H: launch file, period, sources, IDL texts
//   R: has_seed (uint8), seed (uint64), record (text)  O: the observation at step 0
//   A: controls                                        O: the observation one period later
//   D                                                  D: digest of the episode so far (16 hexadecimal digits)
//   F                                                  F: the episode is over
//   any                                                E: exit status (uint32), id (text), sentence (text)
//
// controls: steering_wheel_rad, throttle, brake, clutch, handbrake (double), gear (int32), gearbox_mode, starter,
// indicators, headlights, horn (uint32). Observation: step (int64), number of samples (uint32), and of each sample its
// source (uint32), its size (uint32) and its payload.
struct EnvOptions {
  std::string launch_file;
  launch::Overrides overrides;
  std::string agent;
};
int Env(const EnvOptions& options);

}  // namespace rodeira::cli
