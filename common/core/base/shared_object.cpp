// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/shared_object.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <system_error>

#include "common/core/base/version.hpp"

namespace rodeira::base {
namespace {

// Whether the segments of an ELF file lie in it whole. dlopen does not check that: the process that touches a page
// behind the end of a file gets SIGBUS. True for all other files, which dlopen refuses.
bool HoldsItsSegments(const std::filesystem::path& path) {
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  if (problem || !file.read(reinterpret_cast<char*>(&header), sizeof(header))) return true;
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS64 ||
      header.e_phentsize != sizeof(Elf64_Phdr))
    return true;
  file.seekg(static_cast<std::streamoff>(header.e_phoff));
  for (int i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment{};
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof(segment))) return false;
    if (segment.p_filesz > size || segment.p_offset > size - segment.p_filesz) return false;
  }
  return true;
}

}  // namespace

Result<void*> LoadSharedObject(const std::filesystem::path& path, const SharedObjectEntries& entries,
                               const std::string& own_build) {
  if (!HoldsItsSegments(path))
    return WrongInput("file.not_loadable", "cannot load the shared object: the file is cut short", path.string());
  ::dlerror();
  // With a folder in its name: a bare name would be looked for among the system's libraries.
  void* library = ::dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* problem = ::dlerror();
    return WrongInput("file.not_loadable",
                      fmt::format("cannot load the shared object: {}", problem == nullptr ? "?" : problem));
  }
  const auto build = reinterpret_cast<const char* (*)()>(::dlsym(library, entries.build));
  void* make = ::dlsym(library, entries.make);
  if (build == nullptr || make == nullptr) {
    return WrongInput("file.no_entry_point",
                      fmt::format("the shared object has no entry point '{}'; {} in one of its sources was expected",
                                  build == nullptr ? entries.build : entries.make, entries.written_by),
                      path.string());
  }
  if (build() != own_build) {
    return WrongInput(
        "file.other_build",
        fmt::format("the shared object was built with {}, this program is {}; build it again", build(), own_build),
        path.string());
  }
  return make;
}

std::string BuildText(std::size_t layout) {
  return fmt::format("Rodeira {}, compiler {}, layout {:x}", Version(), __VERSION__, layout);
}

}  // namespace rodeira::base
