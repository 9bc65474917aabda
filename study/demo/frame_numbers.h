#pragma once
// What the demo's own settings cost in accuracy: tables, coverage, shadows, each against its truth.
#include <memory>

#include "gpu/device.h"
#include "lut/table_set.h"
#include "scene/scene.h"
#include "strands/groom.h"
#include "study/demo/demo_page.h"

namespace cuticle::study {

/// Measures the frames' settings. `tables`: certified. `drawn`: the strands of the last frame. A part that cannot be
/// measured (no Embree, no light) says why in its row.
DemoSection frame_numbers(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const lut::TableSet& tables,
                          const strands::Groom& drawn, Progress& progress);

}  // namespace cuticle::study
