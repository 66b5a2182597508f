// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tyre_file.hpp"

#include "common/core/base/files.hpp"
#include "common/vehicle/dynamics/chrono_tyre.hpp"
#include "common/vehicle/dynamics/fiala_file.hpp"
#include "common/vehicle/dynamics/tir_file.hpp"
#include "common/vehicle/dynamics/tir_text.hpp"
#include "common/vehicle/dynamics/tir_version.hpp"

namespace rodeira::dynamics {
namespace {

constexpr std::size_t kMaxTyreFileBytes = 1u << 20;
constexpr double kFialaNominal_N = 4000.0;  // its files name no nominal load

bool IsJson(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return begin != std::string_view::npos && (text[begin] == '{' || text.substr(begin, 2) == "//");
}

}  // namespace

base::Result<TyreFile> ParseTyreFile(std::string_view text, std::string_view name) {
  if (IsJson(text)) {
    auto tyre = ReadChronoTyre(text, name);
    if (!tyre) return tyre.error();
    ChronoTyre& t = tyre.value();
    return TyreFile{{}, std::move(t.model), std::nullopt, std::move(t.kind), t.nominal_N, std::move(t.warnings)};
  }
  const TirText tir = SplitTir(text);
  const auto version = FindTirVersion(tir, name);
  if (!version) return version.error();
  if (version.value().model == TirVersion::Model::kFiala) {
    const auto fiala = ReadFialaTir(tir, name);
    if (!fiala) return fiala.error();
    return TyreFile{{}, std::make_shared<FialaTyre>(fiala.value()), std::nullopt, version.value().name, kFialaNominal_N,
                    {}};
  }
  auto file = ReadTir(tir, version.value(), name);
  if (!file) return file.error();
  TirFile& t = file.value();
  return TyreFile{
      t.formula, nullptr, t.aligning, std::move(t.version), t.formula.fnomin * t.formula.lfzo, std::move(t.warnings)};
}

base::Result<TyreFile> LoadTyreFile(const std::filesystem::path& path) {
  const auto text = base::ReadText(path, kMaxTyreFileBytes);
  if (!text) return text.error();
  return ParseTyreFile(text.value(), path.string());
}

}  // namespace rodeira::dynamics
