#include "shadows/deep_opacity/deep_map.h"

#include <algorithm>
#include <array>
#include <functional>

#include "shadows/deep_opacity/tiles.glslh"
#include "shadows/deep_opacity/tiles.h"
#include "shadows/detail/map_method.h"

namespace cuticle::shadows::deep_opacity {
namespace {

using Word = std::uint32_t;

/// Layers of a texel's own hair are thinner toward the light, where hair is seen: the first i of n hold (i / n)^k_front
/// of the hair. Ours, as bench/against_reference.py measures it.
constexpr double k_front = 1.5;

/// Each texel's nearest depth step and the complement of its farthest, both k_no_depth where it has no fibre.
std::vector<Word> texel_depths(const MapView& view, const strands::Groom& groom) {
  std::vector<Word> depths(2 * view.texels(), k_no_depth);
  for_each_covered_texel(view, groom, k_pieces_per_step, [&](std::size_t texel, Word, Word step) {
    lower_to(depths[2 * texel], step);
    lower_to(depths[2 * texel + 1], ~step);
  });
  return depths;
}

/// Adds a piece at its middle, by its projected length, to the depths behind the nearest fibre there.
void count_piece(const Footprint<float>& footprint, bool sampled, const MapView& view, std::span<const Word> depths,
                 bool by_texel, std::span<Word> histogram) {
  const glm::vec3 middle = piece_middle(footprint);
  if (!(middle.x >= 0 && middle.y >= 0 && middle.x < float(view.columns) && middle.y < float(view.rows))) return;
  const std::size_t texel = 2 * texel_index(view, int(middle.x), int(middle.y));
  const Word nearest = depths[texel], extent = found_extent(nearest, depths[texel + 1]);
  const Word step = Word(std::max(0, int(std::floor(middle.z)))), weight = piece_weight(footprint.size);
  if (nearest != k_no_depth && step >= nearest)
    add_to(histogram[table_step(layer_step(step - nearest, extent, by_texel))], weight);
  if (!sampled) return;
  add_to(histogram[k_weights], weight);
  add_to(histogram[k_coverages], weight * middle_coverage(footprint.half_width));
}

/// Projected length over the depth behind the nearest fibre, and the sums behind them (layers.glslh).
std::vector<Word> depth_histogram(const strands::Groom& groom, const MapView& view, std::span<const Word> depths,
                                  bool by_texel) {
  std::vector<Word> histogram(k_histogram_words);
  const Word every = one_in(Word(groom.vertex_count() - groom.strand_count()));
  for_each_index(groom.strand_count(), [&](std::size_t s) {
    const Word first = groom.offsets[s], last = groom.offsets[s + 1] - 1;
    for (Word v = first; v < last; ++v) {
      const Word segment = v - Word(s);
      if (!is_counted(segment, every)) continue;
      for_each_piece(view, groom, v, v == first, v + 1 == last, k_pieces_per_step, [&](const auto& footprint) {
        count_piece(footprint, is_sampled(segment), view, depths, by_texel, histogram);
      });
    }
  });
  return histogram;
}

Word total_of(std::span<const Word> histogram) {
  Word total = 0;
  for (Word weight : histogram) total += weight;
  return total;
}

/// One past the deepest step that holds anything.
Word depth_of(std::span<const Word> histogram) {
  Word depth = 1;
  for (Word step = 0; step < k_depth_steps; ++step)
    if (histogram[step] > 0) depth = step + 1;
  return depth;
}

/// One past the first step at which the running sum reaches the target.
Word quantile(std::span<const Word> histogram, Word target) {
  Word sum = 0;
  for (Word step = 0; step < k_depth_steps; ++step)
    if ((sum += histogram[step]) >= target) return step + 1;
  return k_depth_steps;
}

LayerEnds layer_ends(std::span<const Word> with_sums, const Settings& settings) {
  const std::span histogram = with_sums.first(k_depth_steps);
  const Word depth = depth_of(histogram), total = total_of(histogram);
  const std::vector<Word> shares = layer_shares(settings);
  LayerEnds ends{};
  ends.count = settings.layers;
  for (Word i = 0; i < settings.layers; ++i)
    ends.end[i] = settings.spacing == Spacing::equal_opacity ? quantile(histogram, part_of(total, shares[i], 65536))
                                                             : shared_end(depth, shares[i]);
  return rising(ends);
}

/// The layer of each depth step.
std::vector<Layer> layer_table(const LayerEnds& ends) {
  std::vector<Layer> layers;
  for (Word step = 0; step < k_depth_steps; ++step) layers.push_back(layer_at(ends, step));
  return layers;
}

/// Deposits every piece into the layer that holds it.
void fill_layers(const strands::Groom& groom, std::span<const Word> depths, Map& map) {
  const std::vector<Layer> layers = layer_table(map.ends);
  for_each_covered_texel(map.view, groom, k_pieces_per_step, [&](std::size_t texel, Word covered, Word step) {
    const Word nearest = depths[2 * texel], extent = found_extent(nearest, depths[2 * texel + 1]);
    const Word layer = layers[table_step(layer_step(step - nearest, extent, map.by_texel))].index;
    add_to(map.sums[texel * map.ends.count + layer], map.table[covered]);
  });
}

/// What the receiver's own fibre has left in a texel: before the end of layer i, and whether it is the nearest or the
/// farthest there.
struct OwnLayers {
  std::array<Word, k_max_layers> before{};
  bool is_nearest = false, is_farthest = false;
};
OwnLayers own_layers(const Map& map, std::span<const Layer> layers, Word range, std::span<const OwnDeposit> own) {
  OwnLayers result;
  for (const OwnDeposit& deposit : own) {
    const Word nearest = range_nearest(range), behind = deposit.step - std::min(deposit.step, nearest);
    for (Word i = layers[table_step(layer_step(behind, range_extent(range), map.by_texel))].index; i < map.ends.count;
         ++i)
      result.before[i] += map.table[deposit.covered];
    result.is_nearest = result.is_nearest || behind == 0;
    result.is_farthest = result.is_farthest || deposit.step >= range_farthest(range);
  }
  return result;
}

/// The exponent at depth z of a texel as it is stored, without the receiver's own fibre; `power`: LookupPlace::power;
/// exponent_before(i, own): at the end of number i of the map, of which `own` is left out.
float exponent_at(const Map& map, std::span<const Layer> layers, std::size_t texel, float z, float power,
                  std::span<const OwnDeposit> own, const auto& exponent_before) {
  const Word range = map.ranges[texel];
  const float depth = z - float(range_nearest(range));
  if (range == k_no_range || !(depth > 0)) return 0;
  const OwnLayers mine = own.empty() ? OwnLayers{} : own_layers(map, layers, range, own);
  const auto before_end = [&](Word layer) {
    return exponent_before(texel * map.ends.count + layer, mine.before[layer]);
  };
  const float extent = depth_extent<float>(range);
  if (depth >= extent) return before_end(map.ends.count - 1);
  const float in_layers = layer_scale(extent, map.by_texel);
  const Layer& layer = layers[table_step(Word(depth * in_layers))];
  const float before = layer.index == 0 ? 0.0f : before_end(layer.index - 1);
  return exponent_within(layer, extent * in_layers, depth * in_layers, in_layers, before, before_end(layer.index),
                         mine.is_nearest ? 0.0f : map.fibre_exponent, mine.is_farthest ? 0.0f : map.fibre_exponent,
                         map.spread_exponent, power);
}

/// Looks receivers up by exponent_before of exponent_at.
Result<std::vector<float>> look_up_by(const Map& map, const Settings& settings, const Asked& asked,
                                      const auto& exponent_before) {
  const std::vector<Layer> layers = layer_table(map.ends);
  return look_up_receivers(
      map.view, settings.map, k_deepest, k_pieces_per_step, asked, [&](std::size_t, float z, float power) {
        return [&, z, power](std::size_t texel, std::span<const OwnDeposit> own) {
          const std::size_t stored = map.slots.empty() ? texel : stored_texel(map, texel);
          return stored == k_no_slot ? 0.0f : exponent_at(map, layers, stored, z, power, own, exponent_before);
        };
      });
}

/// How many of the thresholds, which fall, are not below the sum.
Word code_of(std::span<const Word> thresholds, Word sum) {
  return Word(std::lower_bound(thresholds.begin(), thresholds.end(), sum, std::greater_equal<>()) - thresholds.begin());
}

/// The own fibre is rounded as the whole was, so that a texel that holds nothing else lets all light through.
Result<std::vector<float>> look_up_packed(const Map& map, const Settings& settings, const Asked& asked) {
  const std::vector<float> exponents = code_exponents();
  const std::vector<Word> thresholds = code_thresholds(settings.map.accumulation.k, map.scale);
  return look_up_by(map, settings, asked, [&](std::size_t i, Word own) {
    const float all = exponents[packed_code(map.codes[i / 4], Word(i % 4))];
    return own == 0 ? all : std::min(0.0f, all - exponents[code_of(thresholds, own)]);
  });
}

}  // namespace

std::vector<Word> layer_shares(const Settings& settings) {
  const double count = settings.layers, given = settings.first_layer;
  const double first = given > 0 ? given : settings.layers <= 4 ? 1.0 / 32 : 1.0 / 128;
  std::vector<Word> shares;
  for (Word i = 0; i < settings.layers; ++i) {
    const double geometric = std::pow(first, (count - 1 - i) / std::max(1.0, count - 1)), even = (i + 1) / count;
    const bool is_front = settings.by_texel && settings.spacing == Spacing::equal_opacity;
    const double share = settings.spacing == Spacing::geometric ? geometric : is_front ? std::pow(even, k_front) : even;
    shares.push_back(Word(std::lround(65536 * share)));
  }
  return shares;
}

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  const Accumulation& accumulation = settings.map.accumulation;
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, float(k_depth_steps));
  map.scale = fixed_point_scale(alpha, accumulation, groom.vertex_count() - groom.strand_count());
  const std::vector<Word> depths = texel_depths(map.view, groom);
  const std::vector<Word> histogram = depth_histogram(groom, map.view, depths, settings.by_texel);
  map.by_texel = settings.by_texel;
  map.table = deposit_table(alpha, accumulation, map.scale);
  map.ends = layer_ends(histogram, settings);
  map.fibre = fibre_coverage(histogram[k_weights], histogram[k_coverages]);
  map.fibre_exponent = exponent_per_unit(settings.map, map.scale) * float(map.table[map.fibre]);
  map.spread_exponent = accumulation.poisson ? 0.0f : map.fibre_exponent;
  map.sums.resize(map.view.texels() * settings.layers);
  fill_layers(groom, depths, map);
  sum_along_depth(map.sums, settings.layers);
  map.ranges.resize(map.view.texels());
  for_each_index(map.view.texels(),
                 [&](std::size_t t) { map.ranges[t] = depth_range(depths[2 * t], ~depths[2 * t + 1]); });
  if (settings.sparse) keep_tiles(map, tile_room(settings));
  if (settings.bytes) {
    map.codes = pack(map, accumulation.k);
    map.sums = {};
  }
  return map;
}

