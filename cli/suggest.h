#pragma once
// What a command line that could not be parsed most likely meant.
#include <optional>

#include <CLI/CLI.hpp>

#include "core/result.h"

namespace cuticle::cli {

/// The first subcommand or long option that the program does not know, with the nearest one that it does. Empty where
/// every word is known: the mistake is another.
std::optional<Error> find_misspelt(const CLI::App& app, int argc, const char* const* argv);

}  // namespace cuticle::cli
