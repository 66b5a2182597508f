// SPDX-License-Identifier: Apache-2.0
// The IDL files, compiled by the compiler of another DDS (CycloneDDS).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::idl {
namespace {

namespace fs = std::filesystem;
using system_test::RunCommand;

class Compilers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (RunCommand({"/usr/bin/env", "idlc", "-v"}).status != 0)
      GTEST_SKIP() << "CycloneDDS's IDL compiler idlc is missing (package cyclonedds-tools)";
    for (const auto& entry : fs::directory_iterator(SourceDir() + "/idl")) {
      if (entry.path().extension() == ".idl") files_.insert(entry.path());
    }
    ASSERT_GE(files_.size(), 15u);
  }
  // The generated C of a file. Anything that the compiler says is a failure. The folder is always the same: its name is
  // in the include guards.
  std::string Compile(const fs::path& file, const std::string& default_extensibility) const {
    const fs::path out = folder_.path() / "out";
    fs::remove_all(out);
    fs::create_directories(out);
    const auto ended = RunCommand({"/usr/bin/env", "idlc", "-x", default_extensibility, "-I", SourceDir() + "/idl",
                                   "-o", out.string(), file.string()});
    EXPECT_EQ(ended.status, 0) << file << ": " << ended.out;
    EXPECT_EQ(ended.out, "") << file;
    std::string text;
    for (const char* extension : {".h", ".c"}) {
      const auto made = base::ReadText(out / file.stem().concat(extension));
      EXPECT_TRUE(made.ok()) << file;
      if (made.ok()) text += made.value();
    }
    return text;
  }
  std::set<fs::path> files_;
  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("rodeira-idl").value();
};

// XTypes' default is appendable, this compiler's is final: a marked type is the same to every reader.
TEST_F(Compilers, EveryFileMeansTheSameWhateverTheDefaultExtensibility) {
  ASSERT_FALSE(files_.empty());
  for (const fs::path& file : files_) {
    EXPECT_TRUE(Compile(file, "final") == Compile(file, "appendable")) << file;
  }
  const fs::path unmarked = folder_.path() / "unmarked.idl";
  ASSERT_TRUE(base::WriteWhole(unmarked, std::string_view("module m { struct A { long x; }; };\n")).ok());
  EXPECT_FALSE(Compile(unmarked, "final") == Compile(unmarked, "appendable")) << "the test sees a type without a mark";
}

TEST_F(Compilers, AllFilesGoTogether) {
  std::string all;
  for (const fs::path& file : files_) all += fmt::format("#include \"{}\"\n", file.filename().string());
  const fs::path file = folder_.path() / "all.idl";
  ASSERT_TRUE(base::WriteWhole(file, all).ok());
  EXPECT_NE(Compile(file, "final"), "");
}

}  // namespace
}  // namespace rodeira::idl
