// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/terrain_mesh.hpp"

#include <algorithm>

namespace rodeira::scene {
namespace {

constexpr int kTileCells = 32;
constexpr std::array<float, kTerrainLevels> kLevelRange_m = {450.0F, 1'300.0F, 1e9F};  // from the tile's edge
constexpr std::array<int, kTerrainLevels> kStrides = {1, 2, 8};                        // cells a block, level by level

struct Span {  // of cells: [from, to)
  int from;
  int to;
};

// Makes one level of one tile.
class TileTessellator {
 public:
  TileTessellator(const Lattice& lattice, Span columns, Span rows, int stride, Mesh& mesh)
      : lattice_(lattice),
        columns_(columns),
        rows_(rows),
        stride_(stride),
        mesh_(mesh),
        indices_(static_cast<std::size_t>((columns.to - columns.from + 1) * (rows.to - rows.from + 1)), kNone) {}

  void Weave() {
    for (int column = columns_.from; column < columns_.to; column += stride_) {
      for (int row = rows_.from; row < rows_.to; row += stride_) Block(column, row);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  bool IsKnown(int column, int row) const {
    return lattice_.IsKnown(column, row) && lattice_.IsKnown(column + 1, row) && lattice_.IsKnown(column, row + 1) &&
           lattice_.IsKnown(column + 1, row + 1);
  }

  // A block drawn cell by cell: it is small, or a void is near.
  bool IsFine(int column, int row) const {
    if (stride_ == 1 || column + stride_ > columns_.to || row + stride_ > rows_.to) return true;
    for (int c = column; c < column + stride_; ++c) {
      for (int r = row; r < row + stride_; ++r) {
        if (!IsKnown(c, r)) return true;
      }
    }
    return false;
  }
  // Whether a coarse block must show every post on its side towards the block at (column, row).
  bool NeedsPosts(int column, int row) const {
    if (column < columns_.from || column >= columns_.to || row < rows_.from || row >= rows_.to)
      return true;  // the tile's edge
    return IsFine(column, row);
  }

  std::uint32_t Post(int column, int row) {
    std::uint32_t& index =
        indices_[static_cast<std::size_t>((column - columns_.from) * (rows_.to - rows_.from + 1) + row - rows_.from)];
    if (index == kNone) {
      const Lattice::Sample post = lattice_.Post(column, row);
      index = mesh_.Add(post.p_W, post.normal_W, post.colour);
    }
    return index;
  }

  void Block(int column, int row) {
    if (IsFine(column, row)) {
      for (int c = column; c < std::min(column + stride_, columns_.to); ++c) {
        for (int r = row; r < std::min(row + stride_, rows_.to); ++r) Cell(c, r);
      }
      return;
    }
    // A fan around the middle, over posts counter-clockwise from the south-west.
    std::vector<std::uint32_t> ring;
    const auto side = [&](int c, int r, int dc, int dr, bool every) {
      for (int k = 0; k < stride_; k += every ? 1 : stride_) ring.push_back(Post(c + k * dc, r + k * dr));
    };
    const int s = stride_;
    side(column, row, 1, 0, NeedsPosts(column, row - s));
    side(column + s, row, 0, 1, NeedsPosts(column + s, row));
    side(column + s, row + s, -1, 0, NeedsPosts(column, row + s));
    side(column, row + s, 0, -1, NeedsPosts(column - s, row));
    const std::uint32_t middle = Post(column + s / 2, row + s / 2);
    for (std::size_t k = 0; k < ring.size(); ++k) mesh_.AddTriangle(middle, ring[k], ring[(k + 1) % ring.size()]);
  }

  void Cell(int column, int row) {
    const std::array<std::array<Eigen::Vector2i, 3>, 2> halves = {{
        {Eigen::Vector2i(column, row), Eigen::Vector2i(column + 1, row), Eigen::Vector2i(column, row + 1)},
        {Eigen::Vector2i(column + 1, row), Eigen::Vector2i(column + 1, row + 1), Eigen::Vector2i(column, row + 1)},
    }};
    for (const auto& half : halves) {
      bool known = true;
      for (const Eigen::Vector2i& post : half) known = known && lattice_.IsKnown(post.x(), post.y());
      if (!known) continue;
      mesh_.AddTriangle(Post(half[0].x(), half[0].y()), Post(half[1].x(), half[1].y()), Post(half[2].x(), half[2].y()));
    }
  }

  const Lattice& lattice_;
  Span columns_, rows_;
  int stride_;
  Mesh& mesh_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace

float TerrainSeen_m(const TerrainTile& tile, std::size_t level) {
  return kLevelRange_m[level] + static_cast<float>(tile.radius_m);
}

std::vector<TerrainTile> BuildTerrain(const Lattice& lattice) {
  std::vector<TerrainTile> tiles;
  for (int column = 0; column < lattice.columns() - 1; column += kTileCells) {
    for (int row = 0; row < lattice.rows() - 1; row += kTileCells) {
      const Span columns{column, std::min(column + kTileCells, lattice.columns() - 1)};
      const Span rows{row, std::min(row + kTileCells, lattice.rows() - 1)};
      TerrainTile tile;
      tile.column = column / kTileCells, tile.row = row / kTileCells;
      const Eigen::Vector3d low = lattice.Post(columns.from, rows.from).p_W,
                            high = lattice.Post(columns.to, rows.to).p_W;
      const Eigen::Vector3d origin = OriginNear(0.5 * (low + high));
      for (std::size_t level = 0; level < kTerrainLevels; ++level) {
        Mesh& mesh = tile.levels[level];
        mesh.material = lattice.material();
        mesh.origin_W = origin;
        TileTessellator(lattice, columns, rows, kStrides[level], mesh).Weave();
        // Where voids lie all over the tile, larger blocks may spare nothing.
        if (level > 0 && mesh.triangle_count() >= tile.levels[level - 1].triangle_count())
          mesh = tile.levels[level - 1];
      }
      const Mesh& finest = tile.levels[0];
      if (finest.triangles.empty()) continue;
      Eigen::Vector3f least = finest.positions[0], most = finest.positions[0];
      for (const Eigen::Vector3f& p : finest.positions) {
        least = least.cwiseMin(p);
        most = most.cwiseMax(p);
      }
      tile.centre_W = origin + (0.5F * (least + most)).cast<double>();
      tile.radius_m = 0.5 * static_cast<double>((most - least).norm());
      tiles.push_back(std::move(tile));
    }
  }
  return tiles;
}

}  // namespace rodeira::scene
