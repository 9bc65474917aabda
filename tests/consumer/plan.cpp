// What a plan of the module `plan` leaves out of an empty scene.
#include <cstdio>

#include <cuticle/plan/plan.h>

int main() {
  const cuticle::plan::Plan plan = cuticle::plan::make_plan({}, {});
  std::printf("%zu passes, %zu left out\n", plan.passes.size(), plan.left_out.size());
  return plan.left_out.empty() ? 1 : 0;
}
