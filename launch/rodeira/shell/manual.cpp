// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/shell/manual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace rodeira::cli {
namespace {

// Text of a manual page: hyphens and backslashes as they are typed, no line that begins with a request.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) {
      escaped += std::string("\\&") + c;
    } else if (c == '|') {
      escaped += "\\||\\|";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string Synopsis(const CommandEntry& command) {
  std::string synopsis = Escaped(command.path);
  bool has_options = false;
  for (const OptionEntry& option : command.options) has_options = has_options || !option.is_argument;
  if (has_options) synopsis += " [OPTION]...";
  for (const OptionEntry& option : command.options) {
    if (!option.is_argument) continue;
    const std::string name = Escaped(option.names.front());
    synopsis += option.required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) synopsis += " COMMAND";
  return synopsis;
}

std::string Described(const OptionEntry& option) {
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + ("\\fB" + Escaped(name) + "\\fR");
  if (!option.value.empty()) head += " \\fI" + Escaped(option.value) + "\\fR";
  return fmt::format(".TP\n{}\n{}\n", head, Escaped(option.description));
}

std::string Section(const CommandEntry& command) {
  std::string text = fmt::format(".SS {}\n{}.\n", Synopsis(command), Escaped(command.description));
  for (const OptionEntry& option : command.options) {
    if (option.names.back() != "--help") text += Described(option);
  }
  return text;
}

// Lines of at most so many columns.
constexpr std::size_t kMarkdownColumns = 120;

// The text in lines, those after the first indented; a piece of code stays in one line.
std::string Wrapped(const std::string& text, const std::string& indent) {
  std::string wrapped, line;
  std::istringstream words(text);
  std::string word, piece;
  const auto add = [&](const std::string& one) {
    if (!line.empty() && line.size() + 1 + one.size() > kMarkdownColumns) {
      wrapped += line + "\n";
      line = indent + one;
    } else {
      line += (line.empty() ? "" : " ") + one;
    }
  };
  while (words >> word) {
    piece += (piece.empty() ? "" : " ") + word;
    if (std::ranges::count(piece, '`') % 2 != 0) continue;
    add(piece);
    piece.clear();
  }
  if (!piece.empty()) add(piece);
  return wrapped + line + "\n";
}

// Text of Markdown: signs that would be markup are literal, but pieces of code stay.
std::string Literal(const std::string& text) {
  std::string literal;
  bool is_code = false;
  for (const char c : text) {
    if (c == '`') is_code = !is_code;
    if (!is_code && (c == '*' || c == '<' || c == '_')) literal += '\\';
    literal += c;
  }
  return literal;
}

std::string Item(const OptionEntry& option) {
  std::string names;
  for (const std::string& name : option.names) {
    const bool has_value = !option.value.empty() && &name == &option.names.back();
    names += (names.empty() ? "`" : ", `") + name + (has_value ? " " + option.value : "") + "`";
  }
  return Wrapped("- " + names + ": " + Literal(option.description), "  ");
}

// As a sentence.
std::string Sentence(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return Wrapped(Literal(text) + (text.ends_with('.') ? "" : "."), "");
}

std::string MarkdownSection(const CommandEntry& command, const CommandEntry& program) {
  std::string heading = command.path;
  for (const OptionEntry& option : command.options) {
    if (option.is_argument) heading += option.required ? " " + option.names.front() : " [" + option.names.front() + "]";
  }
  const bool is_inner = std::ranges::count(command.path, ' ') > 1;
  std::string text = fmt::format("{} `{}`\n\n{}", is_inner ? "###" : "##", heading, Sentence(command.description));
  std::string items;
  for (const OptionEntry& option : command.options) {
    const bool is_everywhere =
        std::ranges::find(program.options, option.names, &OptionEntry::names) != program.options.end();
    if (&command == &program || !is_everywhere) items += Item(option);
  }
  return text + (items.empty() ? "" : "\n" + items);
}

}  // namespace

std::string ManualMarkdown(const std::vector<CommandEntry>& table) {
  std::string page;
  for (const CommandEntry& command : table)
    page += (page.empty() ? "" : "\n") + MarkdownSection(command, table.front());
  return page;
}

std::string ManualPage(const std::vector<CommandEntry>& table, const std::string& version) {
  const CommandEntry& program = table.front();
  std::string page = fmt::format(
      ".\\\" made by `rodeira manual`\n"
      ".TH RODEIRA 1 \"\" \"Rodeira {}\" \"User commands\"\n"
      ".SH NAME\nrodeira \\- distributed driving simulator\n"
      ".SH SYNOPSIS\n.B rodeira\n[\\-\\-help] [\\-\\-version] COMMAND [OPTION]...\n"
      ".SH DESCRIPTION\n"
      "Rodeira simulates a vehicle on its road among traffic. A launch file names the processes of a run (road, "
      "vehicle, "
      "traffic, input, view, recorder); \\fBrodeira run\\fR starts them, on one PC or on several, and they exchange "
      "samples in deterministic lockstep. A recording can be watched, computed again and compared to the bit. Without "
      "a "
      "command a window opens to choose what to drive.\n"
      ".SH COMMANDS\n",
      Escaped(version));
  for (const CommandEntry& command : table) {
    if (&command != &program && command.commands.empty()) page += Section(command);
  }
  page +=
      ".SH EXIT STATUS\n"
      ".TP\n0\ndone\n"
      ".TP\n1\nthe run failed, or a verification found a difference\n"
      ".TP\n2\nwrong input\n"
      ".SH ENVIRONMENT\n"
      ".TP\n.B RODEIRA_DATA\ndirectory with launch/ and configs/, instead of the installed one\n"
      ".TP\n.B XDG_DATA_HOME\nrecordings and the user's own launch/ and configs/ lie in its rodeira/ "
      "(default: ~/.local/share)\n"
      ".TP\n.B XDG_CONFIG_HOME\nsteering wheels lie in its rodeira/ (default: ~/.config)\n";
  return page;
}

}  // namespace rodeira::cli
