#include "cli/plan_on_device.h"

#include <algorithm>

#include "plan/calibrate_gpu.h"
#include "plan/frame_runner_gpu.h"

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
    CUTICLE_ASSIGN(result, runner->run(k));
  }
  for (const gpu::PassCost& pass : result.cost.passes) costs.measured_ms[pass.name] = pass.gpu_ms;
  costs.bytes = runner->memory();
  costs.frame = runner->frame_plan();
  for (plan::FramePass& pass : costs.frame->passes) pass.pass = nullptr;  // the runner's, which ends here
  return runner->plan();
}

Result<std::string> calibrate_device(Context& context) {
  constexpr double k_most_seconds = 55;
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  CUTICLE_ASSIGN(const plan::CostTable table, plan::calibrate(device, k_most_seconds, *context.progress));
  const std::string path = plan::cost_table_path(table.device, table.driver);
  CUTICLE_TRY(plan::write_cost_table(path, table));
  return path;
}

}  // namespace cuticle::cli
