// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/surface_command.hpp"

#include <fmt/format.h>

#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/world/surface/crg_report.hpp"

namespace rodeira::cli {

int Surface(const SurfaceOptions& options) {
  const auto file = surface::LoadCrg(options.file);
  if (!file) return base::PrintError("rodeira", file.error());
  fmt::print("file             {}\n{}", options.file, surface::DescribeCrg(file.value()));
  if (options.svg.empty()) return 0;
  if (const auto written = base::WriteWhole(options.svg, surface::PlotCrg(*file.value().surface)); !written) {
    return base::PrintError("rodeira", written.error());
  }
  fmt::print("wrote            {}\n", options.svg);
  return 0;
}

}  // namespace rodeira::cli
