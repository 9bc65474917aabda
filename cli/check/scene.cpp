#include <fmt/core.h>

#include "cli/check/check.h"
#include "core/json/json.h"
#include "plan/plan.h"

namespace cuticle::cli {
namespace {

int check_scene(const std::string& file, const Context& context) {
  const auto loaded = scene::load_scene(file, plan::catalogue());
  if (!loaded && !context.json) return report(loaded.error());
  if (context.json)
    fmt::print("{}\n",
               Json{{"file", file}, {"valid", loaded.ok()}, {"error", loaded ? "" : loaded.error().message}}.dump(2));
  else
    fmt::print("{}: valid ({})\n", file, loaded->name);
  return loaded ? Exit::ok : Exit::bad_input_code;
}

}  // namespace

void add_check_scene(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand("scene", "check whether a scene file is valid");
  auto file = std::make_shared<std::string>();
  command->add_option("scene", *file, "scene file (JSON)")->required();
  command->callback([&context, file] { context.action = [&context, file] { return check_scene(*file, context); }; });
}

}  // namespace cuticle::cli
