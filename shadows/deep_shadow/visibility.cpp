#include "shadows/deep_shadow/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shadows/deep_shadow/own_steps.glslh"
#include "shadows/deep_shadow/slopes.glslh"
#include "shadows/detail/map_walk.h"

namespace cuticle::shadows::deep_shadow {
namespace {

constexpr std::uint32_t k_half_visibility_bits = 7, k_half_visibility = 127, k_half_depth = 511;

Slopes<double> through(const Slopes<double>& slopes, const Knot& from, const Knot& point, double bound) {
  return slopes_through(slopes, double(point.depth) - double(from.depth),
                        double(point.visibility) - double(from.visibility), bound);
}
Knot at(const Slopes<double>& slopes, const Knot& from, float depth) {
  return {depth, float(double(from.visibility) + best_slope(slopes) * (double(depth) - double(from.depth)))};
}

/// The knots of a tile's texels, one after the other.
struct TileKnots {
  std::vector<Knot> knots;
  std::array<std::uint16_t, k_tile_texels> begin{};
};
TileKnots knots_of_tile(const FragmentLists& lists, std::size_t tile, std::uint32_t tile_columns, float per_unit,
                        double bound, std::size_t pieces) {
  TileKnots result;
  std::vector<Knot> exact, knots;
  for (std::uint32_t i = 0; i < k_tile_texels; ++i) {
    const std::size_t column = k_tile_side * (tile % tile_columns) + i % k_tile_side;
    const std::size_t row = k_tile_side * (tile / tile_columns) + i / k_tile_side;
    result.begin[i] = std::uint16_t(result.knots.size());
    if (column >= lists.view.columns || row >= lists.view.rows) continue;
    exact_function(lists.of(row * lists.view.columns + column), per_unit, exact);
    compress_to(exact, bound, pieces, knots);
    result.knots.insert(result.knots.end(), knots.begin(), knots.end());
  }
  return result;
}

std::uint16_t to_16_bits(double value) { return std::uint16_t(std::lround(std::clamp(value, 0.0, 65535.0))); }

void append(const Knot& knot, const KnotTile& tile, PackedFunctions& functions) {
  const double visibility = std::clamp(double(knot.visibility), 0.0, 1.0);
  if (functions.storage == KnotStorage::words) {
    functions.numbers.push_back(to_16_bits(double(knot.depth)));
    functions.numbers.push_back(to_16_bits(65535 * visibility));
    return;
  }
  const std::uint32_t depth = to_16_bits((double(knot.depth) - double(tile.depth)) / double(tile.step));
  const std::uint32_t code = std::min(depth, k_half_depth) << k_half_visibility_bits;
  functions.numbers.push_back(std::uint16_t(code | to_16_bits(k_half_visibility * visibility)));
}

/// Appends a tile's knots and says where they begin.
void append(const TileKnots& tile, PackedFunctions& functions) {
  const std::size_t knots = functions.numbers.size() / (functions.storage == KnotStorage::words ? 2 : 1);
  KnotTile entry{std::uint32_t(knots), std::uint32_t(functions.begin_in_tile.size())};
  if (!tile.knots.empty()) {
    const auto by_depth = [](const Knot& a, const Knot& b) { return a.depth < b.depth; };
    const auto [nearest, deepest] = std::minmax_element(tile.knots.begin(), tile.knots.end(), by_depth);
    functions.begin_in_tile.insert(functions.begin_in_tile.end(), tile.begin.begin(), tile.begin.end());
    entry.depth = to_16_bits(double(nearest->depth));
    entry.step = to_16_bits(std::max(1.0, std::ceil(double(deepest->depth - nearest->depth) / k_half_depth)));
  }
  functions.tiles.push_back(entry);
  for (const Knot& knot : tile.knots) append(knot, entry, functions);
}

Knot knot_of(const PackedFunctions& functions, const KnotTile& tile, std::size_t i) {
  if (functions.storage == KnotStorage::words)
    return {float(functions.numbers[2 * i]), float(functions.numbers[2 * i + 1]) * (1.0f / 65535)};
  const std::uint32_t number = functions.numbers[i];
  return {float(tile.depth + tile.step * (number >> k_half_visibility_bits)),
          float(number & k_half_visibility) * (1.0f / k_half_visibility)};
}

std::size_t tile_at(const PackedFunctions& functions, std::size_t column, std::size_t row) {
  return row / k_tile_side * functions.tile_columns + column / k_tile_side;
}

}  // namespace

void exact_function(std::span<const Fragment> fragments, float per_unit, std::vector<Knot>& knots) {
  knots.clear();
  float visibility = 1;
  for (const Fragment& fragment : fragments) {
    const float begin = float(fragment.depth);
    if (knots.empty() || knots.back().depth < begin) knots.push_back({begin, visibility});
    visibility = std::exp(per_unit * float(fragment.sum));
    if (knots.back().depth > begin)
      knots.back().visibility = visibility;  // another fragment in the same step
    else
      knots.push_back({begin + 1, visibility});
  }
}

void compress(std::span<const Knot> exact, double bound, std::vector<Knot>& knots) {
  knots.clear();
  if (exact.empty()) return;
  knots.push_back(exact[0]);
  Slopes<double> slopes = slopes_up_to(0.0);
  for (std::size_t i = 1; i < exact.size(); ++i) {
    Slopes<double> next = through(slopes, knots.back(), exact[i], bound);
    if (next.least > next.greatest) {
      knots.push_back(at(slopes, knots.back(), exact[i - 1].depth));
      next = through(slopes_up_to(0.0), knots.back(), exact[i], bound);
    }
    slopes = next;
  }
  if (exact.size() > 1) knots.push_back(at(slopes, knots.back(), exact.back().depth));
}

void compress_to(std::span<const Knot> exact, double bound, std::size_t pieces, std::vector<Knot>& knots) {
  compress(exact, bound, knots);
  while (knots.size() > pieces + 1) {
    bound = std::max(double(k_least_bound), 1.5 * bound);
    compress(exact, bound, knots);
  }
}

PackedFunctions pack(const FragmentLists& lists, float per_unit, double bound, std::size_t pieces,
                     KnotStorage storage) {
  PackedFunctions functions;
  functions.storage = storage;
  functions.columns = lists.view.columns;
  functions.tile_columns = (lists.view.columns + k_tile_side - 1) / k_tile_side;
  std::vector<TileKnots> tiles(functions.tile_columns * ((lists.view.rows + k_tile_side - 1) / k_tile_side));
  for_each_index(tiles.size(), [&](std::size_t tile) {
    tiles[tile] = knots_of_tile(lists, tile, functions.tile_columns, per_unit, bound, pieces);
  });
  for (const TileKnots& tile : tiles) append(tile, functions);
  append({}, functions);
  return functions;
}

float depth_rounding(const PackedFunctions& functions, std::size_t texel) {
  const std::size_t column = texel % functions.columns, row = texel / functions.columns;
  return functions.storage == KnotStorage::words ? 0
                                                 : 0.5f * float(functions.tiles[tile_at(functions, column, row)].step);
}

float visibility_at(const PackedFunctions& functions, std::size_t texel, float depth) {
  const std::size_t column = texel % functions.columns, row = texel / functions.columns;
  const std::size_t t = tile_at(functions, column, row);
  const KnotTile &tile = functions.tiles[t], &next = functions.tiles[t + 1];
  if (tile.first_knot == next.first_knot) return 1;
  const std::size_t i = row % k_tile_side * k_tile_side + column % k_tile_side;
  const std::uint16_t* begins = &functions.begin_in_tile[tile.first_begin];
  const std::size_t first = tile.first_knot + begins[i];
  const std::size_t last = i + 1 < k_tile_texels ? tile.first_knot + begins[i + 1] : next.first_knot;
  std::size_t after = first;  // the first knot behind the depth
  for (std::size_t count = last - first; count > 0;) {
    const std::size_t half = count / 2;
    const bool before = knot_of(functions, tile, after + half).depth <= depth;
    after = before ? after + half + 1 : after;
    count = before ? count - half - 1 : half;
  }
  if (after == first) return 1;
  const Knot before = knot_of(functions, tile, after - 1);
  if (after == last) return before.visibility;
  const Knot behind = knot_of(functions, tile, after);
  const float t_between = (depth - before.depth) / (behind.depth - before.depth);
  return between_planes(before.visibility, behind.visibility, t_between);
}

}  // namespace cuticle::shadows::deep_shadow
