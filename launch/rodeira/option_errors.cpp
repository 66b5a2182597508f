// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/option_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "common/core/base/suggest.hpp"

namespace rodeira::cli {
namespace {

// The command that was being read, and how a person calls it.
struct Reading {
  const CLI::App* command;
  std::string name;
};
Reading Deepest(const CLI::App& app) {
  Reading reading{&app, app.get_name()};
  for (auto inner = app.get_subcommands(); !inner.empty(); inner = reading.command->get_subcommands()) {
    reading = {inner.back(), reading.name + " " + inner.back()->get_name()};
  }
  return reading;
}

std::vector<std::string> CommandsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(inner->get_name());
  return names;
}

std::vector<std::string> OptionsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

// The parser says "Could not convert: NAME = VALUE"; nothing where it says something else.
std::string ConversionSentence(const CLI::App& command, const std::string& said) {
  constexpr std::string_view kSaid = "Could not convert: ", kIs = " = ";
  const std::size_t equals = said.find(kIs);
  if (!said.starts_with(kSaid) || equals == std::string::npos) return "";
  const std::string name = said.substr(kSaid.size(), equals - kSaid.size()), value = said.substr(equals + kIs.size());
  std::string type;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name() == name || option->check_name(name)) type = option->get_type_name();
  }
  const bool whole = type.starts_with("INT") || type.starts_with("UINT");
  return fmt::format("{}: '{}' was found; a {} was expected", name, value, whole ? "whole number" : "number");
}

// A sentence where the text is a number that does not pass; what is no number is left to the conversion.
template <class Passes>
std::string WhyNot(const std::string& text, const Passes& passes, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || passes(value)) return "";
  return fmt::format("'{}' was found; {} was expected", text, what);
}

// The parser says "NAME: At least N required but received M", or "at most" and "exactly"; nothing where it says
// something else.
std::string CountSentence(const CLI::App& command, const std::string& said) {
  const std::size_t colon = said.find(':'), received = said.find("received ");
  if (colon == std::string::npos || received == std::string::npos) return "";
  const std::string name = said.substr(0, colon), count = said.substr(received + std::string_view("received ").size());
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name() != name && !option->check_name(name)) continue;
    const int least = option->get_items_expected_min(), most = option->get_items_expected_max();
    const std::string expected = least == most                                   ? fmt::format("{}", least)
                                 : most >= CLI::detail::expected_max_vector_size ? fmt::format("{} or more", least)
                                                                                 : fmt::format("{} to {}", least, most);
    return fmt::format("{}: {} value{} found; {} were expected", name, count, count == "1" ? " was" : "s were",
                       expected);
  }
  return "";
}

}  // namespace

CLI::Validator OneOf(std::vector<std::string> words) {
  const std::string described = fmt::format("{}", fmt::join(words, "|"));
  return CLI::Validator(
      [words = std::move(words)](std::string& text) {
        return std::find(words.begin(), words.end(), text) != words.end()
                   ? std::string()
                   : fmt::format("'{}' was found{}", text, base::DidYouMean(text, words));
      },
      described);
}

CLI::Validator Above0(std::string what) {
  return CLI::Validator(
      [what = std::move(what)](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return end != text.c_str() && *end == '\0' && value > 0.0 && std::isfinite(value)
                   ? std::string()
                   : fmt::format("'{}' was found; {} was expected", text, what);
      },
      "NUMBER");
}

CLI::Validator PositiveSeconds() { return Above0("a positive number of seconds"); }

CLI::Validator Finite() {
  return CLI::Validator(
      [](std::string& text) {
        return WhyNot(
            text, [](double value) { return std::isfinite(value); }, "a finite number");
      },
      "NUMBER");
}

CLI::Validator From0() {
  return CLI::Validator(
      [](std::string& text) {
        return WhyNot(
            text, [](double value) { return std::isfinite(value) && value >= 0.0; }, "a number from 0 on");
      },
      "NUMBER");
}

CLI::Validator Between(double low, double high) {
  return CLI::Validator(
      [=](std::string& text) {
        return WhyNot(
            text, [=](double value) { return value >= low && value <= high; },
            fmt::format("a number from {} to {}", low, high));
      },
      "NUMBER");
}

CLI::Validator WholeNumber() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        return problem == std::errc() && end == text.data() + text.size()
                   ? std::string()
                   : fmt::format("'{}' was found; a whole number from 0 on was expected", text);
      },
      "NUMBER");
}

namespace {

base::Error UnknownCommand(const std::string& word, const std::vector<std::string>& commands) {
  return base::WrongInput("command.unknown_command",
                          fmt::format("unknown command '{}'{}", word, base::DidYouMean(word, commands)));
}

template <class Kind>
bool Is(const CLI::ParseError& problem) {
  return dynamic_cast<const Kind*>(&problem) != nullptr;
}

// What is wrong with the command that was read.
base::Error Problem(const Reading& reading, const CLI::ParseError& problem) {
  const std::vector<std::string> extras = reading.command->remaining(true);
  const auto option = std::find_if(extras.begin(), extras.end(),
                                   [](const std::string& word) { return word.size() > 1 && word.front() == '-'; });
  if (option != extras.end()) {
    const std::string name = option->substr(0, option->find('='));
    return base::WrongInput("command.unknown_option", fmt::format("unknown option '{}'{}", name,
                                                                  base::DidYouMean(name, OptionsOf(*reading.command))));
  }
  const std::vector<std::string> commands = CommandsOf(*reading.command);
  if (!commands.empty() && !extras.empty()) return UnknownCommand(extras.front(), commands);
  if (!commands.empty() && Is<CLI::RequiredError>(problem))
    return base::WrongInput("command.missing_command",
                            fmt::format("a command is missing; expected {}", fmt::join(commands, ", ")));
  if (!extras.empty())
    return base::WrongInput("command.unexpected_argument", fmt::format("unexpected argument '{}'", extras.front()));
  std::string sentence;
  if (Is<CLI::ConversionError>(problem)) sentence = ConversionSentence(*reading.command, problem.what());
  if (Is<CLI::ArgumentMismatch>(problem)) sentence = CountSentence(*reading.command, problem.what());
  const std::string text = sentence.empty() ? problem.what() : sentence;
  if (Is<CLI::ConversionError>(problem) || Is<CLI::ValidationError>(problem))
    return base::WrongInput("command.wrong_value", text);
  if (Is<CLI::ArgumentMismatch>(problem)) return base::WrongInput("command.wrong_count", text);
  if (Is<CLI::RequiredError>(problem)) return base::WrongInput("command.missing_argument", text);
  if (Is<CLI::RequiresError>(problem)) return base::WrongInput("command.missing_option", text);
  if (Is<CLI::ExcludesError>(problem)) return base::WrongInput("command.conflicting_options", text);
  return base::WrongInput("command.wrong_usage", text);
}

}  // namespace

base::Error OptionError(const CLI::App& app, const CLI::ParseError& problem) {
  const Reading reading = Deepest(app);
  // A word before the command that was read: 'trafic run' is not 'run'.
  const std::vector<std::string> before = app.remaining(false);
  const bool is_before = reading.command != &app && !before.empty() && before.front().front() != '-';
  const std::string name = is_before ? app.get_name() : reading.name;
  const base::Error error = is_before ? UnknownCommand(before.front(), CommandsOf(app)) : Problem(reading, problem);
  return error.WithMessage(fmt::format("{} (see '{} --help')", error.message, name)).WithContext(name);
}

}  // namespace rodeira::cli
