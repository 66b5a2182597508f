// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::traffic_map {

// A line without its line end, beginning with its letter; the error is a sentence without a place.
template <class Value>
base::Result<Value> ReadLine(std::string_view line);
template <>
base::Result<Curve> ReadLine(std::string_view line);
template <>
base::Result<Lane> ReadLine(std::string_view line);
template <>
base::Result<Connection> ReadLine(std::string_view line);
template <>
base::Result<Scale> ReadLine(std::string_view line);

// The line, with LF at its end.
std::string LineText(const Curve& curve);
std::string LineText(const Lane& lane);
std::string LineText(const Connection& connection);
std::string LineText(const Scale& scale);

// Without "\n" or "\r\n" at its end.
std::string_view WithoutLineEnd(std::string_view line);

}  // namespace rodeira::traffic_map
