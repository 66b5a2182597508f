// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/constraints.hpp"

namespace rodeira::multibody {

Constraints::Constraints(const std::vector<RowDrawing>& rows, const std::vector<Tie>& ties,
                         const std::vector<double>& free)
    : free_(free), ties_(ties) {
  std::size_t first = 0;
  for (const RowDrawing& drawing : rows) {
    rows_.emplace_back(drawing, free);
    first_.push_back(first);
    first += rows_.back().entities().size();
  }
  gradients_.resize(first);
  for (const Tie& tie : ties_) {
    tie_terms_.insert(tie_terms_.end(), tie.terms.begin(), tie.terms.end());
    tie_end_.push_back(tie_terms_.size());
  }
  values_.assign(static_cast<std::size_t>(count()), 0.0);
}

void Constraints::Couples(std::vector<std::pair<int, int>>& couples) const {
  const auto all = [&couples](const std::vector<int>& entities) {
    for (const int a : entities) {
      for (const int b : entities) {
        if (a < b) couples.emplace_back(a, b);
      }
    }
  };
  for (const Row& row : rows_) all(row.entities());
  for (const Tie& tie : ties_) {
    std::vector<int> entities;
    for (const Term& term : tie.terms) entities.push_back(term.entity);
    all(entities);
  }
}

void Constraints::Bind(const BlockLdlt& matrix) {
  pairs_.clear();
  for (const Row& row : rows_) pairs_.push_back(OuterPairs(matrix, row.entities()));
}

const std::string& Constraints::name(int index) const {
  const auto i = static_cast<std::size_t>(index);
  return i < rows_.size() ? rows_[i].name() : ties_[(i - rows_.size()) / 3].name;
}

const std::string& Constraints::place(int index) const {
  const auto i = static_cast<std::size_t>(index);
  return i < rows_.size() ? rows_[i].place() : ties_[(i - rows_.size()) / 3].place;
}

void Constraints::Evaluate(const double* q, double time_s) {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    values_[i] = rows_[i].Evaluate(q, time_s, gradients_.data() + first_[i]);
  double* out = values_.data() + rows_.size();
  TieValues(q, out);
}

void Constraints::TieValues(const double* v, double* out) const {
  const Term* term = tie_terms_.data();
  for (const std::size_t end : tie_end_) {
    double x = 0.0, y = 0.0, z = 0.0;
    for (const Term* last = tie_terms_.data() + end; term != last; ++term) {
      const double* e = v + 3 * term->entity;
      x += term->a * e[0] - term->b * e[1];
      y += term->a * e[1] + term->b * e[0];
      z += term->a * e[2];
    }
    out[0] = x;
    out[1] = y;
    out[2] = z;
    out += 3;
  }
}

void Constraints::Multiply(const double* v, double* out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Triple* g = gradients_.data() + first_[i];
    double sum = 0.0;
    for (const int entity : rows_[i].entities()) {
      const double* e = v + 3 * entity;
      sum += g->v[0] * e[0] + g->v[1] * e[1] + g->v[2] * e[2];
      ++g;
    }
    *out++ = sum;
  }
  TieValues(v, out);
}

void Constraints::AddTransposed(const double* mu, double* out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Triple* g = gradients_.data() + first_[i];
    for (const int entity : rows_[i].entities()) {
      double* e = out + 3 * entity;
      e[0] += g->v[0] * mu[i];
      e[1] += g->v[1] * mu[i];
      e[2] += g->v[2] * mu[i];
      ++g;
    }
  }
  const double* f = mu + rows_.size();
  const Term* term = tie_terms_.data();
  for (const std::size_t end : tie_end_) {
    for (const Term* last = tie_terms_.data() + end; term != last; ++term) {
      double* e = out + 3 * term->entity;
      e[0] += term->a * f[0] + term->b * f[1];
      e[1] += term->a * f[1] - term->b * f[0];
      e[2] += term->a * f[2];
    }
    f += 3;
  }
}

void Constraints::Bias(const double* q, const double* qd, double time_s, double* out) const {
  for (const Row& row : rows_) *out++ = row.Bias(q, qd, time_s);
  for (std::size_t i = 0; i < 3 * ties_.size(); ++i) *out++ = 0.0;
}

void Constraints::AddTimeRate(double time_s, double* out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) out[i] += rows_[i].TimeRate(time_s);
}

void Constraints::AddRows(double weight, Block* blocks) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) AddOuter(pairs_[i], gradients_.data() + first_[i], weight, blocks);
}

void Constraints::AddTies(const BlockLdlt& matrix, double weight, Block* blocks) const {
  for (const Tie& tie : ties_) {
    std::vector<int> entities;
    std::vector<Term> terms;
    for (const Term& term : tie.terms) {
      if (!matrix.IsFree(term.entity)) continue;
      entities.push_back(term.entity);
      terms.push_back(term);
    }
    const std::vector<OuterPair> pairs = OuterPairs(matrix, entities);
    for (int component = 0; component < 3; ++component) {
      std::vector<Triple> gradients;
      for (const Term& term : terms) {
        const Vector3d g = Transposed(term, Vector3d::Unit(component))
                               .cwiseProduct(Eigen::Map<const Vector3d>(free_.data() + 3 * term.entity));
        gradients.push_back({{g.x(), g.y(), g.z(), 0.0}});
      }
      AddOuter(pairs, gradients.data(), weight, blocks);
    }
  }
}

}  // namespace rodeira::multibody
