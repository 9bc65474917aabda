#include <cuticle/shadows/deep_shadow/visibility.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <cuticle/shadows/detail/map_walk.h>

namespace cuticle::shadows::deep_shadow {
namespace {

constexpr std::size_t k_run = 64;
constexpr double k_least_bound = 1e-3;  // of the growing bound, so that 0 grows too

std::uint32_t packed(const Knot& knot) {
  const std::uint32_t depth = std::uint32_t(std::clamp(knot.depth, 0.0f, 65535.0f));
  return depth << 16 | std::uint32_t(std::lround(65535.0f * std::clamp(knot.visibility, 0.0f, 1.0f)));
}
Knot unpacked(std::uint32_t word) { return {float(word >> 16), float(word & 0xffffu) * (1.0f / 65535)}; }

/// Slopes from a piece's first knot that pass every point so far within the bound; visibility never rises.
struct Slopes {
  double least = -std::numeric_limits<double>::infinity(), greatest = 0;

  Slopes through(const Knot& from, const Knot& point, double bound) const {
    const double depth = double(point.depth) - double(from.depth);
    const double rise = double(point.visibility) - double(from.visibility);
    return {std::max(least, (rise - bound) / depth), std::min(greatest, (rise + bound) / depth)};
  }
  Knot at(const Knot& from, float depth) const {
    const double slope = 0.5 * (least + greatest);
    return {depth, float(double(from.visibility) + slope * (double(depth) - double(from.depth)))};
  }
};

/// The knots of a run of texels, and where each begins in it.
void pack_run(const FragmentLists& lists, std::size_t run, float per_unit, double bound, std::size_t pieces,
              PackedFunctions& functions, std::vector<std::uint32_t>& words) {
  std::vector<Knot> exact, knots;
  const std::size_t end = std::min((run + 1) * k_run, lists.first.size() - 1);
  for (std::size_t texel = run * k_run; texel < end; ++texel) {
    functions.begin_in_run[texel] = std::uint16_t(words.size());
    exact_function(lists.of(texel), per_unit, exact);
    compress_to(exact, bound, pieces, knots);
    std::transform(knots.begin(), knots.end(), std::back_inserter(words), packed);
  }
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
  Slopes slopes;
  for (std::size_t i = 1; i < exact.size(); ++i) {
    Slopes next = slopes.through(knots.back(), exact[i], bound);
    if (next.least > next.greatest) {
      knots.push_back(slopes.at(knots.back(), exact[i - 1].depth));
      next = Slopes{}.through(knots.back(), exact[i], bound);
    }
    slopes = next;
  }
  if (exact.size() > 1) knots.push_back(slopes.at(knots.back(), exact.back().depth));
}

void compress_to(std::span<const Knot> exact, double bound, std::size_t pieces, std::vector<Knot>& knots) {
  compress(exact, bound, knots);
  while (knots.size() > pieces + 1) {
    bound = std::max(k_least_bound, 1.5 * bound);
    compress(exact, bound, knots);
  }
}

PackedFunctions pack(const FragmentLists& lists, float per_unit, double bound, std::size_t pieces) {
  const std::size_t texels = lists.first.size() - 1, runs = (texels + k_run - 1) / k_run;
  PackedFunctions functions;
  functions.begin_in_run.resize(texels + 1);
  std::vector<std::vector<std::uint32_t>> words(runs);
  for_each_index(runs, [&](std::size_t run) { pack_run(lists, run, per_unit, bound, pieces, functions, words[run]); });
  for (const std::vector<std::uint32_t>& run : words) {
    functions.begin_of_run.push_back(std::uint32_t(functions.knots.size()));
    functions.knots.insert(functions.knots.end(), run.begin(), run.end());
  }
  functions.begin_of_run.push_back(std::uint32_t(functions.knots.size()));
  if (texels % k_run != 0) functions.begin_in_run[texels] = std::uint16_t(words.back().size());
  return functions;
}

float visibility_at(std::span<const std::uint32_t> words, float depth) {
  const auto after = std::upper_bound(words.begin(), words.end(), depth,
                                      [](float z, std::uint32_t word) { return z < unpacked(word).depth; });
  if (after == words.begin()) return 1;
  const Knot before = unpacked(*(after - 1));
  if (after == words.end()) return before.visibility;
  const Knot behind = unpacked(*after);
  const float t = (depth - before.depth) / (behind.depth - before.depth);
  return between_planes(before.visibility, behind.visibility, t);
}

}  // namespace cuticle::shadows::deep_shadow
