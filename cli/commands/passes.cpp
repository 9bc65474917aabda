#include <fmt/core.h>

#include "cli/command.h"
#include "plan/plan.h"

namespace cuticle::cli {

void add_passes(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("passes", "the render passes, with parameters, units, ranges, sources");
  command->callback([&context] {
    context.action = [&context] {
      const auto& passes = plan::catalogue().passes;
      fmt::print("{}\n", context.json ? registry::to_json(passes) : registry::to_text(passes));
      return int(Exit::ok);
    };
  });
}

}  // namespace cuticle::cli
