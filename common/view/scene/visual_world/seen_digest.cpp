// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/seen_digest.hpp"

#include <fmt/format.h>

#include <map>

#include "common/core/base/append_format.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_markings/road_paint.hpp"
#include "common/view/scene/visual_world/ground_digest.hpp"
#include "common/world/network/marking.hpp"

namespace rodeira::scene {

base::Digest SeenDigest(const road::World& world) {
  base::Digest digest =
      base::Combine(base::Combine(base::Hash(kGroundVersion), world.content_hash()), PicturesDigest(world));
  if (world.network() == nullptr) return digest;
  std::map<std::string, std::size_t> pictures;  // by the number of their first place
  for (const terrain::LaidPicture& picture : PicturesOf(world)) pictures.try_emplace(picture.file, pictures.size());
  std::vector<TilePaint> paint(world.network()->roads().size());
  for (const network::Placed& placed : network::PlaceFurniture(*world.network()).things)
    PaintThing(*world.network(), placed, paint[placed.road]);
  std::size_t index = 0;
  for (const network::Road& road : world.network()->roads()) {
    std::string marks;
    for (const network::Marking& mark : network::MarkingsOf(road)) {
      base::AppendFormat(marks, "{} {} {} {} {} {} {} {} {} {}\n", mark.section, mark.lane, mark.from_s_m, mark.to_s_m,
                         mark.t_offset_m, mark.width_m, mark.stroke_m, mark.gap_m, mark.first_m, mark.colour);
      if (mark.sway == nullptr) continue;
      for (const geometry::Cubic& cubic : mark.sway->records())
        base::AppendFormat(marks, "{} {} {} {} {}\n", cubic.from, cubic.a, cubic.b, cubic.c, cubic.d);
    }
    for (const network::LaneSection& section : road.spec().sections) {
      for (const auto* side : {&section.left, &section.right}) {
        for (const network::Lane& lane : *side) {
          for (const network::LaneMaterial& material : lane.materials) {
            if (const auto picture = PictureOf(material))
              base::AppendFormat(marks, "{} {} {}\n", lane.id, pictures.at(picture->file), picture->width_m);
          }
        }
      }
    }
    digest = base::Combine(digest, base::Hash(marks));
    digest = base::Combine(digest, PaintDigest(paint[index++]));
  }
  const StaticObjects things(world);
  for (const auto& [key, tile] : things.tiles())
    digest = base::Combine(digest,
                           base::Combine(base::Hash(fmt::format("{} {}", key.column, key.row)), things.DigestOf(key)));
  return digest;
}

}  // namespace rodeira::scene
