#include "render/passes/supersampled/supersampled.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/shade_strands/shade_strands.h"

namespace cuticle::render::supersampled {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_supersampled"};
constexpr Use k_uses[] = {reads<FrameView>(),        reads<DrawnHair>(),
                          reads<Targets>(),          reads<shade_strands::StrandColors>(),
                          may_read<DrawnSurfaces>(), writes<Output>()};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.samples, "samples", 1, 64, "samples along each side of a pixel");
}

namespace {

/// The scene between the strands, without multisampling: this is not the place to save.
TargetShape targets(const PassParameters&, std::span<const int>) { return {.supersampling = 4}; }

Pass make() {
  Pass pass{.entry = {.kind = registry::EntryKind::pass,
                      .name = "supersampled",
                      .summary = "every sample of a pixel with all strands that cover it, sorted exactly, on the CPU",
                      .source = "supersampling; the measure of the other ways to draw strands",
                      .parameters = registry::table_of<Parameters>(),
                      .demands = k_demands,
                      .stage = registry::Stage::resolve},
            .uses = k_uses,
            .whole_pictures = true};
  pass.targets = targets;
  return pass;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = make();
  return pass;
}

}  // namespace cuticle::render::supersampled
