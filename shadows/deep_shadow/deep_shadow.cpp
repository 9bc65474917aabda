// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/deep_shadow/own_steps.glslh"
#include "shadows/deep_shadow/settings.h"
#include "shadows/detail/map_method.h"

namespace cuticle::shadows::deep_shadow {
namespace {

constexpr std::string_view k_storages[] = {"words", "halves"};
constexpr registry::StudyCase k_cases[] = {{"bound 0.1", "error_bound=0.1"}, {"bound 0.02", "error_bound=0.02"}};

struct Map {
  MapView view;
  PackedFunctions functions;
  std::vector<std::uint32_t> table;  ///< of deposits
  std::size_t bytes() const { return functions.bytes(); }
};

Result<Map> build(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  CUTICLE_ASSIGN(const FragmentLists lists, sort_fragments(groom, alpha, axes, settings.map));
  const float per_unit = exponent_per_unit(settings.map, lists.scale);
  return Map{lists.view, pack(lists, per_unit, settings.error_bound, settings.pieces, settings.storage), lists.table};
}

/// The visibility at a depth of a texel without the receiver's own fibre (own_steps.glslh).
float visibility_without(const Map& map, float bound, std::size_t texel, float z, std::span<const OwnDeposit> own) {
  const float all = visibility_at(map.functions, texel, z);
  if (own.empty() || all == 1) return all;
  const float moved = depth_rounding(map.functions, texel);
  OwnSteps<float> steps = no_own_steps(z + moved);
  for (const OwnDeposit& deposit : own)
    if (map.table[deposit.covered] > 0) steps = with_own_step(steps, float(deposit.step), z + moved);
  const float first = steps.first - moved, end = std::min(z, steps.end + moved);
  if (first >= z) return all;
  return without_own(visibility_at(map.functions, texel, first), visibility_at(map.functions, texel, end), all, bound);
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked) {
  const auto bound = float(std::max(double(k_least_bound), settings.error_bound));
  const auto at_depth = [&](std::size_t, float z, float) {
    return [&, z](std::size_t texel, std::span<const OwnDeposit> own) {
      return std::log(std::max(0x1p-17f, visibility_without(map, bound, texel, z, own)));
    };
  };
  return look_up_receivers(map.view, settings.map, k_behind_lists, k_list_pieces_per_step, asked, at_depth);
}

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.pieces, "pieces", 1, k_max_pieces, "most straight pieces of a texel's function");
  members(settings.error_bound, "error_bound", "1", 0, 0.5,
          "largest error of a texel's visibility, where the pieces suffice");
  members(settings.storage, "storage", k_storages,
          "a knot in 32 bits; or in 16: 9 of depth, over the depths of 8 x 8 texels, and 7 of visibility");
  describe(members, settings.map);
  describe_room(members, settings.map);
}

/// Passes: fit, six that make the lists (list_gpu.h), compress, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, build, look_up>(
      {.name = "deep_shadow",
       .summary = "a visibility function per texel, compressed within an error bound (deep shadow map)",
       .source = "Lokovic and Veach 2000, Deep Shadow Maps, section 3",
       .study_cases = k_cases,
       .dispatches = passes_per_light<9>});
  return method;
}

}  // namespace cuticle::shadows::deep_shadow
