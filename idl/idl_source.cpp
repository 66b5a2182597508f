// SPDX-License-Identifier: Apache-2.0
#include "idl/idl_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "idl/topics.hpp"

namespace rodeira::idl {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kJoined = "joined";
constexpr std::string_view kHeaderSubject = "sample_header";
constexpr std::size_t kMaxIncludes = 100;

// What stands behind '#'; none if the line is not a preprocessor line.
std::optional<std::string_view> Directive(std::string_view line) {
  const std::size_t sign = line.find_first_not_of(" \t\r");
  if (sign == std::string_view::npos || line[sign] != '#') return std::nullopt;
  line.remove_prefix(sign + 1);
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  return line;
}

std::string_view FirstWord(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\"<")); }

// The file of an include line; none if the line is another one.
std::optional<std::string> IncludedFile(std::string_view directive) {
  if (FirstWord(directive) != "include") return std::nullopt;
  const std::size_t begin = directive.find('"');
  const std::size_t end = begin == std::string_view::npos ? begin : directive.find('"', begin + 1);
  return end == std::string_view::npos ? std::string() : std::string(directive.substr(begin + 1, end - begin - 1));
}

template <class Use>
void ForEachLine(std::string_view text, const Use& use) {
  for (std::size_t at = 0, number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!use(text.substr(at, end - at), number)) return;
    at = end + 1;
  }
}

// The sample header as the texts of the other subjects hold it.
std::string_view HeaderText() {
  std::string_view text = IdlTextOf(kHeaderSubject);
  if (text.starts_with("// SPDX")) text.remove_prefix(std::min(text.find('\n') + 1, text.size()));
  return text;
}

struct Registered {
  std::string name;
  std::string text;
};
std::vector<Registered>& CompiledFiles() {
  static std::vector<Registered> files;
  return files;
}

std::map<std::string, decode::TypePtr> ReadCompiled() {
  std::map<std::string, decode::TypePtr> types;
  const auto read = [](const fs::path& path) -> base::Result<std::string> {
    const auto found = std::ranges::find(CompiledFiles(), path.string(), &Registered::name);
    if (found == CompiledFiles().end()) return base::WrongInput("file.not_found", "not compiled in", path.string());
    return found->text;
  };
  for (const Registered& file : CompiledFiles()) {
    const auto source = IdlSource::Read(file.name, read);
    if (!source) continue;
    const auto parsed = decode::IdlTypes::Read(source.value().text(), file.name);
    if (parsed) types.insert(parsed.value().types().begin(), parsed.value().types().end());
  }
  return types;
}

}  // namespace

class IdlJoiner {
 public:
  explicit IdlJoiner(const IdlSource::ReadFile& read) : read_(read) {}

  base::Status Add(const fs::path& path) {
    if (!seen_.insert(path.lexically_normal().string()).second) return {};
    auto text = read_(path);
    if (!text) return text.error();
    return AddText(path, text.value());
  }
  IdlSource source() && { return std::move(source_); }

 private:
  base::Status AddText(const fs::path& path, std::string_view text) {
    const std::size_t file = source_.files_.size();
    source_.files_.push_back(path.string());
    base::Status status;
    ForEachLine(text, [&](std::string_view line, std::size_t number) {
      const auto directive = Directive(line);
      if (directive) {
        status = Follow(path, number, *directive);
      } else {
        source_.text_.append(line).push_back('\n');
        source_.lines_.push_back({file, number});
      }
      return status.ok();
    });
    return status;
  }
  base::Status Follow(const fs::path& path, std::size_t number, std::string_view directive) {
    const std::string place = fmt::format("{}:{}", path.string(), number);
    const auto included = IncludedFile(directive);
    if (!included) {
      const std::string_view word = FirstWord(directive);
      if (word == "ifndef" || word == "define" || word == "endif" || word == "pragma") return {};
      return base::WrongInput(
          "message.wrong_idl",
          fmt::format("'#{}' was found; of the preprocessor's lines only includes and include guards are read", word),
          place);
    }
    if (included->empty()) return base::WrongInput("message.wrong_idl", "#include \"FILE\" was expected", place);
    if (fs::path(*included).is_absolute())
      return base::WrongInput("message.wrong_idl",
                              fmt::format("'{}' was found; a path relative to this file was expected", *included),
                              place);
    if (source_.files_.size() > kMaxIncludes)
      return base::WrongInput("message.too_many_includes", fmt::format("more than {} files are included", kMaxIncludes),
                              place);
    const fs::path beside = path.parent_path() / *included;
    if (read_(beside).ok()) return Add(beside);
    for (const IdlText& own : IdlTexts()) {
      if (own.subject + ".idl" == *included) return AddOwn(own);
    }
    return base::WrongInput(
        "file.not_found",
        fmt::format("cannot open '{}': no such file beside this one, nor in Rodeira's IDL", *included), place);
  }
  // Rodeira's texts hold the sample header; it stands in the joined text once.
  base::Status AddOwn(const IdlText& own) {
    if (!seen_.insert(own.subject).second) return {};
    const std::string header(HeaderText());
    if (own.subject == kHeaderSubject) return AddText(own.subject + ".idl", header);
    std::string text = own.text;
    const std::size_t at = text.find(header);
    if (at != std::string::npos) {
      text.erase(at, header.size());
      if (seen_.insert(std::string(kHeaderSubject)).second) {
        if (auto status = AddText(std::string(kHeaderSubject) + ".idl", header); !status) return status;
      }
    }
    return AddText(own.subject + ".idl", text);
  }

  const IdlSource::ReadFile& read_;
  std::set<std::string> seen_;
  IdlSource source_;
};

base::Result<IdlSource> IdlSource::Read(const fs::path& path) {
  return Read(path, [](const fs::path& file) { return base::ReadText(file, 1u << 20); });
}

base::Result<IdlSource> IdlSource::Read(const fs::path& path, const ReadFile& read) {
  IdlJoiner joiner(read);
  if (auto status = joiner.Add(path); !status) return status.error();
  return std::move(joiner).source();
}

base::Result<decode::TypePtr> IdlSource::Find(const std::string& name) const {
  const auto types = decode::IdlTypes::Read(text_, kJoined);
  if (!types) {
    base::Error error = types.error();
    std::size_t line = 0;
    const char* end = error.context.data() + error.context.size();
    const std::size_t skip = kJoined.size() + 1;
    if (error.context.size() > skip && std::from_chars(error.context.data() + skip, end, line).ec == std::errc() &&
        !lines_.empty()) {
      const Line& from = lines_[std::clamp<std::size_t>(line, 1, lines_.size()) - 1];
      error.context = fmt::format("{}:{}", files_[from.file], from.number);
    }
    return error;
  }
  auto type = types.value().Find(name);
  if (!type) return type.error().WithContext(files_.front());
  return type;
}

std::vector<std::string> IncludesOf(std::string_view text) {
  std::vector<std::string> names;
  ForEachLine(text, [&](std::string_view line, std::size_t) {
    const auto directive = Directive(line);
    auto name = directive ? IncludedFile(*directive) : std::nullopt;
    if (name && !name->empty()) names.push_back(std::move(*name));
    return true;
  });
  return names;
}

CompiledIdl::CompiledIdl(const char* name, const char* text) { CompiledFiles().push_back({name, text}); }

decode::TypePtr CompiledType(const std::string& name) {
  static const std::map<std::string, decode::TypePtr> kTypes = ReadCompiled();
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? nullptr : found->second;
}

}  // namespace rodeira::idl
