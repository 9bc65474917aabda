#include <fmt/core.h>

#include "cli/check/check.h"
#include "core/json/json.h"
#include "core/text.h"
#include "plan/plan.h"

namespace cuticle::cli {
namespace {

int print_json(const std::string& file, const std::vector<Error>& errors) {
  Json list = Json::list();
  for (const Error& error : errors) list.push_back(Json{{"message", error.message}, {"hint", error.hint}});
  fmt::print("{}\n", Json{{"file", file},
                          {"valid", errors.empty()},
                          {"error", errors.empty() ? "" : errors.front().message},
                          {"errors", list}}
                         .dump(2));
  return errors.empty() ? Exit::ok : Exit::bad_input_code;
}

/// Every error on a line of its own.
int check_scene(const std::string& file, const Context& context) {
  const std::vector<Error> errors = scene::check_scene(file, plan::catalogue());
  if (context.json) return print_json(file, errors);
  for (const Error& error : errors) report(error);
  if (errors.size() > 1) fmt::print(stderr, "{}: {} errors\n", printable(file), errors.size());
  if (errors.empty()) fmt::print("{}: valid\n", file);
  return errors.empty() ? Exit::ok : Exit::bad_input_code;
}

}  // namespace

void add_check_scene(CLI::App& check, Context& context) {
  auto* command =
      check.add_subcommand("scene", "check whether a scene file is valid, and list all that is wrong with it");
  auto file = std::make_shared<std::string>();
  command->add_option("scene", *file, "scene file (JSON)")->required();
  command->callback([&context, file] { context.action = [&context, file] { return check_scene(*file, context); }; });
}

}  // namespace cuticle::cli
