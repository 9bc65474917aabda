#include <fmt/core.h>

#include "cli/command.h"
#include "sim/solver.h"

namespace cuticle::cli {
namespace {

int print_effects(const Context& context) {
  std::vector<const registry::Entry*> entries;
  for (const sim::Effect* effect : sim::effects()) entries.push_back(&effect->entry);
  fmt::print("{}\n", context.json ? registry::to_json(entries) : registry::to_text(entries));
  return Exit::ok;
}

}  // namespace

void add_effects(CLI::App& app, Context& context) {
  CLI::App* command =
      app.add_subcommand("effects", "the strand solvers and effects, with parameters, units, ranges, sources");
  command->callback([&context] { context.action = [&context] { return print_effects(context); }; });
}

}  // namespace cuticle::cli
