#include "shadows/opacity_map/map.h"

#include <bit>

#include <fmt/core.h>

#include "shadows/detail/map_method.h"
#include "shadows/fibres.glslh"

namespace cuticle::shadows::opacity_map {
namespace {

/// A steep segment is cut where it passes a slice.
constexpr float k_pieces_per_step = 1;

/// What is left of a sum that its format may have cut off.
std::uint32_t without(std::uint32_t sum, std::uint32_t own) { return sum - std::min(sum, own); }

/// Sums at the two slices around a depth, and the share of the way from the nearer to the farther.
struct Around {
  std::uint32_t nearer = 0, farther = 0;
  float share = 0;
};

/// Around depth z of a texel, without what the receiver's own fibre has left before either slice.
Around slices_around(const Map& map, std::size_t texel, float z, std::span<const OwnDeposit> own) {
  const float limited = std::min(z, float(map.layers));
  const std::uint32_t slice = std::min(std::uint32_t(limited), map.layers - 1);
  const std::uint32_t* sums = &map.sums[texel * map.layers];
  std::uint32_t own_nearer = 0, own_farther = 0;
  for (const OwnDeposit& deposit : own) {
    own_nearer += deposit.step < slice ? map.table[deposit.covered] : 0;
    own_farther += deposit.step <= slice ? map.table[deposit.covered] : 0;
  }
  return {slice == 0 ? 0 : without(sums[slice - 1], own_nearer), without(sums[slice], own_farther),
          limited - float(slice)};
}

/// The sum there, linear between the slices.
float even_sum(const Around& around) {
  return between_planes(float(around.nearer), float(around.farther), around.share);
}

/// The exponent there of fibres that lie between the slices at random depths, `fibre` each; `power`: seen_power().
float scattered_exponent(const Around& around, float per_unit, float fibre, float power) {
  const float nearer = per_unit * float(around.nearer),
              between = per_unit * float(around.farther - std::min(around.nearer, around.farther));
  return nearer +
         seen_exponent(fibres_of(between, fibre), exponent_of_part(between, fibre, around.share), nearer, power);
}

/// To the 11 significant bits of a half float, ties to even.
std::uint32_t rounded_to_half(std::uint32_t sum) {
  const int dropped = int(std::bit_width(sum)) - 11;
  if (dropped <= 0) return sum;
  const std::uint32_t half = 1u << (dropped - 1), odd = (sum >> dropped) & 1u;
  return ((sum + half - 1 + odd) >> dropped) << dropped;
}

/// Tent weights are linear in sigma: interpolated between the depths of two vertices they give what lies as far between
/// sigma at either depth.
Result<std::vector<float>> look_up_by_vertex(const Map& map, const Settings& settings, const Asked& asked) {
  CUTICLE_ASSIGN(const MapFilter filter, map_filter(map.view, settings.map));
  const float per_unit = exponent_per_unit(settings.map, map.scale), deepest = settings.intervals();
  const auto at_depth = [&](std::size_t i, float, float) {
    const SegmentPlace& place = asked.receivers.segments[i];
    const auto own = own_vertex(asked.groom, asked.receivers, i);
    const auto depth_of = [&](const glm::vec3& p) {
      const LookupPlace there = lookup_place(asked, p, own, map.view.axes);
      const glm::vec3 seen = view_point(map.view.axes, there.point);
      return depth_in_map(map.view, filter, deepest, seen_to_map(map.view, seen).z,
                          free_depth(map.view, filter, there, seen));
    };
    const float from = depth_of(place.from), to = depth_of(place.to), fraction = place.fraction;
    return [&map, per_unit, from, to, fraction](std::size_t texel, std::span<const OwnDeposit> own) {
      return per_unit * between_planes(even_sum(slices_around(map, texel, from, own)),
                                       even_sum(slices_around(map, texel, to, own)), fraction);
    };
  };
  return look_up_receivers(map.view, settings.map, deepest, k_pieces_per_step, asked, at_depth);
}

double scale_of(const strands::Groom& groom, double alpha, const Settings& settings) {
  if (settings.form == Form::graphics_8bit) return 255;
  return fixed_point_scale(alpha, settings.map.accumulation, groom.vertex_count() - groom.strand_count());
}

/// What the form's format leaves of the sums.
void store(Form form, Map& map) {
  const std::size_t bytes = form == Form::compute ? 4 : form == Form::graphics_half ? 2 : 1;
  map.texel_bytes = bytes * (form == Form::compute ? map.layers : k_target_planes);
  if (form == Form::graphics_8bit)
    for (std::uint32_t& sum : map.sums) {
      map.clamped += sum > 255;
      sum = std::min(sum, 255u);
    }
  if (form == Form::graphics_half)
    for (std::uint32_t& sum : map.sums) sum = rounded_to_half(sum);
}

}  // namespace

Result<void> Settings::check() const {
  if (form != Form::compute && layers() > k_target_planes)
    return usage_error(fmt::format("opacity_map: {} slices are outside 2 .. {} of form={}", slices, k_target_planes + 1,
                                   form == Form::graphics_8bit ? "graphics_8bit" : "graphics_half"),
                       "form=compute, or fewer slices");
  return check_map_bytes(map, layers());
}

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  const Accumulation& accumulation = settings.map.accumulation;
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, settings.intervals(),
                      settings.form == Form::compute ? k_any_shape : k_square_shape);
  map.layers = settings.layers();
  map.scale = scale_of(groom, alpha, settings);
  map.sums.resize(map.view.texels() * map.layers);
  map.table = deposit_table(alpha, accumulation, map.scale);
  const auto deposit = [&](std::size_t texel, std::uint32_t covered, std::uint32_t step) {
    if (step < map.layers) add_to(map.sums[texel * map.layers + step], map.table[covered]);
  };
  for_each_covered_texel(map.view, groom, k_pieces_per_step, deposit);
  sum_along_depth(map.sums, map.layers);
  map.fibre = sums_of_fibre(map.view, groom);
  store(settings.form, map);
  return map;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked) {
  if (settings.vertex_weights && !asked.receivers.segments.empty()) return look_up_by_vertex(map, settings, asked);
  const float per_unit = exponent_per_unit(settings.map, map.scale),
              fibre = fibre_exponent(map.fibre, map.table, per_unit);
  const bool is_scattered = settings.is_scattered();
  const auto at_depth = [&](std::size_t, float z, float power) {
    return [&, z, power](std::size_t texel, std::span<const OwnDeposit> own) {
      const Around around = slices_around(map, texel, z, own);
      return is_scattered ? scattered_exponent(around, per_unit, fibre, power) : per_unit * even_sum(around);
    };
  };
  return look_up_receivers(map.view, settings.map, settings.intervals(), k_pieces_per_step, asked, at_depth);
}

}  // namespace cuticle::shadows::opacity_map
