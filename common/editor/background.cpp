// SPDX-License-Identifier: Apache-2.0
#include "common/editor/background.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/world/terrain/geodata.hpp"
#include "common/world/traffic_map/map_file.hpp"
#include "common/world/traffic_map/picture.hpp"

namespace rodeira::editor {
namespace {

base::Result<std::unique_ptr<terrain::PictureReader>> OpenPicture(std::string_view bytes) {
  const auto& geodata = terrain::SharedGeodata();
  if (!geodata) return geodata.error();
  return geodata.value()->OpenPicture(bytes, kLargestPicture_px);
}

// A picture that its file gives at an eighth of its size without being read whole; nothing where there is none.
std::optional<Pyramid> ReadSmall(terrain::PictureReader& picture) {
  constexpr std::size_t kLevel = 3;
  const int width = Pyramid::SizeAt(picture.width_px(), kLevel), height = Pyramid::SizeAt(picture.height_px(), kLevel);
  auto rgb = picture.ReadEighth(width, height);
  if (!rgb) return std::nullopt;
  return Pyramid(picture.width_px(), picture.height_px(), kLevel, Pixels{width, height, std::move(*rgb)});
}

}  // namespace

base::Result<Pixels> DecodePicture(std::string_view bytes, const Progress& progress) {
  auto set = OpenPicture(bytes);
  if (!set) return set.error();
  Pixels pixels{set.value()->width_px(), set.value()->height_px(), {}};
  pixels.rgb.resize(3 * static_cast<std::size_t>(pixels.width_px) * static_cast<std::size_t>(pixels.height_px));
  const auto ready = [&](int rows) { return !progress || progress(static_cast<double>(rows) / pixels.height_px); };
  if (auto status = set.value()->ReadAll(pixels.rgb.data(), ready); !status) return status.error();
  return pixels;
}

base::Result<std::shared_ptr<const Pyramid>> ReadPyramid(std::string_view bytes, const Progress& progress,
                                                         const Sooner& preview) {
  auto set = OpenPicture(bytes);
  if (!set) return set.error();
  if (auto small = preview ? ReadSmall(*set.value()) : std::nullopt)
    preview(std::make_shared<const Pyramid>(std::move(*small)));
  PyramidBuilder builder(set.value()->width_px(), set.value()->height_px());
  const int height = builder.finest().height_px;
  std::atomic<int> filled{0};
  std::atomic<bool> ended{false};
  std::thread grower([&] {
    for (int grown = 0; grown < height;) {
      filled.wait(grown);
      if (ended) return;
      grown = filled;
      builder.Grow(grown);
    }
  });
  const auto ready = [&](int rows) {
    filled = rows;
    filled.notify_one();
    return !progress || progress(static_cast<double>(rows) / height);
  };
  const base::Status status = set.value()->ReadAll(builder.finest().rgb.data(), ready);
  if (!status) {
    ended = true;
    filled = -1;
    filled.notify_one();
  }
  grower.join();
  if (!status) return status.error();
  return std::make_shared<const Pyramid>(std::move(builder).Finish());
}

base::Result<std::string> ImportPicture(const std::filesystem::path& path) {
  auto bytes = base::ReadText(path, traffic_map::kMaxBytes / 2);
  if (!bytes) return bytes.error();
  auto pixels = DecodePicture(bytes.value());
  if (!pixels) return pixels.error().WithContext(path.string());
  if (traffic_map::ReadPictureInfo(bytes.value())) return bytes;
  const auto& geodata = terrain::SharedGeodata();
  if (!geodata) return geodata.error();
  auto png = geodata.value()->EncodePng(pixels.value().rgb.data(), pixels.value().width_px, pixels.value().height_px);
  if (!png) return base::Failed(png.error().id, png.error().message, path.string());
  return png;
}

}  // namespace rodeira::editor
