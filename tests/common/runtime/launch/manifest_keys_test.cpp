// SPDX-License-Identifier: Apache-2.0
// The keys of a manifest, each in generated files.
#include "common/runtime/launch/manifest_schema.hpp"

#include <gtest/gtest.h>

#include "common/runtime/launch/manifest.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::launch {
namespace {

TEST(ManifestKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const cli::TemporaryFolder folder;
  folder.Write("gaze.idl",
               "#include \"sample_header.idl\"\nmodule lab {\n  @final\n  struct Gaze {\n"
               "    rodeira::msg::SampleHeader header;\n  };\n};\n");
  const auto problem = [&](const std::string& text) -> std::string {
    const auto manifest = ReadManifest(folder.Write("eye.yaml", text));
    return manifest ? "" : manifest.error().Text();
  };
  const config::Values own{
      {"outputs[].topic", "lab/gaze"}, {"outputs[].type", "\"lab::Gaze\""}, {"outputs[].idl", "gaze.idl"}};
  config::ExpectEveryKey(ManifestSchema(), problem, {{"outputs[].type", own}, {"outputs[].idl", own}});
}

}  // namespace
}  // namespace rodeira::launch
