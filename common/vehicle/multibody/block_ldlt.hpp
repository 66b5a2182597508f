// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace rodeira::multibody {

// A 3 × 3 block, column after column, each padded to four rows so that two of them fit a register. The fourth row is 0.
struct alignas(16) Block {
  std::array<double, 12> v{};

  // Row and column from 0 to 2.
  double& At(int row, int column) { return v[4 * column + row]; }
  double At(int row, int column) const { return v[4 * column + row]; }
};

// A gradient's three components and a zero.
struct alignas(16) Triple {
  std::array<double, 4> v{};
};

// A sparse symmetric positive definite matrix of 3 × 3 blocks, one block row an entity, and its factorisation L D Lᵀ.
// Analyse orders the blocks (approximate minimum degree) and finds the pattern of L once; afterwards nothing allocates.
// The values live where L will stand: they are filled in, Factorise replaces them, Solve uses the result.
class BlockLdlt {
 public:
  // Where the block of two entities stands: values()[block], its row belonging to the one of later order.
  struct Place {
    int block = 0;
    bool flipped = false;  // the first of the two asked is the column
  };

  // `free`: the entities that have a block row, each once. `couples`: pairs of them with a block that may be other than
  // zero.
  void Analyse(int entities, std::span<const int> free, std::span<const std::pair<int, int>> couples);
  // Whether the entity has a block row.
  bool IsFree(int entity) const { return position_[static_cast<std::size_t>(entity)] >= 0; }
  // Precondition: both have a block row, and they are one entity or a pair that Analyse was told.
  Place Find(int first, int second) const;

  std::vector<Block>& values() { return values_; }
  // False where a pivot is not positive: the matrix is singular, or not finite.
  [[nodiscard]] bool Factorise();
  // x = A⁻¹ b; both hold three numbers an entity and may be the same; those of entities without a block row stay as
  // they are.
  void Solve(const double* b, double* x);

  int blocks() const { return static_cast<int>(order_.size()); }
  int blocks_of_l() const { return static_cast<int>(rows_.size()); }
  int updates() const { return static_cast<int>(targets_.size()); }

 private:
  struct Pivot {  // of a 3 × 3 diagonal block: unit lower triangle and inverse diagonal
    double l10, l20, l21, i0, i1, i2;
  };
  [[nodiscard]] bool Pivoted(const Block& diagonal, Pivot& pivot) const;

  std::vector<int> order_;     // entity at each position
  std::vector<int> position_;  // of each entity, -1 without
  std::vector<int> start_;     // of each column in rows_; one more than columns
  std::vector<int> rows_;      // positions below the diagonal, ascending within a column
  std::vector<int> targets_;   // blocks that the elimination of each column changes, in its order
  std::vector<Block> values_;  // the diagonal, then the columns of L
  std::vector<Pivot> pivots_;
  std::vector<Block> column_;  // one column before its division
  std::vector<Triple> x_;
};

// Adds weight · gₐ g_bᵀ to blocks: what a scalar with gradient g adds to a normal matrix.
struct OuterPair {
  int block = 0;
  int row = 0;     // which of the gradients stands for the row …
  int column = 0;  // … and for the column
};
// All pairs of the entities, each once and each with itself. Every pair must have a block (Find).
std::vector<OuterPair> OuterPairs(const BlockLdlt& matrix, std::span<const int> entities);
// `gradients`: one an entity, in the order given to OuterPairs.
void AddOuter(std::span<const OuterPair> pairs, const Triple* gradients, double weight, Block* blocks);

}  // namespace rodeira::multibody
