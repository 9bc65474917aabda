#include <cuticle/render/pass.h>

namespace cuticle::render::skin {

namespace {

constexpr std::string_view k_demands[] = {"character", "output_color"};
constexpr std::string_view k_systems[] = {"H1"};

std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "skin",
                          .summary = "the growth mesh moved by its joints, linear blend or dual quaternions",
                          .source = "Kavan et al. 2008, Geometric skinning with approximate dual quaternion blending",
                          .demands = k_demands,
                          .stage = registry::Stage::generate,
                          .systems = k_systems,
                          .dispatches = dispatches}};
  return pass;
}

}  // namespace cuticle::render::skin
