// SPDX-License-Identifier: Apache-2.0
// Linked into a program of a test, which then says by its environment that it is of another build:
// PRETEND_TYPE="TOPIC|OLD|NEW", PRETEND_MATHEMATICS=anything.
#include <cstdlib>
#include <string>

#include "common/runtime/dds/hello_change.hpp"
#include "tests/system/change_type.hpp"

namespace rodeira::system_test {
namespace {

[[maybe_unused]] const bool kPretends = [] {
  dds::HelloChange& change = dds::ChangeOfHellos();
  if (const char* type = std::getenv("PRETEND_TYPE"))
    change.type = [what = std::string(type)](std::vector<idl::TopicText>& topics) { ChangeType(what, topics); };
  if (const char* mathematics = std::getenv("PRETEND_MATHEMATICS")) change.mathematics = base::Hash(mathematics);
  return true;
}();

}  // namespace
}  // namespace rodeira::system_test
