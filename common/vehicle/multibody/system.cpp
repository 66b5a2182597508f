// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::multibody {

namespace {

// Two numbers of a row, wherever they stand. What the registers do with them is what one after the other would give.
using UnalignedPair = double __attribute__((vector_size(16), aligned(8), may_alias));
using Bits = long long __attribute__((vector_size(16)));

}  // namespace

double LargestOf(std::span<const double> values) {
  constexpr Bits kWithoutSign = {0x7fffffffffffffffLL, 0x7fffffffffffffffLL};
  UnalignedPair first{}, second{}, nothing{};  // the last stays 0 unless something is not finite
  const std::size_t even = values.size() / 4 * 4;
  for (std::size_t i = 0; i < even; i += 4) {
    const UnalignedPair a = reinterpret_cast<UnalignedPair>(
        reinterpret_cast<Bits>(*reinterpret_cast<const UnalignedPair*>(values.data() + i)) & kWithoutSign);
    const UnalignedPair b = reinterpret_cast<UnalignedPair>(
        reinterpret_cast<Bits>(*reinterpret_cast<const UnalignedPair*>(values.data() + i + 2)) & kWithoutSign);
    first = a > first ? a : first;
    second = b > second ? b : second;
    nothing += 0.0 * a + 0.0 * b;
  }
  double most = std::max({first[0], first[1], second[0], second[1]});
  double none = nothing[0] + nothing[1];
  for (std::size_t i = even; i < values.size(); ++i) {
    most = std::max(most, std::fabs(values[i]));
    none += 0.0 * values[i];
  }
  return none == 0.0 ? most : std::numeric_limits<double>::infinity();
}

System::System(const Drawing& drawing, const SystemSettings& settings) : drawing_(drawing), settings_(settings) {}

base::Result<std::unique_ptr<System>> System::Make(const Drawing& drawing, const SystemSettings& settings) {
  std::unique_ptr<System> system(new System(drawing, settings));
  if (auto status = system->Compile(); !status) return status.error();
  return system;
}

base::Status System::Compile() {
  std::vector<RowDrawing> rows;
  for (std::size_t i = 0; i < drawing_.entities.size(); ++i) {
    const EntityDrawing& entity = drawing_.entities[i];
    bool moves = false;
    for (int c = 0; c < 3; ++c) {
      const bool free = !entity.fixed[static_cast<std::size_t>(c)] && !(entity.is_scalar() && c > 0);
      free_.push_back(free ? 1.0 : 0.0);
      moves = moves || free;
      q_.push_back(entity.at[c]);
    }
    const int index = static_cast<int>(i);
    if (moves) free_entities_.push_back(index);
    const bool tied = std::any_of(drawing_.bodies.begin(), drawing_.bodies.end(), [index](const BodyParts& body) {
      return std::any_of(body.ties.begin(), body.ties.end(), [index](const Tie& tie) { return tie.vector == index; });
    });
    if (entity.kind == EntityKind::kVector && moves && !tied) {
      RowDrawing unit;
      unit.name = entity.name + " (unit)";
      unit.place = entity.place;
      unit.v = unit.w = Single(index);
      unit.value = 1.0;
      unit.scale = 0.5;
      unit.keeps_length = true;
      rows.push_back(unit);
    }
  }
  if (free_entities_.empty())
    return base::WrongInput("mechanism.nothing_moves", "nothing can move: every coordinate is fixed", drawing_.place);
  std::vector<Tie> ties;
  for (std::size_t b = 0; b < drawing_.bodies.size(); ++b) {
    const BodyParts& body = drawing_.bodies[b];
    // What an earlier body keeps rigid already (a hinge's two points, shared axes) needs no second row.
    const auto kept = [this, b](const RowDrawing& row) {
      const Form both = Sum(row.v, row.w);
      return std::any_of(drawing_.bodies.begin(), drawing_.bodies.begin() + static_cast<std::ptrdiff_t>(b),
                         [&both](const BodyParts& other) {
                           return std::all_of(both.terms.begin(), both.terms.end(), [&other](const Term& term) {
                             return std::find(other.entities.begin(), other.entities.end(), term.entity) !=
                                    other.entities.end();
                           });
                         });
    };
    for (const RowDrawing& row : body.rows) {
      if (!kept(row)) rows.push_back(row);
    }
    ties.insert(ties.end(), body.ties.begin(), body.ties.end());
  }
  rows.insert(rows.end(), drawing_.rows.begin(), drawing_.rows.end());
  // Bodies that share two points or vectors keep the same length: once is enough. A row between fixed entities says
  // nothing.
  std::vector<RowDrawing> different;
  for (const RowDrawing& row : rows) {
    if (Row(row, free_).entities().empty()) continue;
    const bool known =
        row.kind == RowKind::kDot && std::any_of(different.begin(), different.end(), [&row](const RowDrawing& other) {
          const auto same = [](const Form& a, const Form& b) {
            for (const Term& term : Sum(a, b, -1.0).terms) {
              if (term.a != 0.0 || term.b != 0.0) return false;
            }
            return true;
          };
          const auto opposite = [&same](const Form& a, const Form& b) { return same(a, Sum(Form{}, b, -1.0)); };
          return other.kind == RowKind::kDot &&
                 ((same(row.v, other.v) && same(row.w, other.w)) || (same(row.v, other.w) && same(row.w, other.v)) ||
                  (opposite(row.v, other.v) && opposite(row.w, other.w)));
        });
    if (!known) different.push_back(row);
  }
  std::erase_if(ties, [this](const Tie& tie) {
    return std::none_of(tie.terms.begin(), tie.terms.end(), [this](const Term& term) {
      return free_[static_cast<std::size_t>(3 * term.entity)] + free_[static_cast<std::size_t>(3 * term.entity + 1)] +
                 free_[static_cast<std::size_t>(3 * term.entity + 2)] >
             0.0;
    });
  });
  double shortest_m = 1.0;
  for (const RowDrawing& row : different) {
    if (row.keeps_length) shortest_m = std::min(shortest_m, std::sqrt(row.value));
  }
  stale_m_ = settings_.stale / settings_.penalty * shortest_m;
  constraints_ = Constraints(different, ties, free_);

  const std::size_t size = q_.size();
  for (auto* each :
       {&qd_, &qdd_, &q0_, &qd0_, &qdd0_, &earlier_, &earlier0_, &way_, &forces_, &residual_, &change_, &weight_force_})
    each->assign(size, 0.0);
  lambda_.assign(static_cast<std::size_t>(constraints_.count()), 0.0);
  mu_.assign(lambda_.size(), 0.0);
  lambda0_.assign(lambda_.size(), 0.0);
  bias_.assign(lambda_.size(), 0.0);
  nu_.assign(lambda_.size(), 0.0);
  reactions_.assign(lambda_.size(), 0.0);
  return CompileMass();
}

