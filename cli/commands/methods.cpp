#include <fmt/core.h>

#include "cli/command.h"
#include "plan/plan.h"

namespace cuticle::cli {

void add_methods(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("methods", "the shadow methods, with parameters, units, ranges, sources");
  command->callback([&context] {
    context.action = [&context] {
      const auto& methods = plan::catalogue().methods;
      fmt::print("{}\n", context.json ? registry::to_json(methods) : registry::to_text(methods));
      return int(Exit::ok);
    };
  });
}

}  // namespace cuticle::cli
