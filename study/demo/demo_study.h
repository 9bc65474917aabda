#pragma once
// The demo's study: opacity-map slices against ray-traced truth on the hair that was drawn.
#include <string>

#include <cuticle/core/progress.h>
#include <cuticle/core/result.h>
#include <cuticle/scene/scene.h>
#include <cuticle/strands/groom.h>
#include <cuticle/study/demo/demo_page.h>

namespace cuticle::study {

/// Runs the quick slices study for the scene's first light, writes its data into `folder`, gives the page's section. Without a light,
/// or on a groom so thin that no receiver counts, the section says so.
Result<DemoSection> run_demo_study(const strands::Groom& drawn, const scene::Scene& scene, const std::string& folder, Progress& progress);

}  // namespace cuticle::study
