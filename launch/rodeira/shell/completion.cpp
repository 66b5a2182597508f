// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/shell/completion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rodeira::cli {
namespace {

// The command that lists the names that an argument accepts; empty if it accepts files only.
std::string ListCommand(const OptionEntry& option) {
  const std::string& name = option.names.front();
  if (name == "LAUNCH.yaml") return "run --list";
  if (name == "WORLD" || name == "MAP") return "world list";
  if (name == "VEHICLE.yaml") return "vehicle list";
  return "";
}

std::string ListCommand(const CommandEntry& command) {
  for (const OptionEntry& option : command.options) {
    if (option.is_argument) return ListCommand(option);
  }
  return "";
}

bool TakesFiles(const CommandEntry& command) {
  return std::ranges::any_of(command.options,
                             [](const OptionEntry& option) { return option.is_argument && option.choices.empty(); });
}

std::vector<std::string> OptionNames(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const OptionEntry& option : command.options) {
    if (!option.is_argument) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

// Text inside single quotes of a shell.
std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + quoted + "'";
}

// Lines of a `case` that set `path` to the command in front of the word that is completed.
std::string PathPatterns(const std::vector<CommandEntry>& table) {
  std::string patterns;
  for (const CommandEntry& command : table) {
    if (&command != &table.front()) patterns += (patterns.empty() ? "" : " | ") + Quoted(command.path);
  }
  return patterns;
}

// How the value of an option is completed, and the patterns "PATH OPTION" that it holds for.
struct ValueCompletion {
  std::vector<std::string> choices;  // empty: no words
  bool files = false;
  std::string patterns;
};

// Options with the same choices apart; all that take a number together; all others (files, texts) together.
std::vector<ValueCompletion> ValueCompletions(const std::vector<CommandEntry>& table) {
  std::vector<ValueCompletion> completions;
  for (const CommandEntry& command : table) {
    for (const OptionEntry& option : command.options) {
      if (option.is_argument || !option.takes_value) continue;
      const bool files = option.choices.empty() && option.value != "NUMBER";
      auto found = std::ranges::find_if(completions, [&](const ValueCompletion& completion) {
        return completion.choices == option.choices && completion.files == files;
      });
      if (found == completions.end()) found = completions.insert(found, {option.choices, files, ""});
      for (const std::string& name : option.names)
        found->patterns += (found->patterns.empty() ? "" : " | ") + Quoted(command.path + " " + name);
    }
  }
  return completions;
}

// `body` of each as branches of a `case`.
template <class Body>
std::string ValueBranches(const std::vector<CommandEntry>& table, const Body& body) {
  std::string branches;
  for (const ValueCompletion& completion : ValueCompletions(table))
    branches += fmt::format("    {}) {} ;;\n", completion.patterns, body(completion));
  return branches;
}

// Words that the first argument must be one of.
std::vector<std::string> ArgumentChoices(const CommandEntry& command) {
  for (const OptionEntry& option : command.options) {
    if (option.is_argument) return option.choices;
  }
  return {};
}

// Commands, options and accepted arguments of a command.
std::string WordsOf(const CommandEntry& command) {
  return fmt::format("{} {} {}", fmt::join(command.commands, " "), fmt::join(ArgumentChoices(command), " "),
                     fmt::join(OptionNames(command), " "));
}

}  // namespace

std::string BashCompletion(const std::vector<CommandEntry>& table) {
  const auto value = [](const ValueCompletion& completion) {
    if (completion.files) return std::string("COMPREPLY=($(compgen -f -- \"$current\")); return");
    if (completion.choices.empty()) return std::string("return");
    return fmt::format("COMPREPLY=($(compgen -W {} -- \"$current\")); return",
                       Quoted(fmt::format("{}", fmt::join(completion.choices, " "))));
  };
  std::string script = fmt::format(
      "# bash completion of rodeira, made by `rodeira completion bash`\n"
      "_rodeira() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} path=rodeira words= list= "
      "files= i\n"
      "  COMPREPLY=()\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case \"$path ${{COMP_WORDS[i]}}\" in\n"
      "    {}) path=\"$path ${{COMP_WORDS[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$path $previous\" in\n{}"
      "  esac\n"
      "  case \"$path\" in\n",
      PathPatterns(table), ValueBranches(table, value));
  for (const CommandEntry& command : table) {
    script += fmt::format("    {}) words={} list={} files={} ;;\n", Quoted(command.path), Quoted(WordsOf(command)),
                          Quoted(ListCommand(command)), TakesFiles(command) ? "yes" : "");
  }
  script +=
      "  esac\n"
      "  if [[ $current != -* ]]; then\n"
      "    [[ -z $list ]] || words+=\" $(\"$1\" $list 2>/dev/null | awk 'NR > 1 { print $1 }')\"\n"
      "    [[ -z $files ]] || COMPREPLY=($(compgen -f -- \"$current\"))\n"
      "  fi\n"
      "  COMPREPLY+=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}\n"
      "complete -o filenames -F _rodeira rodeira\n";
  return script;
}

std::string ZshCompletion(const std::vector<CommandEntry>& table) {
  // An entry of _describe: "name:description", colons of the name escaped.
  const auto described = [](const std::string& name, const std::string& description) {
    std::string escaped;
    for (const char c : name) escaped += c == ':' ? std::string("\\:") : std::string(1, c);
    return Quoted(escaped + ":" + description);
  };
  const auto value = [](const ValueCompletion& completion) {
    if (completion.files) return std::string("_files; return");
    if (completion.choices.empty()) return std::string("return");
    return fmt::format("compadd -- {}; return", fmt::join(completion.choices, " "));
  };
  std::string script = fmt::format(
      "#compdef rodeira\n"
      "# zsh completion of rodeira, made by `rodeira completion zsh`\n"
      "_rodeira() {{\n"
      "  local path=rodeira list= files= i\n"
      "  local -a entries\n"
      "  for ((i = 2; i < CURRENT; i++)); do\n"
      "    case \"$path ${{words[i]}}\" in\n"
      "    {}) path=\"$path ${{words[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$path ${{words[CURRENT-1]}}\" in\n{}"
      "  esac\n"
      "  case \"$path\" in\n",
      PathPatterns(table), ValueBranches(table, value));
  for (const CommandEntry& command : table) {
    std::string entries;
    for (const std::string& name : command.commands) {
      const auto child = std::ranges::find(table, command.path + " " + name, &CommandEntry::path);
      entries += " " + described(name, child->description);
    }
    for (const OptionEntry& option : command.options) {
      if (option.is_argument) continue;
      for (const std::string& name : option.names) entries += " " + described(name, option.description);
    }
    for (const std::string& choice : ArgumentChoices(command)) entries += " " + Quoted(choice);
    script += fmt::format("    {}) entries=({} ) list={} files={} ;;\n", Quoted(command.path), entries,
                          Quoted(ListCommand(command)), TakesFiles(command) ? "yes" : "");
  }
  script +=
      "  esac\n"
      "  [[ -z $list ]] || compadd -- ${(f)\"$($words[1] ${=list} 2>/dev/null | awk 'NR > 1 { print $1 }')\"}\n"
      "  [[ -z $files ]] || _files\n"
      "  _describe -o rodeira entries\n"
      "}\n"
      "_rodeira \"$@\"\n";
  return script;
}

}  // namespace rodeira::cli
