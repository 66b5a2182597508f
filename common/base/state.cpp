#include "common/base/state.hpp"

#include <fmt/format.h>

namespace rodeira::base {

void StateWriter::Name(std::string_view name, std::size_t size) {
  if (names_ == Names::kWithout) return;
  out_.PutString(name);
  out_.Put(static_cast<std::uint32_t>(size));
}

bool StateReader::ExpectName(std::string_view name) {
  if (!problem_.empty()) return false;
  const std::string found = in_.GetString();
  size_ = in_.Get<std::uint32_t>();
  if (!in_.ok()) {
    Fail(name, "the end of the snapshot");
    return false;
  }
  if (found != name) {
    Fail(name, "field '" + found.substr(0, 64) + "'");
    return false;
  }
  return true;
}

bool StateReader::Expect(std::string_view name, std::size_t size) {
  if (!ExpectName(name)) return false;
  if (size_ != size) {
    Fail(name, fmt::format("{} bytes, not {}", size_, size));
    return false;
  }
  return true;
}

void StateReader::Fail(std::string_view name, std::string_view found) {
  if (problem_.empty()) problem_ = fmt::format("state field '{}' was expected, found {}", name, found);
}

Status StateReader::Finish() const {
  if (!problem_.empty()) return WrongInput(problem_);
  if (!in_.ok()) return WrongInput("the snapshot ends within a field");
  if (in_.remaining() != 0) return WrongInput(fmt::format("{} bytes are left over after the last state field", in_.remaining()));
  return {};
}

}  // namespace rodeira::base
