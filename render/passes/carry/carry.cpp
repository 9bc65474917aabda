#include <cuticle/render/pass.h>

namespace cuticle::render::carry {

namespace {

constexpr std::string_view k_demands[] = {"character", "output_color"};
constexpr std::string_view k_systems[] = {"H2"};
constexpr std::string_view k_after[] = {"skin"};

std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "carry",
                          .summary = "control hairs carried by the frames of their roots on the moved growth mesh",
                          .source = "target positions from skinning: docs/systems.md, H2",
                          .demands = k_demands,
                          .stage = registry::Stage::generate,
                          .systems = k_systems,
                          .dispatches = dispatches,
                          .after = k_after}};
  return pass;
}

}  // namespace cuticle::render::carry
