// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/graphics/graphics.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/core/base/installation.hpp"
#include "common/core/base/open_error.hpp"
#include "common/core/base/print_error.hpp"

namespace rodeira::cli {
namespace {

std::optional<Graphics> g_graphics;
char** g_arguments = nullptr;

std::string GraphicsProgram() { return base::FindProgram("rodeira-graphics").string(); }

}  // namespace

void UseGraphics(Graphics graphics) { g_graphics = std::move(graphics); }
const Graphics* RegisteredGraphics() { return g_graphics ? &*g_graphics : nullptr; }

void KeepArguments(int, char** argv) { g_arguments = argv; }

bool CanContinueInGraphics() {
  return !g_graphics && g_arguments != nullptr && ::access(GraphicsProgram().c_str(), X_OK) == 0;
}

std::string WhyNoGraphics() {
  return base::IsInstalled() ? "the package rodeira is not installed (apt install rodeira)"
                             : "built without the view (RODEIRA_VIEW=OFF)";
}

int ContinueInGraphics(const std::string& command) {
  const std::string program = GraphicsProgram();
  int problem = ENOTSUP;
  if (!g_graphics && g_arguments != nullptr) {
    std::fflush(nullptr);
    ::execv(program.c_str(), g_arguments);
    problem = errno;
  }
  return base::PrintError("rodeira", base::OpenError(fmt::format("the program {} is needed ({})", program,
                                                                 base::IsInstalled() ? "apt install rodeira"
                                                                                     : "build with RODEIRA_VIEW=ON"),
                                                     problem, command));
}

bool ReadsDevice(const launch::LaunchNode& node) {
  if (node.kind->name != "input") return false;
  const auto source = node.config->Peek({"config", "source"});
  return source == "joystick" || source == "gamepad";
}

bool NeedsGraphics(const launch::Launch& launch) {
  return std::ranges::any_of(
      launch.nodes(), [](const launch::LaunchNode& node) { return node.kind->name == "view" || ReadsDevice(node); });
}

}  // namespace rodeira::cli
