// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/build_id.hpp"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <optional>
#include <random>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/core/base/files.hpp"

namespace rodeira::base {
namespace {

std::optional<Digest> BuildIdIn(std::span<const std::byte> notes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  ByteReader reader(notes);
  while (reader.remaining() >= sizeof(ElfW(Nhdr))) {
    const auto name_size = reader.Get<std::uint32_t>(), size = reader.Get<std::uint32_t>(),
               type = reader.Get<std::uint32_t>();
    const auto name = reader.GetRaw(padded(name_size)), content = reader.GetRaw(padded(size));
    if (!reader.ok()) return std::nullopt;
    if (type == NT_GNU_BUILD_ID && name_size == sizeof(ELF_NOTE_GNU) && size > 0 &&
        std::memcmp(name.data(), ELF_NOTE_GNU, name_size) == 0)
      return Hash(content);
  }
  return std::nullopt;
}

// The first object is the program itself.
int OfProgram(dl_phdr_info* object, std::size_t, void* found) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const auto* bytes = reinterpret_cast<const std::byte*>(object->dlpi_addr + part.p_vaddr);
    if (const auto id = BuildIdIn({bytes, part.p_memsz})) {
      *static_cast<std::optional<Digest>*>(found) = id;
      break;
    }
  }
  return 1;
}

Digest Find() {
  std::optional<Digest> found;
  ::dl_iterate_phdr(OfProgram, &found);
  if (found) return *found;
  if (const auto program = ReadBytes("/proc/self/exe")) return Hash(program.value());
  std::random_device random;
  return Combine(random(), random());
}

}  // namespace

Digest BuildDigest() {
  static const Digest digest = Find();
  return digest;
}

}  // namespace rodeira::base
