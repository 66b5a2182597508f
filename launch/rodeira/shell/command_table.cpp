// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/shell/command_table.hpp"

#include <algorithm>
#include <sstream>

namespace rodeira::cli {
namespace {

// The parser's type names are "TEXT", "FLOAT", "UINT" …, with a validator's description behind a colon.
std::string ValueOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (colon != std::string::npos) return type.substr(colon + 1);
  for (const char* number : {"FLOAT", "INT", "UINT"}) {
    if (type.starts_with(number)) return "NUMBER";
  }
  return type.empty() ? "TEXT" : type;
}

std::vector<std::string> ChoicesIn(const std::string& value) {
  std::vector<std::string> choices;
  if (value.find('|') == std::string::npos) return choices;
  std::istringstream words(value);
  for (std::string word; std::getline(words, word, '|');) choices.push_back(word);
  return choices;
}

OptionEntry EntryOf(const CLI::Option& option) {
  OptionEntry entry;
  entry.is_argument = option.get_positional();
  entry.required = option.get_required();
  entry.description = option.get_description();
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  if (entry.is_argument) entry.names = {option.get_name(true)};
  entry.takes_value = entry.is_argument || option.get_items_expected_max() > 0;
  if (!entry.takes_value) return entry;
  const std::string value = ValueOf(option);
  entry.choices = ChoicesIn(value);
  if (!entry.is_argument) entry.value = value;
  return entry;
}

void Add(const CLI::App& command, const std::string& path, std::vector<CommandEntry>& table) {
  CommandEntry entry{path, command.get_description(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) entry.options.push_back(EntryOf(*option));
  }
  std::stable_partition(entry.options.begin(), entry.options.end(),
                        [](const OptionEntry& option) { return option.is_argument; });
  const auto inner = command.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); });
  for (const CLI::App* child : inner) entry.commands.push_back(child->get_name());
  table.push_back(std::move(entry));
  for (const CLI::App* child : inner) Add(*child, path + " " + child->get_name(), table);
}

}  // namespace

std::vector<CommandEntry> CommandTable(const CLI::App& app) {
  std::vector<CommandEntry> table;
  Add(app, app.get_name(), table);
  return table;
}

}  // namespace rodeira::cli
