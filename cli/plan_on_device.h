#pragma once
// What `cuticle plan` asks a device.
#include <string>

#include "cli/command.h"
#include "plan/plan_report.h"

namespace cuticle::cli {

/// The device that --device chooses, and its stored times; where there is none, hair is solved on the CPU.
plan::PlanCosts known_costs(const std::string& device);
/// Runs a frame and puts what it did into `costs`. Gives the plan. Frames before are simulated.
Result<plan::Plan> run_planned_frame(const scene::Scene& scene, int frame, Context& context, plan::PlanCosts& costs);
/// Puts the settings into the scene that keep its budgets, and says which. On a device without stored times these are
/// taken first. Gives why none do; empty: they do.
Result<std::string> meet_budgets(scene::Scene& scene, Context& context);
/// What the scene's errors and the time of a frame are as it stands, a line each. Error: of the study or the device.
Result<std::string> measured_on_this_hair(const scene::Scene& scene, Context& context);
/// Times every pass, stores the table and gives the name of its file.
Result<std::string> calibrate_device(Context& context);

}  // namespace cuticle::cli
