#include <fmt/core.h>

#include "cli/command.h"
#include "plan/plan_report.h"
#include "plan/strand_set.h"
#include "plan/told_strands.h"
#ifdef CUTICLE_HAS_GPU
#include "cli/plan_on_device.h"
#endif

namespace cuticle::cli {

namespace {

struct PlanOptions {
  std::string scene, why;
  int frame = -1;
  bool dot = false, schema = false, calibrate = false, measure = false;
};

/// A scene's plan, and what is known of its cost here.
struct Planned {
  scene::Scene scene;
  plan::Plan plan;
  plan::PlanCosts costs;
  std::string refused = {};  ///< why no settings keep the scene's budgets
};

Result<Planned> make(const PlanOptions& options, Context& context) {
  Planned planned;
  CUTICLE_ASSIGN(planned.scene, scene::load_scene(options.scene, plan::catalogue()));
  CUTICLE_TRY(plan::check_told_strands(planned.scene));
#ifdef CUTICLE_HAS_GPU
  CUTICLE_ASSIGN(planned.refused, meet_budgets(planned.scene, context));
  if (!planned.refused.empty()) return planned;
  planned.costs = known_costs(context.device);
  if (options.frame >= 0) {
    CUTICLE_ASSIGN(planned.plan, run_planned_frame(planned.scene, options.frame, context, planned.costs));
    return planned;
  }
#else
  planned.costs.device.is_software = true;
  if (options.frame >= 0) return usage_error("--frame: this build has no GPU code");
#endif
  CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(planned.scene));
  for (const std::string& note : set.notes) context.progress->message(note);
  planned.plan = plan::make_plan(planned.scene, plan::shape_of(planned.scene, set), planned.costs.device);
  return planned;
}

int print_plan(const PlanOptions& options, Context& context) {
  const auto made = make(options, context);
  if (!made) return report(made.error());
  if (!made->refused.empty()) {
    fmt::print(stderr, "{}\n", made->refused);
    return Exit::check_failed;
  }
  if (options.dot) {
    fmt::print("{}", plan::report_dot(made->plan));
    return Exit::ok;
  }
  if (!options.why.empty()) {
    const auto text = plan::report_why(made->scene, made->plan, made->costs, options.why);
    if (!text) return report(text.error());
    fmt::print("{}", *text);
    return Exit::ok;
  }
  fmt::print("{}\n", context.json ? plan::report_json(made->scene, made->plan, made->costs)
                                  : plan::report_text(made->scene, made->plan, made->costs));
#ifdef CUTICLE_HAS_GPU
  if (options.measure) {
    const auto measured = measured_on_this_hair(made->scene, context);
    if (!measured) return report(measured.error());
    fmt::print("{}", *measured);
  }
#endif
  return Exit::ok;
}

int calibrate_here(Context& context) {
#ifdef CUTICLE_HAS_GPU
  const auto path = calibrate_device(context);
  if (!path) return report(path.error());
  fmt::print("{}\n", *path);
  return Exit::ok;
#else
  (void)context;
  return report(usage_error("--calibrate: this build has no GPU code"));
#endif
}

int act(const PlanOptions& options, Context& context) {
  if (options.schema) {
    fmt::print("{}", scene::scene_schema(plan::catalogue()));
    return Exit::ok;
  }
  if (options.calibrate)
    if (const int code = calibrate_here(context); code != Exit::ok || options.scene.empty()) return code;
  return print_plan(options, context);
}

}  // namespace

void add_plan(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "plan", "list the passes that a scene needs, each with its reason and cost, and what would bring in the others");
  auto options = std::make_shared<PlanOptions>();
  auto* schema = command->add_flag("--schema", options->schema, "print the JSON Schema of scene files instead");
  command->add_option("scene", options->scene, "scene file (JSON)")->excludes(schema);
  command
      ->add_option("--frame", options->frame,
                   "run this frame, and say what it did: passes left out because nothing changed or nothing is in "
                   "reach, times and memory as measured")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--why", options->why, "everything about one pass, effect, solver or shadow method");
  command->add_flag("--dot", options->dot, "print a Graphviz graph of facts and passes");
  command->add_flag(
      "--measure", options->measure,
      "also measure a frame's time, and shadow and coverage of this hair against ray-traced truth and brute force");
  command->add_flag("--calibrate", options->calibrate,
                    "first time every pass on this device, a minute at most; the times are stored for it");
  command->callback([&context, options] {
    if (!options->schema && !options->calibrate && options->scene.empty()) throw CLI::RequiredError("scene");
    context.action = [&context, options] { return act(*options, context); };
  });
}

}  // namespace cuticle::cli
