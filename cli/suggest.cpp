#include "cli/suggest.h"

#include <fmt/format.h>

#include "core/registry/parameter.h"

namespace cuticle::cli {
namespace {

using Apps = std::vector<const CLI::App*>;  ///< a command and what it stands under, the program first

std::string words_of(const Apps& path) {
  std::string words = "cuticle";
  for (std::size_t i = 1; i < path.size(); ++i) words += " " + path[i]->get_name();
  return words;
}

std::string nearest(const std::string& typed, const std::vector<std::string>& known) {
  return registry::nearest_name(typed, std::vector<std::string_view>(known.begin(), known.end()));
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (command->get_name() == name) return command;
  return nullptr;
}

Error unknown_command(const Apps& path, const std::string& typed) {
  std::vector<std::string> known;
  for (const CLI::App* command : path.back()->get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  const std::string near = nearest(typed, known);
  return usage_error(fmt::format("{}: unknown command '{}'", words_of(path), typed),
                     near.empty() ? words_of(path) + " --help" : words_of(path) + " " + near);
}

const CLI::Option* find_option(const Apps& path, const std::string& name) {
  for (const CLI::App* app : path)
    for (const CLI::Option* option : app->get_options())
      if (option->check_lname(name)) return option;
  return nullptr;
}

Error unknown_option(const Apps& path, const std::string& typed) {
  std::vector<std::string> known;
  for (const CLI::App* app : path)
    for (const CLI::Option* option : app->get_options())
      known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  const std::string near = nearest(typed, known);
  return usage_error(fmt::format("{}: unknown option '--{}'", words_of(path), typed),
                     near.empty() ? words_of(path) + " --help" : "--" + near);
}

bool has_commands(const CLI::App& app) { return !app.get_subcommands([](const CLI::App*) { return true; }).empty(); }

}  // namespace

std::optional<Error> find_misspelt(const CLI::App& app, int argc, const char* const* argv) {
  Apps path = {&app};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("--") && word.size() > 2) {
      const std::size_t equals = word.find('=');
      const std::string name = word.substr(2, equals == word.npos ? equals : equals - 2);
      const CLI::Option* option = find_option(path, name);
      if (option == nullptr) return unknown_option(path, name);
      if (equals == word.npos && option->get_items_expected_max() > 0) ++i;  // its value
    } else if (has_commands(*path.back()) && !word.starts_with("-")) {
      const CLI::App* command = find_command(*path.back(), word);
      if (command == nullptr) return unknown_command(path, word);
      path.push_back(command);
    }
  }
  return {};
}

}  // namespace cuticle::cli
