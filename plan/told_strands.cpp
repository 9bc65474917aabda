#include "plan/told_strands.h"

#include <algorithm>

#include <fmt/core.h>

#include "plan/plan.h"
#include "render/pass.h"
#include "render/passes/tile_sort/tile_sort.h"

namespace cuticle::plan {

namespace {

constexpr std::string_view k_telling[] = {"tiles", "supersampled", "reference"};

}  // namespace

Result<void> check_told_strands(const scene::Scene& scene) {
  if (!scene.outputs.color || !scene.outputs.tells_strands()) return {};
  if (std::ranges::find(k_telling, scene.render_method) == std::end(k_telling))
    return bad_input(
        fmt::format("outputs: deep and cryptomatte: '{}' does not tell strands apart", scene.render_method),
        "draw strands by tiles, supersampled or reference");
  if (scene.render_method == "reference") return {};
  const Plan plan = make_plan(scene, {});
  for (const char* pass : {"depth_of_field", "motion_blur", "temporal_antialiasing"})
    if (find_pass(plan, pass))
      return bad_input(fmt::format("outputs: deep and cryptomatte: '{}' moves light between pixels", pass),
                       "leave it out, or draw by 'reference', whose samples know lens and shutter");
  if (find_pass(plan, "tile_sort") && render::parameters_of<render::tile_sort::Parameters>(scene.passes).slices > 0)
    return bad_input("tile_sort: slices: strands of one slice are not sorted, so that their shares are not known",
                     "leave slices out for deep pictures and mattes");
  return {};
}

}  // namespace cuticle::plan
