#include "render/generating.h"

namespace cuticle::render::place_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "strands_as_given"};
constexpr std::string_view k_systems[] = {"N5"};

}  // namespace

const Pass& entry() {
  static const Pass pass = generating({.name = "place_strands",
                                       .summary = "the strands of a file as they are, follow hairs beside guides",
                                       .source = "TressFX 3.1: follow hairs",
                                       .demands = k_demands,
                                       .systems = k_systems});
  return pass;
}

}  // namespace cuticle::render::place_strands