std::vector<Word> code_thresholds(double k, double scale) {
  std::vector<Word> thresholds;
  for (int code = 1; code < 256; ++code)
    thresholds.push_back(Word(std::min(4294967295.0, scale / k * std::log(255 / (code - 0.5)))));
  return thresholds;
}

std::vector<float> code_exponents() {
  std::vector<float> exponents;
  for (int code = 0; code < 256; ++code) exponents.push_back(float(std::log(std::max(0.5, double(code)) / 255)));
  return exponents;
}

std::vector<Word> pack(const Map& map, double k) {
  const std::vector<Word> thresholds = code_thresholds(k, map.scale);
  std::vector<Word> codes((map.sums.size() + 3) / 4);
  for_each_index(codes.size(), [&](std::size_t word) {
    for (std::size_t i = 4 * word; i < 4 * word + 4; ++i)
      codes[word] |= code_of(thresholds, i < map.sums.size() ? map.sums[i] : 0) << (8 * (i % 4));
  });
  return codes;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked) {
  if (settings.bytes) return look_up_packed(map, settings, asked);
  const float per_unit = exponent_per_unit(settings.map, map.scale);
  return look_up_by(map, settings, asked, [&](std::size_t i, Word own) { return per_unit * float(map.sums[i] - own); });
}

}  // namespace cuticle::shadows::deep_opacity
