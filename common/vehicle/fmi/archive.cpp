// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/archive.hpp"

#include <fmt/format.h>
#include <unzip.h>

#include <array>
#include <fstream>
#include <memory>
#include <string>

namespace rodeira::fmi {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxBytes = 1u << 30;

struct Closer {
  void operator()(void* file) const { (void)unzClose(file); }
};

bool LeadsOut(const fs::path& name) {
  if (name.is_absolute() || name.has_root_name()) return true;
  for (const fs::path& part : name) {
    if (part == "..") return true;
  }
  return false;
}

// The archive's present file, whole.
bool Write(unzFile archive, const fs::path& to, std::uint64_t& left) {
  if (unzOpenCurrentFile(archive) != UNZ_OK) return false;
  std::ofstream out(to, std::ios::binary);
  std::array<char, 1 << 16> buffer;
  int got = 0;
  while ((got = unzReadCurrentFile(archive, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    if (static_cast<std::uint64_t>(got) > left) break;
    left -= static_cast<std::uint64_t>(got);
    out.write(buffer.data(), got);
  }
  const bool sound = unzCloseCurrentFile(archive) == UNZ_OK;  // compares the checksum
  out.flush();
  return got == 0 && sound && out.good();
}

}  // namespace

base::Result<base::TemporaryFolder> Unpack(const fs::path& path) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem))
    return base::WrongInput("file.not_found", "there is no such file", path.string());
  const std::unique_ptr<void, Closer> archive(unzOpen64(path.c_str()));
  if (archive == nullptr)
    return base::WrongInput("fmu.not_an_fmu", "this is no FMU: a ZIP archive was expected", path.string());
  auto folder = base::TemporaryFolder::Make("fmu");
  if (!folder) return folder;
  std::uint64_t left = kMaxBytes;
  for (int more = unzGoToFirstFile(archive.get()); more != UNZ_END_OF_LIST_OF_FILE;
       more = unzGoToNextFile(archive.get())) {
    std::array<char, 4096> text{};
    unz_file_info64 info{};
    if (more != UNZ_OK ||
        unzGetCurrentFileInfo64(archive.get(), &info, text.data(), text.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK) {
      return base::WrongInput("fmu.damaged_archive", "the archive is damaged", path.string());
    }
    const fs::path name(text.data());
    if (LeadsOut(name))
      return base::WrongInput("fmu.damaged_archive",
                              fmt::format("the archive's '{}' leads out of its folder", text.data()), path.string());
    const fs::path to = folder.value().path() / name;
    fs::create_directories(name.has_filename() ? to.parent_path() : to, problem);
    if (!name.has_filename()) continue;
    if (!Write(archive.get(), to, left))
      return base::WrongInput("fmu.damaged_archive",
                              fmt::format("the archive's '{}' is damaged or too large", text.data()), path.string());
  }
  return folder;
}

}  // namespace rodeira::fmi
