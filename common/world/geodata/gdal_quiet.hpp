// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <mutex>
#include <string>

namespace rodeira::terrain::geodata {

// GDAL prints its errors unless told not to; ours carry its words in the sentence.
class QuietGdal {
 public:
  QuietGdal() {
    static std::once_flag once;
    std::call_once(once, [] { GDALAllRegister(); });
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  // GDAL's last error since the constructor, as a part of a sentence; at most 200 characters of it.
  static std::string Words() {
    const std::string words = CPLGetLastErrorMsg();
    return words.empty() ? "GDAL says no more" : fmt::format("GDAL says '{}'", words.substr(0, 200));
  }
};

}  // namespace rodeira::terrain::geodata
