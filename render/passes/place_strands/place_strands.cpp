#include "render/generating.h"

#include "render/frame.h"
#include "render/inputs.h"

namespace cuticle::render::place_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "strands_as_given"};
constexpr Use k_uses[] = {reads<ControlHairs>(), reads<StrandMaker>(), reads<Surfaces>(), writes<DrawnHair>()};
constexpr std::string_view k_systems[] = {"N5"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(writing_drawn({.name = "place_strands",
                               .summary = "the strands of a file as they are, follow hairs beside guides",
                               .source = "TressFX 3.1: follow hairs",
                               .demands = k_demands,
                               .systems = k_systems}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::place_strands
