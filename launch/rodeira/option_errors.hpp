// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

// What a person is told of a command line that is not right.
namespace rodeira::cli {

// One of the words, or the sentence that names the nearest.
CLI::Validator OneOf(std::vector<std::string> words);
// A finite number above 0; `what` says of which kind ("a positive number of seconds").
CLI::Validator Above0(std::string what);
// A duration: a finite number of seconds above 0.
CLI::Validator PositiveSeconds();
// A finite number, below 0 too; what is no number at all is left to the parser's own conversion; its sentence names
// it.
CLI::Validator Finite();
// A finite number from 0 on.
CLI::Validator From0();
// A number between two others, or one of them.
CLI::Validator Between(double low, double high);
// A whole number from 0 to 2^64 - 1, as a seed is.
CLI::Validator WholeNumber();

// "what is wrong (see 'COMMAND --help')" of the command, which is the error's context: an unknown word with the nearest
// known one; otherwise the parser's own words. Wrong input.
base::Error OptionError(const CLI::App& app, const CLI::ParseError& problem);

}  // namespace rodeira::cli
