// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/shell/manual.hpp"

#include <fmt/format.h>

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

}  // namespace

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
