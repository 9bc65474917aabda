#include "strands/shaping/shaping.h"
#include "strands/shaping/clumping/clumping.glslh"

namespace cuticle::strands::clumping {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H9"};
constexpr Parameter k_parameters[] = {
    {.name = "strands_per_lock",
     .unit = "1",
     .minimum = 1,
     .maximum = 1000,
     .default_text = "20",
     .summary = "mean number of strands of a lock"},
    {.name = "strength",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.8",
     .summary = "how far tips move to the leader"},
    {.name = "profile",
     .unit = "1",
     .minimum = 0.1,
     .maximum = 8,
     .default_text = "1",
     .summary = "place where a lock closes: below 1 near the root, above 1 near the tip"},
};

Shaper make(const registry::ParameterValues& values) {
  const float strength = float(values.real("strength")), profile = float(values.real("profile"));
  return [=](const ShapedStrand& strand) {
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] +=
          clumped_point<float>(strand.base[i], strand.leader_base[i], strand.place(i), strength, profile) -
          strand.base[i];
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "clumping",
                                .summary = "strands gather to the leader of their lock",
                                .source = "clumping: docs/systems.md, H9",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               10,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::clumping