base::Status System::CompileMass() {
  std::vector<std::pair<int, int>> couples;
  constraints_.Couples(couples);
  for (const BodyParts& body : drawing_.bodies) {
    for (const MassTerm& term : body.mass) {
      mass_.push_back(term);
      if (term.row != term.column) couples.emplace_back(term.row, term.column);
    }
  }
  for (std::size_t i = 0; i < drawing_.entities.size(); ++i) {
    if (drawing_.entities[i].inertia > 0.0)
      mass_.push_back({static_cast<int>(i), static_cast<int>(i), drawing_.entities[i].inertia, 0.0});
  }
  for (const NamedLoad& named : drawing_.loads) {
    const std::vector<int> stiffens = named.load->Stiffens();
    for (const int a : stiffens) {
      for (const int b : stiffens) {
        if (a < b) couples.emplace_back(a, b);
      }
    }
  }
  matrix_.Analyse(entities(), free_entities_, couples);
  constraints_.Bind(matrix_);
  BindLoads();

  // Terms between fixed entities move nothing; those of a fixed and a free one neither, as the fixed one has no
  // acceleration.
  std::erase_if(mass_,
                [this](const MassTerm& term) { return !matrix_.IsFree(term.row) || !matrix_.IsFree(term.column); });
  double largest = 0.0;
  constant_.assign(matrix_.values().size(), Block{});
  for (const MassTerm& term : mass_) {
    const BlockLdlt::Place place = matrix_.Find(term.row, term.column);
    Block& block = constant_[static_cast<std::size_t>(place.block)];
    const double* row_free = free_.data() + 3 * term.row;
    const double* column_free = free_.data() + 3 * term.column;
    const auto add = [&](int r, int c, double value) {
      value *= row_free[r] * column_free[c];
      if (place.flipped)
        block.At(c, r) += value;
      else
        block.At(r, c) += value;
    };
    for (int c = 0; c < 3; ++c) add(c, c, term.a);
    add(0, 1, -term.b);
    add(1, 0, term.b);
  }
  for (const int entity : free_entities_) {
    const Block& block = constant_[static_cast<std::size_t>(matrix_.Find(entity, entity).block)];
    for (int c = 0; c < 3; ++c) largest = std::max(largest, block.At(c, c));
  }
  if (!(largest > 0.0)) return base::WrongInput("mechanism.no_mass", "nothing that can move has mass", drawing_.place);
  weight_ = settings_.penalty * largest;
  for (const int entity : free_entities_) {
    Block& block = constant_[static_cast<std::size_t>(matrix_.Find(entity, entity).block)];
    for (int c = 0; c < 3; ++c) {
      if (free_[static_cast<std::size_t>(3 * entity + c)] == 0.0) block.At(c, c) = largest;
    }
  }
  constraints_.AddTies(matrix_, weight_, constant_.data());
  for (const BodyParts& body : drawing_.bodies)
    Push(body.centre, body.mass_kg * drawing_.gravity_mps2, weight_force_.data());
  return {};
}

