// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rodeira::cli {

// "871 B", "12.3 kB", "4.5 MB", "1.2 GB".
std::string Size(std::uint64_t bytes);

// What became of the file of a run that ended at `reached_s`: its size, and where it was not closed (its recorder died)
// how much of the run it holds and what to do; where it was closed, what the recorder's audit found. A line each; empty
// where there is no file.
std::string WrittenFile(const std::string& recording, double reached_s);

// What follows from it that a node cannot save its state: for a run, and for a recording that is computed again. A line
// a node.
std::string WithoutStateLine(const std::string& node);
// Of the nodes with these names.
std::string ComputedFromTheStart(const std::vector<std::string>& nodes);

// Where another program recorded than this one: a line that says so, because another one may compute other bits. Empty
// where it was the same release and commit.
std::string RecordedByAnother(const std::string& version, const std::string& commit);

}  // namespace rodeira::cli
