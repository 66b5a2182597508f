// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/shared_object.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "common/core/base/version.hpp"

namespace rodeira::base {

Result<void*> LoadSharedObject(const std::filesystem::path& path, const SharedObjectEntries& entries,
                               const std::string& own_build) {
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