void System::BindLoads() {
  for (const NamedLoad& named : drawing_.loads) {
    std::vector<int> entities;
    for (const int entity : named.load->Stiffens()) {
      if (matrix_.IsFree(entity) && std::find(entities.begin(), entities.end(), entity) == entities.end())
        entities.push_back(entity);
    }
    std::vector<Vector3d> free;
    for (const int entity : entities) free.push_back(Eigen::Map<const Vector3d>(free_.data() + 3 * entity));
    named.load->Bind(entities, OuterPairs(matrix_, entities), free);
  }
}

int System::variables() const { return static_cast<int>(std::count(free_.begin(), free_.end(), 1.0)); }

void System::MultiplyMass(const double* v, double* out) const {
  for (const MassTerm& term : mass_) {
    const double* x = v + 3 * term.column;
    double* y = out + 3 * term.row;
    for (int c = 0; c < 3; ++c) y[c] += term.a * x[c];
    if (term.row != term.column) {
      const double* xr = v + 3 * term.row;
      double* yr = out + 3 * term.column;
      for (int c = 0; c < 3; ++c) yr[c] += term.a * xr[c];
      if (term.b != 0.0) {
        yr[0] += term.b * xr[1];
        yr[1] -= term.b * xr[0];
      }
    }
    if (term.b != 0.0) {
      y[0] -= term.b * x[1];
      y[1] += term.b * x[0];
    }
  }
}

void System::Mask(double* v) const {
  for (std::size_t i = 0; i < free_.size(); ++i) v[i] *= free_[i];
}

// What is not a number makes the maximum infinite.
double System::FreeMaximum(const double* v) const { return LargestOf({v, free_.size()}); }

void System::SumForces(Block* matrix, double stiffness_factor, double damping_factor) {
  std::copy(weight_force_.begin(), weight_force_.end(), forces_.begin());
  Sink sink(forces_.data(), matrix, stiffness_factor, damping_factor);
  const Motion now = motion();
  for (const NamedLoad& named : drawing_.loads) named.load->Add(now, sink);
}

double System::KineticEnergy() const {
  double energy = 0.0;
  for (const MassTerm& term : mass_) {
    const double* x = qd_.data() + 3 * term.column;
    const double* y = qd_.data() + 3 * term.row;
    const double product = term.a * (x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) + term.b * (y[1] * x[0] - y[0] * x[1]);
    energy += term.row == term.column ? 0.5 * product : product;
  }
  return energy;
}

double System::PotentialEnergy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < q_.size(); ++i) energy -= weight_force_[i] * q_[i];
  const Motion now = motion();
  for (const NamedLoad& named : drawing_.loads) energy += named.load->Energy(now);
  return energy;
}

double System::Violation() {
  constraints_.Evaluate(q_.data(), time_s_);
  return LargestOf(constraints_.values());
}

double System::RateViolation() {
  constraints_.Evaluate(q_.data(), time_s_);
  constraints_.Multiply(qd_.data(), mu_.data());
  constraints_.AddTimeRate(time_s_, mu_.data());
  return LargestOf(mu_);
}

void System::Save(base::StateWriter& writer) const {
  writer.Put("time_s", time_s_);
  writer.Put("q", q_);
  writer.Put("qd", qd_);
  writer.Put("qdd", qdd_);
  writer.Put("lambda", lambda_);
  writer.Put("earlier", earlier_);
  writer.Put("earlier_s", earlier_s_);
  writer.Put("contraction", newton_.rate);
}

void System::Restore(base::StateReader& reader) {
  reader.Get("time_s", time_s_);
  reader.Get("q", std::span<double>(q_));
  reader.Get("qd", std::span<double>(qd_));
  reader.Get("qdd", std::span<double>(qdd_));
  reader.Get("lambda", std::span<double>(lambda_));
  reactions_ = lambda_;
  reader.Get("earlier", std::span<double>(earlier_));
  reader.Get("earlier_s", earlier_s_);
  reader.Get("contraction", newton_.rate);
}

}  // namespace rodeira::multibody
