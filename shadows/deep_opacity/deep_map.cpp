#include <cuticle/shadows/deep_opacity/deep_map.h>

#include <algorithm>
#include <functional>

#include <cuticle/shadows/detail/map_method.h>

namespace cuticle::shadows::deep_opacity {
namespace {

using Word = std::uint32_t;

/// Projected length over the depth behind the nearest fibre, each piece counted at its middle.
std::vector<Word> depth_histogram(const strands::Groom& groom, const Map& map) {
  std::vector<Word> histogram(k_depth_steps);
  const float columns = float(map.view.columns), rows = float(map.view.rows);
  for_each_piece(map.view, groom, k_pieces_per_step, [&](const Footprint<float>& footprint) {
    const glm::vec3 middle = piece_middle(footprint);
    if (!(middle.x >= 0 && middle.y >= 0 && middle.x < columns && middle.y < rows)) return;
    const Word nearest = map.nearest[texel_index(map.view, int(middle.x), int(middle.y))];
    const Word step = Word(std::max(0, int(std::floor(middle.z))));
    if (nearest != k_no_depth && step >= nearest)
      add_to(histogram[std::min(step - nearest, k_depth_steps - 1)], piece_weight(footprint.size));
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

LayerEnds layer_ends(std::span<const Word> histogram, const Settings& settings) {
  const Word depth = depth_of(histogram), total = total_of(histogram);
  const std::vector<Word> shares = layer_shares(settings);
  LayerEnds ends{};
  ends.count = settings.layers;
  for (Word i = 0; i < settings.layers; ++i)
    ends.end[i] = settings.spacing == Spacing::equal_opacity
                      ? quantile(histogram, part_of(total, i + 1, settings.layers))
                      : shared_end(depth, shares[i]);
  return rising(ends, depth);
}

/// Deposits every piece into the layer that holds it.
void fill_layers(const strands::Groom& groom, std::span<const Word> table, Map& map) {
  for_each_covered_texel(map.view, groom, k_pieces_per_step, [&](std::size_t texel, Word covered, Word step) {
    add_to(map.sums[texel * map.ends.count + layer_of(map.ends, step - map.nearest[texel])], table[covered]);
  });
}

/// The exponent at depth z of a texel whose nearest fibre lies at `nearest`, linear within its layer; before(i): at the
/// end of its layer i.
float exponent_at(const LayerEnds& ends, Word nearest, float z, const auto& before) {
  if (nearest == k_no_depth) return 0;
  const float depth = z - float(nearest);
  if (!(depth > 0)) return 0;
  const Word layer = layer_of(ends, Word(depth));
  const float begin = float(layer_begin(ends, layer)), end = float(ends.end[layer]);
  const float t = std::min(1.0f, (depth - begin) / (end - begin));
  return between_planes(layer == 0 ? 0.0f : before(layer - 1), before(layer), t);
}

/// How many of the thresholds, which fall, are not below the sum.
Word code_of(std::span<const Word> thresholds, Word sum) {
  return Word(std::lower_bound(thresholds.begin(), thresholds.end(), sum, std::greater_equal<>()) - thresholds.begin());
}

Result<std::vector<float>> look_up_packed(const Map& map, const Settings& settings, std::span<const glm::vec3> points) {
  const std::vector<float> exponents = code_exponents();
  const auto at_depth = [&](float z) {
    return [&, z](std::size_t texel) {
      const Word nearest = packed_depth(map.packed.nearest[texel / 2], Word(texel % 2));
      return exponent_at(map.ends, nearest, z, [&](Word layer) {
        const std::size_t i = texel * map.ends.count + layer;
        return exponents[packed_code(map.packed.codes[i / 4], Word(i % 4))];
      });
    };
  };
  return look_up_points(map.view, settings.map, k_deepest, points, at_depth);
}

}  // namespace

Result<Settings> settings_from(const registry::ParameterValues& values) {
  Settings settings;
  settings.map = map_settings("deep_opacity", values);
  settings.layers = Word(values.integer("layers"));
  const std::string& spacing = values.choice("spacing");
  settings.spacing = spacing == "geometric" ? Spacing::geometric
                     : spacing == "equal"   ? Spacing::equal
                                            : Spacing::equal_opacity;
  settings.first_layer = values.real("first_layer");
  settings.bytes = values.choice("storage") == "bytes";
  CUTICLE_TRY(check_map_bytes(settings.map, settings.layers + 1));
  return settings;
}

std::vector<Word> layer_shares(const Settings& settings) {
  const double count = settings.layers, given = settings.first_layer;
  const double first = given > 0 ? given : settings.layers <= 4 ? 1.0 / 32 : 1.0 / 128;
  std::vector<Word> shares;
  for (Word i = 0; i < settings.layers; ++i) {
    const double geometric = std::pow(first, (count - 1 - i) / std::max(1.0, count - 1));
    const double share = settings.spacing == Spacing::geometric ? geometric : (i + 1) / count;
    shares.push_back(Word(std::lround(65536 * share)));
  }
  return shares;
}

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  const Accumulation& accumulation = settings.map.accumulation;
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, float(k_depth_steps));
  map.scale = fixed_point_scale(alpha, accumulation, groom.vertex_count() - groom.strand_count());
  map.nearest = nearest_depths(map.view, groom, k_pieces_per_step);
  map.ends = layer_ends(depth_histogram(groom, map), settings);
  map.sums.resize(map.view.texels() * settings.layers);
  fill_layers(groom, deposit_table(alpha, accumulation, map.scale), map);
  sum_along_depth(map.sums, settings.layers);
  if (settings.bytes) {
    map.packed = pack(map, accumulation.k);
    map.sums = {};
    map.nearest = {};
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

PackedMap pack(const Map& map, double k) {
  const std::vector<Word> thresholds = code_thresholds(k, map.scale);
  PackedMap packed;
  packed.codes.resize((map.sums.size() + 3) / 4);
  packed.nearest.resize((map.nearest.size() + 1) / 2);
  for_each_index(packed.codes.size(), [&](std::size_t word) {
    for (std::size_t i = 4 * word; i < 4 * word + 4; ++i)
      packed.codes[word] |= code_of(thresholds, i < map.sums.size() ? map.sums[i] : 0) << (8 * (i % 4));
  });
  for_each_index(packed.nearest.size(), [&](std::size_t word) {
    for (std::size_t i = 2 * word; i < 2 * word + 2; ++i)
      packed.nearest[word] |= std::min(i < map.nearest.size() ? map.nearest[i] : k_no_depth, k_no_depth_16)
                              << (16 * (i % 2));
  });
  return packed;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, std::span<const glm::vec3> points) {
  if (settings.bytes) return look_up_packed(map, settings, points);
  const float per_unit = exponent_per_unit(settings.map, map.scale);
  const auto at_depth = [&](float z) {
    return [&, z](std::size_t texel) {
      const Word* sums = &map.sums[texel * map.ends.count];
      const auto before = [sums](Word layer) { return float(sums[layer]); };
      return per_unit * exponent_at(map.ends, map.nearest[texel], z, before);
    };
  };
  return look_up_points(map.view, settings.map, k_deepest, points, at_depth);
}

}  // namespace cuticle::shadows::deep_opacity
