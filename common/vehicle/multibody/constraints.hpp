// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/row.hpp"

namespace rodeira::multibody {

// All constraints of a mechanism, Φ(q, t) = 0: scalar rows and constant ties of three components. Multipliers count the
// rows first, then the ties' components. After Bind nothing allocates.
class Constraints {
 public:
  Constraints() = default;
  Constraints(const std::vector<RowDrawing>& rows, const std::vector<Tie>& ties, const std::vector<double>& free);

  // Pairs of entities that a constraint couples.
  void Couples(std::vector<std::pair<int, int>>& couples) const;
  // Once the matrix has been analysed with all pairs of Couples. It allocates.
  void Bind(const BlockLdlt& matrix);

  int count() const { return static_cast<int>(rows_.size() + 3 * ties_.size()); }
  int rows() const { return static_cast<int>(rows_.size()); }
  // Of a multiplier below count(), for messages; place: "file:line" of its constraint.
  const std::string& name(int index) const;
  const std::string& place(int index) const;

  // Finds values and gradients at q; everything below but Bias uses the gradients of the last call.
  void Evaluate(const double* q, double time_s);
  std::span<const double> values() const { return values_; }
  // out = Φq v.
  void Multiply(const double* v, double* out) const;
  // out += Φqᵀ mu; coordinates that cannot move are the caller's to clear.
  void AddTransposed(const double* mu, double* out) const;
  // out = Φ̇q qd + Φ̇t.
  void Bias(const double* q, const double* qd, double time_s, double* out) const;
  // out += Φt.
  void AddTimeRate(double time_s, double* out) const;
  // blocks += weight Φqᵀ Φq, of the rows (which change) and of the ties (which do not).
  void AddRows(double weight, Block* blocks) const;
  // It allocates.
  void AddTies(const BlockLdlt& matrix, double weight, Block* blocks) const;

 private:
  void TieValues(const double* v, double* out) const;

  std::vector<double> free_;
  std::vector<Row> rows_;
  std::vector<Tie> ties_;
  std::vector<Term> tie_terms_;       // of all ties, one after the other
  std::vector<std::size_t> tie_end_;  // of each
  std::vector<std::size_t> first_;    // of each row in gradients_
  std::vector<Triple> gradients_;
  std::vector<std::vector<OuterPair>> pairs_;
  std::vector<double> values_;
};

}  // namespace rodeira::multibody
