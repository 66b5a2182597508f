// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/tyre_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "common/core/base/files.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/plot/curves.hpp"
#include "common/core/plot/table.hpp"
#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/tyre_file.hpp"

namespace rodeira::cli {
namespace {

using dynamics::TyreForces;
using dynamics::TyreSettings;
using dynamics::TyreSlip;

constexpr double kDegree = geometry::kPi / 180.0;
constexpr std::array kLoads = {0.25, 0.5, 1.0, 1.5};  // over the nominal load
constexpr double kMaxKappa = 0.4, kMaxAngle_deg = 15.0, kMaxCamber_deg = 6.0;
constexpr int kSweepPoints = 161;

struct Peak {
  double slip = 0.0, force_N = 0.0;
};

// The largest of a force over a slip from 0 to 1.
Peak LargestOf(const std::function<double(double)>& force) {
  Peak peak;
  for (int i = 1; i <= 1000; ++i) {
    const double slip = 0.001 * i;
    if (const double now = force(slip); now > peak.force_N) peak = {slip, now};
  }
  return peak;
}

plot::Curve Swept(const std::string& name, double low, double high, const std::function<double(double)>& y) {
  plot::Curve curve{name, {}};
  for (int i = 0; i < kSweepPoints; ++i) {
    const double x = low + (high - low) * i / (kSweepPoints - 1);
    curve.points.emplace_back(x, y(x));
  }
  return curve;
}

std::string LoadName(double load_N) { return fmt::format("{:.0f} N", load_N); }

// Nothing where the file has no aligning moment.
std::vector<plot::Diagram> MomentDiagrams(const dynamics::TyreFile& file) {
  if (!file.aligning) return {};
  const auto moment = [&file](double degrees, double camber_deg, double kappa, double load_N) {
    const TyreSlip slip{kappa, std::tan(degrees * kDegree), camber_deg * kDegree};
    return dynamics::AligningMoment(file.formula, *file.aligning, slip, load_N, 1.0);
  };
  plot::Diagram by_load{"Aligning moment by load", "slip angle in deg", "M_z in N m", {}};
  for (const double share : kLoads) {
    const double load_N = share * file.nominal_N;
    by_load.curves.push_back(
        Swept(LoadName(load_N), -kMaxAngle_deg, kMaxAngle_deg, [&](double x) { return moment(x, 0.0, 0.0, load_N); }));
  }
  plot::Diagram by_camber{"Aligning moment by camber and slip, nominal load", "slip angle in deg", "M_z in N m", {}};
  for (const double degrees : {-kMaxCamber_deg, 0.0, kMaxCamber_deg}) {
    by_camber.curves.push_back(Swept(fmt::format("camber {:g} deg", degrees), -kMaxAngle_deg, kMaxAngle_deg,
                                     [&](double x) { return moment(x, degrees, 0.0, file.nominal_N); }));
  }
  by_camber.curves.push_back(Swept("kappa -0.05", -kMaxAngle_deg, kMaxAngle_deg,
                                   [&](double x) { return moment(x, 0.0, -0.05, file.nominal_N); }));
  return {by_load, by_camber};
}

std::vector<plot::Diagram> Diagrams(const TyreSettings& tyre, const dynamics::TyreFile& file) {
  const double nominal_N = file.nominal_N;
  const auto at = [&](const TyreSlip& slip, double load_N) { return SteadyForces(tyre, slip, load_N, 1.0); };
  const auto angle = [](double degrees) { return std::tan(degrees * kDegree); };
  plot::Diagram fx{"Longitudinal force by load", "slip kappa", "F_x in N", {}};
  plot::Diagram fy{"Side force by load", "slip angle in deg", "F_y in N", {}};
  for (const double share : kLoads) {
    const double load_N = share * nominal_N;
    fx.curves.push_back(Swept(LoadName(load_N), -kMaxKappa, kMaxKappa, [&](double x) {
      return at({x, 0.0, 0.0}, load_N).longitudinal_N;
    }));
    fy.curves.push_back(Swept(LoadName(load_N), -kMaxAngle_deg, kMaxAngle_deg, [&](double x) {
      return at({0.0, angle(x), 0.0}, load_N).lateral_N;
    }));
  }
  plot::Diagram camber{"Side force by camber, nominal load", "slip angle in deg", "F_y in N", {}};
  for (const double degrees : {-kMaxCamber_deg, 0.0, kMaxCamber_deg}) {
    camber.curves.push_back(
        Swept(fmt::format("camber {:g} deg", degrees), -kMaxAngle_deg, kMaxAngle_deg, [&](double x) {
          return at({0.0, angle(x), degrees * kDegree}, nominal_N).lateral_N;
        }));
  }
  plot::Diagram peaks{"Friction by load", "load in N", "largest force over load", {}};
  const double largest_N = 2.0 * nominal_N;
  peaks.curves.push_back(
      Swept("longitudinal", 0.1 * nominal_N, largest_N, [&](double x) { return LongitudinalPeak(tyre, x, 1.0) / x; }));
  peaks.curves.push_back(
      Swept("lateral", 0.1 * nominal_N, largest_N, [&](double x) { return LateralPeak(tyre, x, 1.0) / x; }));
  plot::Diagram combined{"Combined slip, nominal load", "F_x in N", "F_y in N", {}};
  plot::Diagram loss{"Side force under longitudinal slip, nominal load", "slip kappa", "F_y in N", {}};
  for (const double degrees : {1.0, 2.0, 4.0, 8.0, 15.0}) {
    const std::string name = fmt::format("slip angle {:g} deg", degrees);
    plot::Curve loop{name, {}};
    for (int i = 0; i < kSweepPoints; ++i) {
      const double kappa = kMaxKappa * (2.0 * i / (kSweepPoints - 1) - 1.0);
      const TyreForces forces = at({kappa, angle(degrees), 0.0}, nominal_N);
      loop.points.emplace_back(forces.longitudinal_N, forces.lateral_N);
    }
    combined.curves.push_back(std::move(loop));
    loss.curves.push_back(Swept(name, -kMaxKappa, kMaxKappa, [&](double x) {
      return at({x, angle(degrees), 0.0}, nominal_N).lateral_N;
    }));
  }
  std::vector<plot::Diagram> diagrams{fx, fy, camber, peaks, combined, loss};
  const auto moments = MomentDiagrams(file);
  diagrams.insert(diagrams.begin() + 4, moments.begin(), moments.end());
  return diagrams;
}

// Whatever the slips and loads, forces are finite numbers.
base::Status CheckForces(const TyreSettings& tyre, double nominal_N, const std::string& file) {
  for (const double share : {0.01, 0.25, 1.0, 2.0, 4.0}) {
    for (double kappa = -1.0; kappa <= 1.0; kappa += 0.125) {
      for (double alpha = -1.0; alpha <= 1.0; alpha += 0.125) {
        for (const double camber : {-0.1, 0.0, 0.1}) {
          const TyreForces f = SteadyForces(tyre, {kappa, alpha, camber}, share * nominal_N, 1.0);
          if (std::isfinite(f.longitudinal_N) && std::isfinite(f.lateral_N)) continue;
          return base::WrongInput(
              "tyre.not_finite",
              fmt::format("the force is no finite number at slip {:g}, tangent of the slip angle {:g}, camber {:g} rad "
                          "and {:.0f} N",
                          kappa, alpha, camber, share * nominal_N),
              file);
        }
      }
    }
  }
  return {};
}

void PrintTable(const TyreSettings& tyre, const dynamics::TyreFile& file, const std::string& name) {
  fmt::print("{}: {}, nominal load {:.0f} N{}\n", name, file.kind, file.nominal_N,
             file.aligning ? "" : ", no aligning moment");
  fmt::print("  {:>9} {:>14} {:>14} {:>12} {:>10} {:>12} {:>10}\n", "load", "slip stiffness", "corn. stiff.",
             "largest F_x", "at kappa", "largest F_y", "at angle");
  fmt::print("  {:>9} {:>14} {:>14} {:>12} {:>10} {:>12} {:>10}\n", "N", "N", "N/rad", "N", "1", "N", "deg");
  for (const double share : kLoads) {
    const double load_N = share * file.nominal_N;
    const Peak along = LargestOf([&](double x) {
      return SteadyForces(tyre, {x, 0.0, 0.0}, load_N, 1.0).longitudinal_N;
    });
    const Peak across = LargestOf([&](double x) { return -SteadyForces(tyre, {0.0, x, 0.0}, load_N, 1.0).lateral_N; });
    fmt::print("  {:>9.0f} {:>14.0f} {:>14.0f} {:>12.0f} {:>10.3f} {:>12.0f} {:>10.2f}\n", load_N,
               LongitudinalStiffness(tyre, load_N), CorneringStiffness(tyre, load_N), along.force_N, along.slip,
               across.force_N, std::atan(across.slip) / kDegree);
  }
}

// Forces and the aligning moment at random slips, cambers, loads and pressures, the same ones each time: to be compared
// with another program's. The moment is not a number where the file has none.
plot::Table PointTable(TyreSettings tyre, const dynamics::TyreFile& file) {
  const double nominal_N = file.nominal_N;
  constexpr std::uint32_t kTablePoints = 1000, kSeed = 1;
  plot::Table table{
      {"kappa", "tan_alpha", "camber_rad", "load_N", "pressure_Pa", "longitudinal_N", "lateral_N", "aligning_Nm"}, {}};
  const bool is_formula = tyre.model == nullptr;
  const double highest_N = is_formula ? std::min(1.6 * nominal_N, tyre.formula.fzmax) : 1.6 * nominal_N;
  for (std::uint32_t i = 0; i < kTablePoints; ++i) {
    const auto draw = [i](std::uint64_t what, double low, double high) {
      return base::RandomUniform({kSeed, i, what}, low, high);
    };
    const TyreSlip slip{draw(0, -kMaxKappa, kMaxKappa), draw(1, -0.35, 0.35), draw(2, -0.1, 0.1)};
    const double load_N = draw(3, 0.3 * nominal_N, std::max(0.31 * nominal_N, highest_N));
    if (is_formula) tyre.formula.inflpres = tyre.formula.nompres * draw(4, 0.8, 1.25);
    const TyreForces forces = SteadyForces(tyre, slip, load_N, 1.0);
    const double aligning_Nm = file.aligning ? dynamics::AligningMoment(tyre.formula, *file.aligning, slip, load_N, 1.0)
                                             : std::numeric_limits<double>::quiet_NaN();
    for (const double value :
         {slip.kappa, slip.tan_alpha, slip.camber_rad, load_N, is_formula ? tyre.formula.inflpres : 0.0,
          forces.longitudinal_N, forces.lateral_N, aligning_Nm})
      table.values.push_back(value);
  }
  return table;
}

}  // namespace

int Tyre(const VehicleOptions& options) {
  const auto file = dynamics::LoadTyreFile(options.file);
  if (!file) return base::PrintError("rodeira", file.error());
  const dynamics::TyreFile& read = file.value();
  for (const std::string& warning : read.warnings)
    base::Log(base::LogLevel::kWarning, "", fmt::format("{}: {}", options.file, warning));
  TyreSettings tyre;
  tyre.formula = read.formula;
  tyre.model = read.model;
  if (const auto status = CheckForces(tyre, read.nominal_N, options.file); !status)
    return base::PrintError("rodeira", status.error());
  const std::string name = std::filesystem::path(options.file).filename().string();
  if (!options.quiet) PrintTable(tyre, read, name);
  if (!options.csv.empty()) {
    if (const auto status = base::WriteWhole(options.csv, plot::ToCsv(PointTable(tyre, read))); !status)
      return base::PrintError("rodeira", status.error());
    if (!options.quiet) fmt::print("wrote {}\n", options.csv);
  }
  if (options.svg.empty()) return 0;
  const std::string title = fmt::format("{} ({}), friction 1", name, read.kind);
  if (const auto status = base::WriteWhole(options.svg, plot::ToSvg(Diagrams(tyre, read), title)); !status)
    return base::PrintError("rodeira", status.error());
  if (!options.quiet) fmt::print("wrote {}\n", options.svg);
  return 0;
}

}  // namespace rodeira::cli
