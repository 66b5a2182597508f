// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/exhaustion.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "common/core/base/exhaustion_text.hpp"

namespace rodeira::base {
namespace {

std::string g_program;
std::terminate_handler g_other = nullptr;

[[noreturn]] void OnTerminate() {
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      EndExhausted(kNoMemoryText);
    } catch (const std::system_error& error) {
      if (error.code() == std::errc::resource_unavailable_try_again) EndExhausted(kNoThreadText);
    } catch (...) {
    }
  }
  g_other();
  std::abort();
}

}  // namespace

void EndExhausted(std::string_view sentence) {
  // Without memory of the heap, of which there may be none left.
  constexpr std::string_view kRecording = "; `rodeira repair` completes a recording that was being written\n";
  for (const std::string_view part : {std::string_view(g_program), std::string_view(": "), sentence, kRecording}) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, part.data(), part.size());
  }
  ::_exit(1);
}

void NameExhaustion(std::string_view program) {
  g_program = program;
  g_other = std::set_terminate(OnTerminate);
}

}  // namespace rodeira::base
