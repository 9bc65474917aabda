#pragma once
// The demo's study: opacity-map slices against ray-traced truth on the hair that was drawn.
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "scene/scene.h"
#include "strands/groom.h"
#include "study/demo/demo_page.h"

namespace cuticle::study {

/// Runs the quick slices study for the scene's first light, writes its data into `folder`, gives the page's section. Without a light,
/// or on a groom so thin that no receiver counts, the section says so.
Result<DemoSection> run_demo_study(const strands::Groom& drawn, const scene::Scene& scene, const std::string& folder, Progress& progress);

}  // namespace cuticle::study
