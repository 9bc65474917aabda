#include "cli/plan_on_device.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include <fmt/core.h>

#include "cli/shared_files.h"
#include "plan/budgets.h"
#include "plan/calibrate_gpu.h"
#include "plan/frame_runner_gpu.h"
#include "plan/strand_set.h"
#include "study/plan/accuracy_gpu.h"

namespace cuticle::cli {

plan::PlanCosts known_costs(const std::string& device) {
  plan::PlanCosts costs;
  costs.device.is_software = true;
  const auto opened = gpu::Device::open({.choice = device});
  if (!opened) return costs;
  const gpu::DeviceInfo& info = (*opened)->info();
  costs.device = {info.name, info.is_software};
  if (auto table = plan::read_cost_table(plan::cost_table_path(info.name, info.driver)))
    costs.table = std::move(*table);
  return costs;
}

Result<plan::Plan> run_planned_frame(const scene::Scene& scene, int frame, Context& context, plan::PlanCosts& costs) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, *context.progress));
  // The frame before is drawn as well, so that this one may keep what did not change.
  plan::FrameResult result;
  for (int k = std::max(0, frame - 1); k <= frame; ++k) {
    CUTICLE_ASSIGN(result, plan::timed_frame(*runner, *device, k, false));
  }
  for (const gpu::PassCost& pass : result.cost.passes) costs.measured_ms[pass.name] = pass.gpu_ms;
  costs.bytes = runner->memory();
  costs.frame = runner->frame_plan();
  for (plan::FramePass& pass : costs.frame->passes) pass.pass = nullptr;  // the runner's, which ends here
  return runner->plan();
}

namespace {

double bytes_of(const plan::FrameRunner& runner) {
  double bytes = 0;
  for (const auto& [name, held] : runner.memory()) bytes += double(held);
  return bytes;
}

/// Device memory of the scene's first frame with each setting in question, one part changed at a time.
Result<plan::MemoryTable> measured_memory(const scene::Scene& scene, std::span<const plan::AccuracyRow> rows,
                                          Context& context) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  const auto bytes_with = [&](const scene::Scene& changed) -> Result<double> {
    CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, changed, silent_progress()));
    CUTICLE_TRY(runner->run(0));
    return bytes_of(*runner);
  };
  plan::MemoryTable memory;
  CUTICLE_ASSIGN(memory.of_scene, bytes_with(scene));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    context.progress->update("memory of settings", k, rows.size());
    CUTICLE_ASSIGN(const scene::Scene changed, plan::with_setting(scene, rows[k]));
    CUTICLE_ASSIGN(const double bytes, bytes_with(changed));
    memory.change[plan::memory_name(rows[k])] = bytes - memory.of_scene;
  }
  return memory;
}

}  // namespace

Result<std::string> meet_budgets(scene::Scene& scene, Context& context) {
  if (!scene.budgets) return std::string();
  plan::PlanCosts costs = known_costs(context.device);
  if (!costs.table) {
    context.progress->message("the passes are timed on this device first, a minute at most");
    CUTICLE_ASSIGN(const std::string file, calibrate_device(context));
    CUTICLE_ASSIGN(costs.table, plan::read_cost_table(file));
  }
  CUTICLE_ASSIGN(const plan::AccuracyTable accuracy, plan::read_accuracy_table(share_file("scenes/accuracy.json")));
  CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(scene));
  const registry::FrameShape shape = plan::shape_of(scene, set);
  plan::MemoryTable memory;
  if (scene.budgets->memory_mb > 0) {
    CUTICLE_ASSIGN(memory,
                   measured_memory(scene, plan::rows_in_question(scene, shape, costs.device, accuracy), context));
  }
  plan::BudgetChoice choice = plan::choose(scene, shape, costs.device, accuracy, *costs.table, memory);
  if (!choice.refused.empty()) return choice.refused;
  context.progress->message("budgets are kept, as expected, by");
  std::istringstream lines(plan::to_text(choice, *scene.budgets));
  for (std::string line; std::getline(lines, line);) context.progress->message(line);
  scene = std::move(choice.scene);
  return std::string();
}

namespace {

/// The passes of a frame in which all that is planned runs, milliseconds: the least of two after a first one.
Result<double> frame_time(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene, Context& context) {
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, *context.progress));
  double least = std::numeric_limits<double>::infinity();
  for (int frame = 0; frame < 3; ++frame) {
    CUTICLE_ASSIGN(const plan::FrameResult result, plan::timed_frame(*runner, *device, frame, true));
    double ms = 0;
    for (const gpu::PassCost& pass : result.cost.passes) ms += pass.gpu_ms;
    if (frame > 0) least = std::min(least, ms);
  }
  return least;
}

}  // namespace

Result<std::string> measured_on_this_hair(const scene::Scene& scene, Context& context) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  CUTICLE_ASSIGN(const auto rows, study::measure_scene(device, scene, *context.progress));
  std::string text;
  for (const plan::AccuracyRow& row : rows)
    text += fmt::format("{:<9} {}: error {:.3g} measured on this hair\n", row.part, row.method, row.error);
  CUTICLE_ASSIGN(const double ms, frame_time(device, scene, context));
  return text + fmt::format("{:<9} {:.3g} ms measured on this hair\n", "frame", ms);
}

Result<std::string> calibrate_device(Context& context) {
  constexpr double k_max_seconds = 50;
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  const auto accuracy = plan::read_accuracy_table(share_file("scenes/accuracy.json"));
  CUTICLE_ASSIGN(const plan::CostTable table,
                 plan::calibrate(device, accuracy ? accuracy->rows : std::vector<plan::AccuracyRow>(), k_max_seconds,
                                 *context.progress));
  const std::string path = plan::cost_table_path(table.device, table.driver);
  CUTICLE_TRY(plan::write_cost_table(path, table));
  return path;
}

}  // namespace cuticle::cli
