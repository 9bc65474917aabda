#include "render/passes/truth/truth.h"

namespace cuticle::render::truth {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_truth"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.samples, "samples", 1, 64, "samples along each side of a pixel");
}

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "truth",
                .summary = "every sample of a pixel with all strands that cover it, sorted exactly, on the CPU",
                .source = "supersampling; the measure of the other ways to draw strands",
                .parameters = registry::table_of<Parameters>(),
                .demands = k_demands,
                .stage = registry::Stage::resolve},
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::truth
