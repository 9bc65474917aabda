#include "strands/shaping/shaping.h"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

#include "strands/growing/random.h"
#include "strands/shaping/clumping/clumping.h"
#include "strands/spline/frames.h"

namespace cuticle::strands {

namespace {

/// Root and tip of strands, which say who belongs to whom.
double gap(const Groom& groom, std::uint32_t a, std::uint32_t b) {
  const auto one = groom.strand(a), other = groom.strand(b);
  return double(glm::distance(one.front(), other.front())) + 0.3 * double(glm::distance(one.back(), other.back()));
}

std::vector<std::uint32_t> leaders_of(const Groom& groom, const ShapingBlocks& blocks, std::uint64_t seed) {
  std::vector<std::uint32_t> leader(groom.strand_count()), leaders;
  std::iota(leader.begin(), leader.end(), 0u);
  const auto clumping = blocks.find("clumping");
  if (clumping == blocks.end()) return leader;
  const double share = 1 / registry::from_values<clumping::Parameters>(clumping->second).strands_per_lock;
  for (std::uint32_t s : leader)
    if (random_stream(seed, Chance::lock, s).next_unit() < share) leaders.push_back(s);
  if (leaders.empty()) return leader;
  for (std::uint32_t& own : leader)
    own = *std::min_element(leaders.begin(), leaders.end(), [&, s = own](std::uint32_t a, std::uint32_t b) {
      return gap(groom, s, a) < gap(groom, s, b);
    });
  return leader;
}

std::vector<float> lengths_along(std::span<const glm::vec3> points) {
  std::vector<float> travelled(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i)
    travelled[i] = travelled[i - 1] + glm::distance(points[i - 1], points[i]);
  return travelled;
}

std::vector<std::pair<const Shaping*, Shaper>> demanded(const ShapingBlocks& blocks) {
  std::vector<std::pair<const Shaping*, Shaper>> list;
  for (const Shaping* shaping : shapings())
    if (const auto block = blocks.find(shaping->entry.name); block != blocks.end())
      list.emplace_back(shaping, shaping->make(block->second));
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first->order < b.first->order; });
  return list;
}

}  // namespace

Result<const Shaping*> find_shaping(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Shaping* shaping : shapings()) {
    if (shaping->entry.name == name) return shaping;
    known.push_back(shaping->entry.name);
  }
  std::string list;
  for (std::string_view one : known) list += (list.empty() ? "" : ", ") + std::string(one);
  const std::string near = registry::nearest_name(name, known);
  return usage_error("unknown shaping effect '" + std::string(name) + "' (known: " + list + ")",
                     near.empty() ? "" : "did you mean " + near + "?");
}

void shape(Groom& groom, const ShapingBlocks& blocks, std::span<const glm::vec3> root_normals, std::uint64_t seed) {
  const auto effects = demanded(blocks);
  if (effects.empty()) return;
  const std::vector<std::uint32_t> leaders = leaders_of(groom, blocks, seed);
  const Groom base = groom;
  const auto normal_of = [&](std::uint32_t s) { return root_normals.empty() ? glm::vec3(0, 1, 0) : root_normals[s]; };
  std::vector<StrandFrames> frames(groom.strand_count());
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s) {
    StrandFrames& across = frames[leaders[s]];
    if (across.tangents.empty()) across = frames_along(base.strand(leaders[s]), normal_of(leaders[s]));
    const std::vector<float> travelled = lengths_along(base.strand(s));
    const std::size_t size = std::min(base.strand_size(s), base.strand_size(leaders[s]));
    const ShapedStrand strand{s,
                              leaders[s],
                              seed,
                              {groom.positions.data() + groom.offsets[s], size},
                              base.strand(s),
                              base.strand(leaders[s]),
                              across.normals,
                              across.binormals,
                              travelled,
                              normal_of(s)};
    for (const auto& [shaping, shaper] : effects) shaper(strand);
  }
}

ShapingChance shaping_chance(const ShapedStrand& strand, std::uint32_t owner, std::string_view effect) {
  std::uint32_t key = 2166136261u;  // FNV-1a over the effect's name
  for (char letter : effect) key = (key ^ std::uint32_t(static_cast<unsigned char>(letter))) * 16777619u;
  RandomStream random = random_stream(strand.seed ^ (std::uint64_t(key) << 32), Chance::shaping, owner);
  const auto next = [&] { return float(random.next_word() >> 8) * 0x1p-24f; };
  ShapingChance chance;
  chance.a = next();
  chance.b = next();
  chance.c = next();
  chance.d = next();
  return chance;
}

}  // namespace cuticle::strands
