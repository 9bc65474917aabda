#include "strands/shaping/shaping.h"
#include "strands/shaping/volume/volume.glslh"

namespace cuticle::strands::volume {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H17"};
constexpr Parameter k_parameters[] = {
    {.name = "lift", .unit = "m", .minimum = -0.05, .maximum = 0.1, .default_text = "0.01", .summary = "height gained"},
    {.name = "onset",
     .unit = "m",
     .minimum = 0,
     .maximum = 0.5,
     .default_text = "0.03",
     .summary = "length over which it is gained"},
};

Shaper make(const registry::ParameterValues& values) {
  const float lift = float(values.real("lift")), onset = float(values.real("onset"));
  return [=](const ShapedStrand& strand) {
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += volume_offset<float>(strand.root_normal, strand.travelled[i], lift, onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "volume",
                                .summary = "hair lifted off the surface it roots on",
                                .source = "volume control: docs/systems.md, H17",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               20,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::volume
