// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/mechanism.hpp"

#include "common/core/base/files.hpp"
#include "common/vehicle/multibody/mechanism_schema.hpp"

namespace rodeira::multibody {
namespace {

base::Result<Mechanism> Read(config::File& file, const SystemSettings& settings) {
  const config::Map root = file.root();
  (void)config::DeclaredMap(root, MechanismSchema().keys).Word("rodeira");
  const DrawingReader reader(root);
  root.IgnoreKey("outputs");
  if (const auto status = file.Finish(); !status) return status.error();
  auto system = System::Make(reader.drawing(), settings);
  if (!system) return system.error();
  Mechanism mechanism{std::move(system).value(), {}};
  mechanism.outputs = ReadOutputs(root, reader, *mechanism.system);
  if (const auto status = file.Finish(); !status) return status.error();
  if (const auto status = mechanism.system->Start(); !status) return status.error();
  return mechanism;
}

}  // namespace

base::Result<Mechanism> LoadMechanism(const std::filesystem::path& path, const SystemSettings& settings) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  return Read(file.value(), settings);
}

base::Result<Mechanism> ParseMechanism(std::string_view text, const std::filesystem::path& name,
                                       const SystemSettings& settings) {
  auto file = config::File::Parse(text, name);
  if (!file) return file.error();
  return Read(file.value(), settings);
}

}  // namespace rodeira::multibody
