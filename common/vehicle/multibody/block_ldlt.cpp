// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/block_ldlt.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <set>

#include "common/core/base/assert.hpp"

namespace rodeira::multibody {
namespace {

using LanePair = double __attribute__((vector_size(16), may_alias));

const LanePair* Lanes(const double* v) { return reinterpret_cast<const LanePair*>(v); }
LanePair* Lanes(double* v) { return reinterpret_cast<LanePair*>(v); }

// target -= x wᵀ
inline void Subtract(const Block& x, const Block& w, Block& target) {
  const LanePair* a = Lanes(x.v.data());
  LanePair* t = Lanes(target.v.data());
  for (int c = 0; c < 3; ++c) {
    const double w0 = w.v[c], w1 = w.v[4 + c], w2 = w.v[8 + c];
    t[2 * c] -= a[0] * w0 + a[2] * w1 + a[4] * w2;
    t[2 * c + 1] -= a[1] * w0 + a[3] * w1 + a[5] * w2;
  }
}

std::vector<int> MinimumDegree(int count, const std::set<std::pair<int, int>>& couples) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [a, b] : couples) {
    entries.emplace_back(a, b, 1.0);
    entries.emplace_back(b, a, 1.0);
  }
  Eigen::SparseMatrix<double> pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = permutation.indices()[i];
  return order;
}

}  // namespace

void BlockLdlt::Analyse(int entities, std::span<const int> free, std::span<const std::pair<int, int>> couples) {
  const int count = static_cast<int>(free.size());
  std::vector<int> number(static_cast<std::size_t>(entities), -1);
  for (int i = 0; i < count; ++i) number[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] = i;
  std::set<std::pair<int, int>> pattern;
  for (const auto& [a, b] : couples) {
    const int i = number[static_cast<std::size_t>(a)];
    const int j = number[static_cast<std::size_t>(b)];
    if (i >= 0 && j >= 0 && i != j) pattern.emplace(std::min(i, j), std::max(i, j));
  }
  const std::vector<int> order = MinimumDegree(count, pattern);
  order_.clear();
  position_.assign(static_cast<std::size_t>(entities), -1);
  for (const int i : order) {
    position_[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] = static_cast<int>(order_.size());
    order_.push_back(free[static_cast<std::size_t>(i)]);
  }
  // Pattern of L: a column has its own rows and those of the columns with it as first row.
  std::vector<std::set<int>> below(static_cast<std::size_t>(count));
  for (const auto& [i, j] : pattern) {
    const int p = position_[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])];
    const int r = position_[static_cast<std::size_t>(free[static_cast<std::size_t>(j)])];
    below[static_cast<std::size_t>(std::min(p, r))].insert(std::max(p, r));
  }
  start_.assign(1, 0);
  rows_.clear();
  for (int j = 0; j < count; ++j) {
    const auto& rows = below[static_cast<std::size_t>(j)];
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    start_.push_back(static_cast<int>(rows_.size()));
    if (rows.empty()) continue;
    const int parent = *rows.begin();
    for (const int row : rows) {
      if (row != parent) below[static_cast<std::size_t>(parent)].insert(row);
    }
  }
  values_.assign(static_cast<std::size_t>(count) + rows_.size(), Block{});
  pivots_.resize(static_cast<std::size_t>(count));
  x_.assign(static_cast<std::size_t>(count), Triple{});
  std::size_t longest = 0;
  targets_.clear();
  for (int j = 0; j < count; ++j) {
    const std::span<const int> rows(rows_.data() + start_[static_cast<std::size_t>(j)],
                                    rows_.data() + start_[static_cast<std::size_t>(j) + 1]);
    longest = std::max(longest, rows.size());
    for (std::size_t a = 0; a < rows.size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        targets_.push_back(
            Find(order_[static_cast<std::size_t>(rows[a])], order_[static_cast<std::size_t>(rows[b])]).block);
      }
    }
  }
  column_.assign(longest, Block{});
}

BlockLdlt::Place BlockLdlt::Find(int first, int second) const {
  const int p = position_[static_cast<std::size_t>(first)];
  const int r = position_[static_cast<std::size_t>(second)];
  RODEIRA_ASSERT(p >= 0 && r >= 0);
  if (p == r) return {p, false};
  const int column = std::min(p, r);
  const auto begin = rows_.begin() + start_[static_cast<std::size_t>(column)];
  const auto end = rows_.begin() + start_[static_cast<std::size_t>(column) + 1];
  const auto found = std::lower_bound(begin, end, std::max(p, r));
  RODEIRA_ASSERT(found != end && *found == std::max(p, r));
  return {static_cast<int>(order_.size()) + static_cast<int>(found - rows_.begin()), p < r};
}

bool BlockLdlt::Pivoted(const Block& d, Pivot& pivot) const {
  const double d0 = d.At(0, 0);
  if (!(d0 > 0.0)) return false;
  pivot.i0 = 1.0 / d0;
  pivot.l10 = d.At(1, 0) * pivot.i0;
  pivot.l20 = d.At(2, 0) * pivot.i0;
  const double d1 = d.At(1, 1) - pivot.l10 * d.At(1, 0);
  if (!(d1 > 0.0)) return false;
  pivot.i1 = 1.0 / d1;
  const double d21 = d.At(2, 1) - pivot.l20 * d.At(1, 0);
  pivot.l21 = d21 * pivot.i1;
  const double d2 = d.At(2, 2) - pivot.l20 * d.At(2, 0) - pivot.l21 * d21;
  if (!(d2 > 0.0)) return false;
  pivot.i2 = 1.0 / d2;
  return std::isfinite(pivot.i0) && std::isfinite(pivot.i1) && std::isfinite(pivot.i2);
}

