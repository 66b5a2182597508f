// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace rodeira::traffic_map {

// What the first bytes of a picture say of it.
struct PictureInfo {
  std::string_view kind;  // "PNG" or "JPEG"
  int width_px = 0;       // both at least 1
  int height_px = 0;
  bool fits = true;  // so many pixels can be packed into so few bytes
  bool ends = true;  // what every such file ends with is there: the chunk IEND, the marker EOI
};

// Nothing where the bytes are no PNG (ISO/IEC 15948) or JPEG (ITU-T T.81) file, or end before they say their size.
std::optional<PictureInfo> ReadPictureInfo(std::string_view bytes);

}  // namespace rodeira::traffic_map
