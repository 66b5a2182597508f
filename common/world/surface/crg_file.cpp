// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/core/base/files.hpp"
#include "common/world/surface/crg_build.hpp"
#include "common/world/surface/crg_table.hpp"

namespace rodeira::surface {
namespace {

base::Result<CrgFile> Finish(CrgHeader header, std::span<const std::byte> bytes, const std::string& name) {
  auto table = ReadCrgTable(header, bytes, name);
  if (!table) return table.error();
  CrgFile file;
  file.warnings = header.warnings;
  const CrgModifiers modifiers = header.modifiers.value_or(CrgModifiers{});
  auto shape =
      BuildCrgShape(header, table.value(), modifiers, header.options.value_or(CrgOptions{}), name, file.warnings);
  if (!shape) return shape.error();
  auto surface = std::make_shared<const CrgSurface>(PlaceCrgShape(std::move(shape).value(), modifiers));
  if (surface->shape().options.close_track && !surface->closed()) {
    file.warnings.push_back(
        "REFLINE_CONTINUATION asks for a closed track, but the ends do not meet within 60 degrees: the line goes on "
        "straight");
  }
  file.surface = std::move(surface);
  file.header = std::move(header);
  return file;
}

}  // namespace

base::Result<CrgFile> ParseCrg(std::span<const std::byte> bytes, const std::string& name) {
  auto header = ReadCrgHeader(bytes, name);
  if (!header) return header.error();
  if (header.value().data_offset == 0) {
    return base::WrongInput("surface.wrong_reference",
                            "the file holds no numbers of its own, only the name of another file", name);
  }
  return Finish(std::move(header).value(), bytes, name);
}

base::Result<CrgFile> LoadCrg(const std::filesystem::path& path) {
  const auto bytes = base::ReadBytes(path);
  if (!bytes) return bytes.error();
  auto header = ReadCrgHeader(bytes.value(), path.string());
  if (!header) return header.error();
  if (header.value().data_offset != 0) return Finish(std::move(header).value(), bytes.value(), path.string());

  const std::filesystem::path other = path.parent_path() / header.value().other_file;
  const auto numbers = base::ReadBytes(other);
  if (!numbers) {
    return numbers.error()
        .WithMessage(fmt::format("$ROAD_CRG_FILE names '{}': {}", header.value().other_file, numbers.error().message))
        .WithContext(path.string());
  }
  auto with_numbers = ReadCrgHeader(numbers.value(), other.string());
  if (!with_numbers) return with_numbers.error();
  if (with_numbers.value().data_offset == 0) {
    return base::WrongInput("surface.wrong_reference",
                            "the file is named by another .crg and names a third one; one step is followed",
                            other.string());
  }
  if (header.value().options) with_numbers.value().options = header.value().options;
  if (header.value().modifiers) with_numbers.value().modifiers = header.value().modifiers;
  return Finish(std::move(with_numbers).value(), numbers.value(), other.string());
}

}  // namespace rodeira::surface
