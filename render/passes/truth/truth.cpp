#include "render/passes/truth/truth.h"

namespace cuticle::render::truth {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_truth"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "samples",
     .type = registry::ParameterType::integer,
     .minimum = 1,
     .maximum = 64,
     .default_text = "16",
     .summary = "samples along each side of a pixel"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "truth",
                .summary = "every sample of a pixel with all strands that cover it, sorted exactly, on the CPU",
                .source = "supersampling; the measure of the other ways to draw strands",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::resolve},
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::truth
