// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/encoding.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <utility>

namespace rodeira::opendrive {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kBlank = " \t\r\n";

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

struct Encoding {
  std::string_view mark;  // the first bytes
  const char* name;       // for iconv
  std::size_t unit, mark_size;
};
// The longer marks first. The last four are the '<' of a text without a byte order mark.
constexpr std::array<Encoding, 8> kWide = {{{"\xff\xfe\0\0"sv, "UTF-32LE", 4, 4},
                                            {"\0\0\xfe\xff"sv, "UTF-32BE", 4, 4},
                                            {"\xff\xfe"sv, "UTF-16LE", 2, 2},
                                            {"\xfe\xff"sv, "UTF-16BE", 2, 2},
                                            {"<\0\0\0"sv, "UTF-32LE", 4, 0},
                                            {"\0\0\0<"sv, "UTF-32BE", 4, 0},
                                            {"<\0"sv, "UTF-16LE", 2, 0},
                                            {"\0<"sv, "UTF-16BE", 2, 0}}};

// Where the declaration's encoding stands, from begin to end; the same where none is named.
std::pair<std::size_t, std::size_t> NamedEncoding(std::string_view text) {
  if (!text.starts_with("<?xml")) return {0, 0};
  const std::string_view declaration = text.substr(0, std::min(text.size(), text.find("?>")));
  const std::size_t key = declaration.find("encoding");
  if (key == std::string_view::npos) return {0, 0};
  const std::size_t open = declaration.find_first_of("\"'", key);
  if (open == std::string_view::npos) return {0, 0};
  const std::size_t close = declaration.find(declaration[open], open + 1);
  return close == std::string_view::npos ? std::pair<std::size_t, std::size_t>{0, 0} : std::pair(open + 1, close);
}

base::Result<std::string> Convert(std::string_view bytes, const std::string& from, std::size_t unit,
                                  const std::filesystem::path& path) {
  const iconv_t converter = ::iconv_open("UTF-8", from.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1))
    return base::WrongInput("opendrive.wrong_encoding",
                            fmt::format("the encoding '{}' is unknown; UTF-8 was expected", from),
                            path.string() + ":1");
  std::string text;
  std::array<char, 1 << 14> buffer;
  char* in = const_cast<char*>(bytes.data());
  std::size_t left = bytes.size();
  while (true) {
    char* out = buffer.data();
    std::size_t space = buffer.size();
    const std::size_t done = ::iconv(converter, left == 0 ? nullptr : &in, &left, &out, &space);
    const int problem = errno;
    text.append(buffer.data(), buffer.size() - space);
    if (done != static_cast<std::size_t>(-1)) {
      if (left == 0) break;
      continue;
    }
    if (problem == E2BIG) continue;
    const std::size_t skipped = std::min(unit, left);  // no character, or one that is cut off
    in += skipped, left -= skipped;
    text += "\xef\xbf\xbd";
    if (left == 0) break;
  }
  ::iconv_close(converter);
  return text;
}

base::Result<std::string> Declared(base::Result<std::string> text) {
  if (!text) return text;
  const auto [begin, end] = NamedEncoding(text.value());
  if (begin != end) text.value().replace(begin, end - begin, "UTF-8");
  return text;
}

}  // namespace

base::Result<std::string> ToUtf8(std::string bytes, const std::filesystem::path& path) {
  for (const Encoding& wide : kWide) {
    if (std::string_view(bytes).starts_with(wide.mark))
      return Declared(Convert(std::string_view(bytes).substr(wide.mark_size), wide.name, wide.unit, path));
  }
  const bool is_ascii =
      std::all_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<signed char>(c) >= 0; });
  const auto [begin, end] = NamedEncoding(bytes);
  const std::string named = bytes.substr(begin, end - begin), lower = Lower(named);
  // A text with a declaration that is read byte by byte is in none of the wide ones.
  for (const std::string_view none : {"", "utf-8", "utf8", "us-ascii", "ascii"}) {
    if (lower == none) return bytes;
  }
  if (is_ascii || lower.starts_with("utf") || lower.starts_with("ucs") || lower.starts_with("iso-10646")) return bytes;
  return Declared(Convert(bytes, named, 1, path));
}

base::Status LooksLikeXml(const std::string& text, const std::filesystem::path& path) {
  std::string_view begin = text;
  if (begin.starts_with("\xef\xbb\xbf")) begin.remove_prefix(3);
  begin.remove_prefix(std::min(begin.size(), begin.find_first_not_of(kBlank)));
  if (begin.empty() || begin.find_first_not_of("\0 \t\r\n"sv) == std::string_view::npos)
    return base::WrongInput("file.empty", "the file is empty; an OpenDRIVE file (XML) was expected", path.string());
  const std::string start = Lower(begin.substr(0, 64));
  if (start.starts_with("<!doctype html") || start.starts_with("<html"))
    return base::WrongInput(
        "opendrive.not_xml",
        "this is a page of the web (HTML), not the file that it shows; OpenDRIVE was expected: download the file "
        "itself ('raw')",
        path.string());
  if (start.starts_with("version https://git-lfs"))
    return base::WrongInput("opendrive.not_xml",
                            "this is a Git LFS pointer, not the file itself, which `git lfs pull` fetches",
                            path.string());
  if (!begin.starts_with('<')) {
    std::string found(begin.substr(0, 20));
    std::replace_if(
        found.begin(), found.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
    const bool is_text = std::all_of(found.begin(), found.end(), [](char c) { return c >= ' ' && c <= '~'; });
    return base::WrongInput("opendrive.not_xml",
                            is_text ? fmt::format("this is no XML: it begins with '{}'; OpenDRIVE was expected", found)
                                    : "this is no XML: it begins with other bytes than '<'; OpenDRIVE was expected",
                            path.string());
  }
  return {};
}

}  // namespace rodeira::opendrive
