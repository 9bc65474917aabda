#include "render/passes/surface_shadow/surface_shadow.h"

#include <algorithm>
#include <vector>

#include "render/frame.h"
#include "render/inputs.h"
#include "shadows/method.h"

namespace cuticle::render::surface_shadow {

namespace {

constexpr std::string_view k_demands[] = {"surfaces_cast", "light", "surfaces"};
constexpr Use k_uses[] = {reads<Lights>(),    reads<Surfaces>(),        reads<FibreOpacity>(),
                          reads<DrawnHair>(), may_read<HeadVertices>(), changes<HairTransmittance>(),
                          writes<Maps>()};
constexpr std::string_view k_systems[] = {"F3"};

/// What this pass takes further: the transmittance of whichever method the scene names.
std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const shadows::Method* method : shadows::methods()) names.push_back(method->entry.name);
  return names;
}

constexpr int k_max_columns = 4, k_max_opacities = 3;

int columns(int lights) { return std::clamp(lights, 1, k_max_columns); }

std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape& shape) {
  const int resolution = registry::from_values<Parameters>(values).resolution, lights = int(shape.lights);
  return shape.lights + hair_bands(resolution, lights, shape.max_storage_buffer_bytes);
}

}  // namespace

glm::ivec2 texture_size(int resolution, int lights) {
  return resolution * glm::ivec2(columns(lights), (std::max(lights, 1) + columns(lights) - 1) / columns(lights));
}

std::uint32_t hair_bands(int resolution, int lights, std::uint64_t max_storage_buffer_bytes) {
  const glm::ivec2 size = texture_size(resolution, lights);
  const std::uint64_t held = max_storage_buffer_bytes / (std::uint64_t(size.x) * sizeof(float)) / k_rows_of_a_part,
                      wanted = (std::uint64_t(k_max_opacities * size.y) + k_rows_of_a_part - 1) / k_rows_of_a_part;
  return std::uint32_t((wanted + held - 1) / held);
}

void describe(registry::Members& members, Parameters& p) {
  members(p.resolution, "resolution", 16, 4096, "texels of each light's maps along each side");
  members.millimetres(p.bias, "bias_mm", 0, 1000, "how far behind the surface a strand must lie to be shadowed by it");
  members(p.strand_filter, "strand_filter", "texels", 0.5, 16,
          "half side of the square of a map that is averaged for a strand");
  members(p.surface_filter, "surface_filter", "texels", 0.5, 16,
          "half side of the square of a map that is averaged for a surface");
  members(p.hair_share, "hair_share", "1", 1e-3, 1,
          "of the strands that cast shadows, those that cast on surfaces, wider by as much");
  members(p.wanted, "wanted", "false: light passes through surfaces, and hair casts nothing on them");
}

const Pass& entry() {
  static const std::vector<std::string_view> after = method_names();
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "surface_shadow",
                          .summary = "shadow maps of the lights: what surfaces cast on hair, and hair on surfaces",
                          .source = "Williams 1978; hair by chance: Enderton, Sintorn, Shirley and Luebke 2010",
                          .parameters = registry::table_of<Parameters>(),
                          .demands = k_demands,
                          .stage = registry::Stage::shadow,
                          .systems = k_systems,
                          .dispatches = dispatches,
                          .draws = 1,  // surfaces, of all lights at once
                          .after = after},
                         k_uses};
  return pass;
}

}  // namespace cuticle::render::surface_shadow
