// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/archive.hpp"

#include <fmt/format.h>
#include <unzip.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rodeira::opendrive {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSmall = std::size_t{1} << 24;  // unpacked; so much is never called a bomb
constexpr std::size_t kMaxFiles = 10'000;
constexpr std::uint64_t kIsEncrypted = 1;  // in a ZIP entry's flags

bool IsTooMuch(std::size_t unpacked, std::size_t packed) {
  return unpacked > kMaxUnpackedBytes || IsBomb(unpacked, packed);
}

base::Error TooMuch(const std::string& what, std::size_t unpacked, std::size_t packed, const fs::path& path) {
  return base::WrongInput(
      "opendrive.archive_too_large",
      unpacked > kMaxUnpackedBytes
          ? fmt::format("{} unpacks to more than {} MiB; that is too much for a road network", what,
                        kMaxUnpackedBytes >> 20)
          : fmt::format("{} unpacks to more than {} times its {} bytes; this is no road network but a zip bomb", what,
                        kMaxPackedRatio, packed),
      path.string());
}

// The bytes of an archive as minizip reads a file.
struct Memory {
  std::string_view bytes;
  std::size_t at = 0;
};

voidpf OpenMemory(voidpf bytes, const void*, int) { return new Memory{*static_cast<std::string_view*>(bytes), 0}; }
uLong ReadMemory(voidpf, voidpf stream, void* to, uLong size) {
  Memory& memory = *static_cast<Memory*>(stream);
  const std::size_t count = std::min<std::size_t>(size, memory.bytes.size() - memory.at);
  if (count > 0) std::memcpy(to, memory.bytes.data() + memory.at, count);
  memory.at += count;
  return count;
}
uLong WriteMemory(voidpf, voidpf, const void*, uLong) { return 0; }
ZPOS64_T TellMemory(voidpf, voidpf stream) { return static_cast<Memory*>(stream)->at; }
long SeekMemory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  Memory& memory = *static_cast<Memory*>(stream);
  const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? memory.at
                           : origin == ZLIB_FILEFUNC_SEEK_END ? memory.bytes.size()
                                                              : 0;
  const std::size_t to = from + static_cast<std::size_t>(offset);  // an offset below 0 wraps, as it does in C
  if (to > memory.bytes.size()) return -1;
  memory.at = to;
  return 0;
}
int CloseMemory(voidpf, voidpf stream) {
  delete static_cast<Memory*>(stream);
  return 0;
}
int NoError(voidpf, voidpf) { return 0; }

struct Closer {
  void operator()(void* file) const { (void)unzClose(file); }
};
using Unzip = std::unique_ptr<void, Closer>;

Unzip OpenZip(std::string_view& bytes) {
  zlib_filefunc64_def functions{&OpenMemory, &ReadMemory,  &WriteMemory, &TellMemory,
                                &SeekMemory, &CloseMemory, &NoError,     &bytes};
  return Unzip(unzOpen2_64(nullptr, &functions));
}

bool LeadsOut(const fs::path& name) {
  if (name.is_absolute() || name.has_root_name() || (name.string().size() > 1 && name.string()[1] == ':')) return true;
  return std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

bool IsOfFinder(const std::string& name) {
  return name.starts_with("__MACOSX/") || fs::path(name).filename().string().starts_with("._");
}

}  // namespace

bool IsBomb(std::size_t unpacked, std::size_t packed) {
  return unpacked > kSmall && unpacked / kMaxPackedRatio > packed;
}

bool IsGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }
bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06"); }

