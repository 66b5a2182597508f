// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::measures {

// Reads some numbers out of the messages of one type, without visiting the others: for recordings of millions of
// messages. The members up to the last one that is read are numbers, and structs and arrays of them; then one sequence
// of such structs may follow.
class MessageFields {
 public:
  // fields: paths from the message ("position_w_m.x"). sequence: a member of the message, or empty; row_fields: paths
  // from its elements. The type must outlive this. Wrong input where the type has none of that name.
  static base::Result<MessageFields> Make(const decode::Type& type, const std::vector<std::string>& fields,
                                          std::string_view sequence = {},
                                          const std::vector<std::string>& row_fields = {});

  // Reads one message (CDR version 1): `out` gets the fields in their order, `row` is called with those of each
  // element. False where the bytes are no such message.
  bool Read(std::span<const std::byte> payload, std::span<double> out,
            const std::function<void(std::span<const double>)>& row = {}) const;

 private:
  struct Step {
    decode::Kind kind = decode::Kind::kDouble;
    std::size_t bytes = 0;
    int slot = -1;  // below 0: passed over
  };
  static bool AddSteps(const decode::Type& type, const std::string& path, const std::vector<std::string>& fields,
                       std::string_view stop_before, std::vector<Step>& steps);

  std::vector<Step> steps_, row_steps_;
  std::size_t row_size_ = 0;
  bool has_rows_ = false;
};

}  // namespace rodeira::measures
