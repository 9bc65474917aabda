#include <fmt/core.h>

#include "cli/command.h"
#include "plan/plan.h"
#include "plan/strand_set.h"

namespace cuticle::cli {

namespace {

Result<plan::Plan> make(const std::string& file, Progress& progress) {
  CUTICLE_ASSIGN(const scene::Scene scene, scene::load_scene(file, plan::catalogue()));
  CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(scene));
  for (const std::string& note : set.notes) progress.message(note);
  return plan::make_plan(scene, plan::shape_of(scene, set));
}

int print_plan(const std::string& file, Context& context) {
  const auto made = make(file, *context.progress);
  if (!made) return report(made.error());
  fmt::print("{}\n", context.json ? plan::to_json(*made) : plan::to_text(*made));
  return Exit::ok;
}

int print_schema() {
  fmt::print("{}", scene::scene_schema(plan::catalogue()));
  return Exit::ok;
}

}  // namespace

void add_plan(CLI::App& app, Context& context) {
  auto* command =
      app.add_subcommand("plan", "list the passes that a scene needs, each with its reason, and those left out");
  auto file = std::make_shared<std::string>();
  auto schema = std::make_shared<bool>(false);
  auto* flag = command->add_flag("--schema", *schema, "print the JSON Schema of scene files instead");
  command->add_option("scene", *file, "scene file (JSON)")->excludes(flag);
  command->callback([&context, file, schema] {
    if (!*schema && file->empty()) throw CLI::RequiredError("scene");
    context.action = [&context, file, schema] { return *schema ? print_schema() : print_plan(*file, context); };
  });
}

}  // namespace cuticle::cli