base::Result<std::string> Gunzip(std::string_view bytes, const fs::path& path) {
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK)
    return base::Failed("file.cannot_read", "zlib cannot be started", path.string());
  const std::unique_ptr<z_stream, int (*)(z_streamp)> ended(&stream, &inflateEnd);
  std::array<char, 1 << 16> buffer;
  std::string text;
  std::size_t fed = 0;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  while (true) {
    if (stream.avail_in == 0 && fed < bytes.size()) {
      const std::size_t count = std::min(kChunk, bytes.size() - fed);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + fed));
      stream.avail_in = static_cast<uInt>(count);
      fed += count;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END)
      return base::WrongInput("opendrive.wrong_archive",
                              status == Z_BUF_ERROR ? "the gzip data is cut short"
                                                    : fmt::format("the gzip data is damaged: {}",
                                                                  stream.msg == nullptr ? "zlib" : stream.msg),
                              path.string());
    text.append(buffer.data(), buffer.size() - stream.avail_out);
    if (IsTooMuch(text.size(), bytes.size())) return TooMuch("the gzip data", text.size(), bytes.size(), path);
    if (status != Z_STREAM_END) continue;
    // Several members one behind the other are one file; other bytes behind the end are padding.
    const std::string_view rest = bytes.substr(fed - stream.avail_in);
    if (!IsGzip(rest)) return text;
    inflateReset(&stream);
  }
}

base::Result<std::shared_ptr<const Archive>> Archive::Open(std::string bytes, const fs::path& path) {
  std::shared_ptr<Archive> archive(new Archive());
  archive->bytes_ = std::move(bytes);
  archive->path_ = path;
  std::string_view view = archive->bytes_;
  const Unzip zip = OpenZip(view);
  const auto damaged = [&] {
    return base::WrongInput("opendrive.wrong_archive", "the ZIP archive is damaged or cut short", path.string());
  };
  if (zip == nullptr) return damaged();
  std::size_t count = 0;
  for (int more = unzGoToFirstFile(zip.get()); more != UNZ_END_OF_LIST_OF_FILE; more = unzGoToNextFile(zip.get())) {
    std::array<char, 4096> text{};
    unz_file_info64 info{};
    if (more != UNZ_OK ||
        unzGetCurrentFileInfo64(zip.get(), &info, text.data(), text.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK)
      return damaged();
    if (++count > kMaxFiles)
      return base::WrongInput("opendrive.archive_too_large",
                              fmt::format("the archive holds more than {} files", kMaxFiles), path.string());
    std::string name = text.data();
    std::replace(name.begin(), name.end(), '\\', '/');
    if (LeadsOut(name))
      return base::WrongInput("opendrive.wrong_archive",
                              fmt::format("the path of '{}' leaves the archive; paths inside it were expected", name),
                              path.string());
    if (name.empty() || name.ends_with('/') || IsOfFinder(name)) continue;
    if ((info.flag & kIsEncrypted) != 0)
      return base::WrongInput("opendrive.wrong_archive",
                              fmt::format("'{}' in the archive is encrypted; unpack it first", name), path.string());
    archive->names_.push_back(fs::path(name).lexically_normal().generic_string());
    archive->stored_.emplace_back(text.data());
  }
  return std::shared_ptr<const Archive>(std::move(archive));
}

bool Archive::Has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

base::Result<std::string> Archive::Read(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  std::string_view view = bytes_;
  const Unzip zip = OpenZip(view);
  const auto damaged = [&] {
    return base::WrongInput("opendrive.wrong_archive",
                            fmt::format("'{}' in the archive is damaged or packed in an unknown way", name),
                            path_.string());
  };
  if (found == names_.end() || zip == nullptr) return damaged();
  const std::string& stored = stored_[static_cast<std::size_t>(found - names_.begin())];
  unz_file_info64 info{};
  if (unzLocateFile(zip.get(), stored.c_str(), 1) != UNZ_OK ||
      unzGetCurrentFileInfo64(zip.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK ||
      unzOpenCurrentFile(zip.get()) != UNZ_OK)
    return damaged();
  // The size that the archive says may be a lie; what is packed is no more than the archive.
  const std::size_t packed = std::min<std::size_t>(info.compressed_size, bytes_.size());
  std::array<char, 1 << 16> buffer;
  std::string text;
  int got = 0;
  while ((got = unzReadCurrentFile(zip.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
    if (IsTooMuch(text.size(), packed)) return TooMuch(fmt::format("'{}'", name), text.size(), packed, path_);
  }
  const bool sound = unzCloseCurrentFile(zip.get()) == UNZ_OK;  // compares the checksum
  if (got != 0 || !sound) return damaged();
  return text;
}

}  // namespace rodeira::opendrive
