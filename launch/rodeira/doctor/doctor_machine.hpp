// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "launch/rodeira/doctor/finding.hpp"

// The checks of `rodeira doctor` that look at this PC: what is installed, what the processor and the disk give. What a
// check looks at is in its arguments, so that a test can break it.
namespace rodeira::cli {

// The system's reason why no file can be made in a folder; empty where one can (it is tried).
std::string WriteProblem(const std::filesystem::path& folder);

// Names of Debian packages from the form of tools/packages/run.txt: a name a line, `#` begins a comment.
std::vector<std::string> ParsePackages(std::string_view text);

// Fault if one of `packages` is not installed, warning if there is no dpkg.
Finding CheckPackages(const std::vector<std::string>& packages, const std::string& dpkg_query = "/usr/bin/dpkg-query");

// Each of `programs` lies in `folder` or its installation (base::FindProgram), is executable, and answers --help.
Finding CheckPrograms(const std::vector<std::string>& programs, const std::filesystem::path& folder);

// Fault if `loaded`, the shared object that reads elevation files and projections, is missing or cannot be loaded.
Finding CheckGeodata(const base::Status& loaded);

// Law L7. `fixed`: the choice of code was made before the start; `digest`: base::MathLibraryFingerprint() under it.
Finding CheckMathematics(bool fixed, base::Digest digest);
// Its value under the fixed choice with Debian 12's mathematics library (glibc 2.36) on x86-64, whatever the processor.
inline constexpr base::Digest kDebian12Mathematics = 0x1741155752813592;

// The largest buffers that the system allows a UDP socket, from PROC/sys/net/core.
Finding CheckSockets(const std::filesystem::path& proc = "/proc");

// Information only: whether a window can be opened, by an attempt to reach the display server.
struct DisplayPlace {
  std::string x11;             // $DISPLAY
  std::string wayland;         // $WAYLAND_DISPLAY
  std::string runtime_folder;  // $XDG_RUNTIME_DIR
  std::filesystem::path x11_sockets = "/tmp/.X11-unix";
  // By its environment.
  static DisplayPlace OfThisProcess();
};
Finding CheckDisplay(const DisplayPlace& place);

// `cores`: as the system counts them.
Finding CheckCores(unsigned int cores);
// Memory that is free for new programs, from PROC/meminfo.
Finding CheckMemory(const std::filesystem::path& proc = "/proc");
// The folder that recordings go to, or where it will be made, takes files and has room.
Finding CheckDisk(const std::filesystem::path& folder, std::uint64_t wanted_bytes = 2'000'000'000);

}  // namespace rodeira::cli
