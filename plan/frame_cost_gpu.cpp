#include "plan/frame_cost_gpu.h"

#include <algorithm>

namespace cuticle::plan {

void add_cost(const gpu::SubmitCost& more, gpu::SubmitCost& cost) {
  cost.wall_ms += more.wall_ms;
  for (const gpu::PassCost& pass : more.passes) {
    auto found = std::ranges::find(cost.passes, pass.name, &gpu::PassCost::name);
    if (found == cost.passes.end()) found = cost.passes.insert(found, {.name = pass.name});
    found->gpu_ms += pass.gpu_ms;
    found->dispatches += pass.dispatches;
    found->draws += pass.draws;
  }
  cost.fragments.insert(cost.fragments.end(), more.fragments.begin(), more.fragments.end());
}

}  // namespace cuticle::plan