bool BlockLdlt::Factorise() {
  const int count = blocks();
  Block* diagonal = values_.data();
  Block* below = values_.data() + count;
  const int* target = targets_.data();
  for (int j = 0; j < count; ++j) {
    Pivot& p = pivots_[static_cast<std::size_t>(j)];
    if (!Pivoted(diagonal[j], p)) return false;
    const int first = start_[static_cast<std::size_t>(j)];
    const int size = start_[static_cast<std::size_t>(j) + 1] - first;
    Block* column = below + first;
    for (int a = 0; a < size; ++a) {
      column_[static_cast<std::size_t>(a)] = column[a];
      LanePair* x = Lanes(column[a].v.data());  // X = W D⁻¹, by columns
      for (int lane = 0; lane < 2; ++lane) {
        const LanePair w0 = x[lane];
        const LanePair w1 = x[2 + lane] - w0 * p.l10;
        const LanePair w2 = x[4 + lane] - w0 * p.l20 - w1 * p.l21;
        const LanePair x2 = w2 * p.i2;
        const LanePair x1 = w1 * p.i1 - x2 * p.l21;
        x[4 + lane] = x2;
        x[2 + lane] = x1;
        x[lane] = w0 * p.i0 - x1 * p.l10 - x2 * p.l20;
      }
    }
    for (int a = 0; a < size; ++a) {
      for (int b = 0; b <= a; ++b)
        Subtract(column[a], column_[static_cast<std::size_t>(b)], values_[static_cast<std::size_t>(*target++)]);
    }
  }
  return true;
}

void BlockLdlt::Solve(const double* b, double* x) {
  const int count = blocks();
  const Block* below = values_.data() + count;
  for (int j = 0; j < count; ++j) {
    const double* from = b + 3 * order_[static_cast<std::size_t>(j)];
    x_[static_cast<std::size_t>(j)].v = {from[0], from[1], from[2], 0.0};
  }
  for (int j = 0; j < count; ++j) {
    const auto& xj = x_[static_cast<std::size_t>(j)].v;
    for (int k = start_[static_cast<std::size_t>(j)]; k < start_[static_cast<std::size_t>(j) + 1]; ++k) {
      const LanePair* l = Lanes(below[k].v.data());
      LanePair* xi = Lanes(x_[static_cast<std::size_t>(rows_[static_cast<std::size_t>(k)])].v.data());
      xi[0] -= l[0] * xj[0] + l[2] * xj[1] + l[4] * xj[2];
      xi[1] -= l[1] * xj[0] + l[3] * xj[1] + l[5] * xj[2];
    }
  }
  for (int j = count - 1; j >= 0; --j) {
    const Pivot& p = pivots_[static_cast<std::size_t>(j)];
    auto& xj = x_[static_cast<std::size_t>(j)].v;
    const double w1 = xj[1] - p.l10 * xj[0];
    const double w2 = xj[2] - p.l20 * xj[0] - p.l21 * w1;
    const double y2 = w2 * p.i2;
    const double y1 = w1 * p.i1 - p.l21 * y2;
    const double y0 = xj[0] * p.i0 - p.l10 * y1 - p.l20 * y2;
    LanePair s0{}, s1{}, s2{};  // columns of L times x, two lanes each until the end
    for (int k = start_[static_cast<std::size_t>(j)]; k < start_[static_cast<std::size_t>(j) + 1]; ++k) {
      const LanePair* l = Lanes(below[k].v.data());
      const LanePair* xi = Lanes(x_[static_cast<std::size_t>(rows_[static_cast<std::size_t>(k)])].v.data());
      s0 += l[0] * xi[0] + l[1] * xi[1];
      s1 += l[2] * xi[0] + l[3] * xi[1];
      s2 += l[4] * xi[0] + l[5] * xi[1];
    }
    xj = {y0 - (s0[0] + s0[1]), y1 - (s1[0] + s1[1]), y2 - (s2[0] + s2[1]), 0.0};
    double* to = x + 3 * order_[static_cast<std::size_t>(j)];
    for (std::size_t c = 0; c < 3; ++c) to[c] = xj[c];
  }
}

std::vector<OuterPair> OuterPairs(const BlockLdlt& matrix, std::span<const int> entities) {
  std::vector<OuterPair> pairs;
  for (int a = 0; a < static_cast<int>(entities.size()); ++a) {
    for (int b = 0; b <= a; ++b) {
      const BlockLdlt::Place place =
          matrix.Find(entities[static_cast<std::size_t>(a)], entities[static_cast<std::size_t>(b)]);
      pairs.push_back(place.flipped ? OuterPair{place.block, b, a} : OuterPair{place.block, a, b});
    }
  }
  return pairs;
}

void AddOuter(std::span<const OuterPair> pairs, const Triple* gradients, double weight, Block* blocks) {
  for (const OuterPair& pair : pairs) {
    const LanePair* row = Lanes(gradients[pair.row].v.data());
    const auto& column = gradients[pair.column].v;
    LanePair* block = Lanes(blocks[pair.block].v.data());
    for (int c = 0; c < 3; ++c) {
      const double w = weight * column[static_cast<std::size_t>(c)];
      block[2 * c] += row[0] * w;
      block[2 * c + 1] += row[1] * w;
    }
  }
}

}  // namespace rodeira::multibody
