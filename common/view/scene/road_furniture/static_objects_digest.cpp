// SPDX-License-Identifier: Apache-2.0
// What the things of a tile are made from, as a hash.

#include <set>

#include "common/core/base/append_format.hpp"
#include "common/core/base/files.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"

namespace rodeira::scene {

base::Digest StaticObjects::DigestOf(const TileKey& key) const {
  const auto found = tiles_.find(key);
  if (found == tiles_.end()) return 0;
  std::string text = "things 1\n";
  std::set<std::string> files;
  const auto put = [&text](const Eigen::Vector3d& p) { base::AppendFormat(text, "{} {} {} ", p.x(), p.y(), p.z()); };
  for (const Thing& thing : found->second.things) {
    if (!thing.file.empty() && files.insert(thing.file).second) {
      const auto bytes = base::ReadText(thing.file);
      text += thing.file + (bytes ? base::Hex(base::Hash(bytes.value())) : "missing") + "\n";
    }
    if (!thing.file.empty()) text += thing.file;
    put(thing.stand.foot_W);
    base::AppendFormat(text, "{} {} {} {} {} {} {} {} {} {} {} {} {}-{}-{} {}", static_cast<int>(thing.kind),
                       thing.stand.x_W.x(), thing.stand.x_W.y(), thing.above_m, thing.length_m, thing.width_m,
                       thing.height_m, thing.radius_m, thing.face, thing.both_sides, thing.on_post, thing.closed,
                       thing.colour.red, thing.colour.green, thing.colour.blue, thing.feet_W.size());
    for (std::size_t i = 0; i < thing.feet_W.size(); ++i)
      put(thing.feet_W[i]), base::AppendFormat(text, "{} ", thing.heights_m[i]);
    if (thing.kind == ThingKind::kBar) {
      for (const double half : thing.heights_m) base::AppendFormat(text, "{} ", half);
    }
    if (thing.top) base::AppendFormat(text, "{}-{}-{}", thing.top->red, thing.top->green, thing.top->blue);
    text += '\n';
  }
  for (const RailPiece& piece : found->second.rails) {
    for (std::size_t k = 0; k < 2; ++k) {
      put(piece.foot_W[k]);
      base::AppendFormat(text, "{} {} {} {} {}\n", piece.left_W[k].x(), piece.left_W[k].y(), piece.height_m[k],
                         piece.width_m[k], piece.wall);
    }
  }
  for (const network::TubePiece& piece : found->second.tubes) {
    for (std::size_t end = 0; end < 2; ++end) {
      put(piece.right_W[end]), put(piece.left_W[end]);
      base::AppendFormat(text, "tube {} {} {} {}\n", piece.ceiling_m[end], piece.portal[end], piece.right_wall,
                         piece.left_wall);
    }
  }
  return base::Hash(text);
}

}  // namespace rodeira::scene
