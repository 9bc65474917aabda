#include "sim/clumping/clumping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sim/chains/placing.h"
#include "sim/clumping/clumping.glslh"
#include "strands/growing/random.h"

namespace cuticle::sim::clumping {
namespace {

using chains::k_lanes;
using strands::Chance;
using strands::random_stream;
namespace rest_row = chains::rest_row;
namespace state_row = chains::state_row;

glm::dvec3 root_of(const strands::Groom& rest, std::uint32_t strand) { return glm::dvec3(rest.strand(strand)[0]); }

std::uint32_t nearest_root(const strands::Groom& rest, const std::vector<std::uint32_t>& among,
                           const glm::dvec3& place) {
  return *std::min_element(among.begin(), among.end(), [&](std::uint32_t a, std::uint32_t b) {
    return glm::distance(root_of(rest, a), place) < glm::distance(root_of(rest, b), place);
  });
}

/// Of the groom's attribute; null without.
const strands::Attribute* painted(const strands::Groom& rest) {
  const auto found = rest.attributes.find("clump");
  if (found == rest.attributes.end() || found->second.components != 1) return nullptr;
  if (found->second.domain != strands::Attribute::Domain::strand) return nullptr;
  return found->second.values.size() == rest.strand_count() ? &found->second : nullptr;
}

void lead_by_attribute(const strands::Groom& rest, const strands::Attribute& clump,
                       const std::vector<std::uint32_t>& able, std::vector<std::uint32_t>& guides) {
  std::map<float, std::vector<std::uint32_t>> clumps;
  for (std::uint32_t s : able)
    if (!std::isnan(clump.values[s])) clumps[clump.values[s]].push_back(s);
  for (const auto& [number, members] : clumps) {
    glm::dvec3 mean(0);
    for (std::uint32_t s : members) mean += root_of(rest, s) / double(members.size());
    const std::uint32_t guide = nearest_root(rest, members, mean);
    for (std::uint32_t s : members) guides[s] = guide;
  }
}

void lead_by_chance(const strands::Groom& rest, const Settings& settings, const std::vector<std::uint32_t>& able,
                    std::vector<std::uint32_t>& guides) {
  std::vector<std::uint32_t> leaders;
  for (std::uint32_t s : able)
    if (random_stream(settings.seed, Chance::lock, s).next_unit() < 1.0 / double(settings.strands_per_clump))
      leaders.push_back(s);
  if (leaders.empty()) return;
  tbb::parallel_for(std::size_t(0), able.size(),
                    [&](std::size_t k) { guides[able[k]] = nearest_root(rest, leaders, root_of(rest, able[k])); });
}

/// A strand's chain with its numbers at rest.
template <class Real>
struct Chain {
  const chains::Chains<Real>& chains;
  const chains::ChainPlace& place;
  std::size_t links() const { return chains.blocks[place.block].links; }
  glm::dvec3 anchor() const {
    return chains::vector_at(chains.strand_at(place.block, chains::strand_row::anchor), place.lane);
  }
  double number(std::size_t vertex, int row) const {
    return double(chains.rest_at(place.block, vertex, std::size_t(row))[place.lane]);
  }
  glm::dvec3 target(std::size_t vertex) const {
    return chains::vector_at(chains.rest_at(place.block, vertex, rest_row::target), place.lane);
  }
  std::uint32_t index(std::size_t vertex, int row, int rows) const {
    const std::size_t first = chains.blocks[place.block].first_vertex + vertex;
    return std::uint32_t((first * std::size_t(rows) + std::size_t(row)) * k_lanes + place.lane);
  }
};

/// Where on the guide, in `vertex`, the arc `arc` from the anchor is; false past its end.
template <class Real>
bool find_on_guide(const Chain<Real>& guide, double arc, ClumpedVertex& vertex, glm::dvec3& at_rest) {
  std::size_t below = 1;
  while (below <= guide.links() && guide.number(below, rest_row::reach) < arc * (1 - 1e-6)) ++below;
  if (below > guide.links()) return false;
  const double end = guide.number(below, rest_row::reach), begin = end - guide.number(below, rest_row::length);
  vertex.between = std::clamp((arc - begin) / (end - begin), 0.0, 1.0);
  vertex.most_squared = 1.21 * end * end;
  vertex.above = guide.index(below - 1, state_row::here, state_row::count);
  vertex.below = guide.index(below, state_row::here, state_row::count);
  at_rest = guide_place(guide.target(below - 1), guide.target(below), vertex.between);
  return true;
}

/// The share of the clump's spring in both.
double share_of(double rate, double other) { return rate > 0 ? 1 / (1 + (other / rate) * (other / rate)) : 0; }

template <class Real>
void join(chains::Chains<Real>& chains, std::uint32_t strand, std::uint32_t leader, const Settings& settings,
          double tightness, std::vector<ClumpedVertex>& vertices) {
  const Chain<Real> own{chains, chains.places[strand]}, guide{chains, chains.places[leader]};
  const double length = own.number(own.links(), rest_row::reach);
  for (std::size_t i = 1; i <= own.links(); ++i) {
    const double arc = own.number(i, rest_row::reach), pull = own.number(i, rest_row::pull);
    ClumpedVertex vertex{
        .apart = guide.anchor() - own.anchor(), .at_rest = own.target(i), .strand = strand, .guide = leader};
    glm::dvec3 guide_at_rest(0);
    if (!find_on_guide(guide, arc, vertex, guide_at_rest)) return;
    const glm::dvec3 offset = vertex.at_rest - vertex.apart - guide_at_rest;
    const double kept = 1 - tightness_at(tightness, arc / length, settings.profile);
    vertex.share = share_of(settings.rate, pull);
    vertex.base = vertex.at_rest * (1 - vertex.share) + (vertex.apart + offset * kept) * vertex.share;
    vertex.target = own.index(i, rest_row::target, rest_row::count);
    chains.rest[own.index(i, rest_row::pull, rest_row::count)] = Real(std::hypot(pull, settings.rate));
    vertices.push_back(vertex);
  }
}

}  // namespace

std::vector<std::uint32_t> guides_of(const strands::Groom& rest, const Settings& settings) {
  std::vector<std::uint32_t> guides(rest.strand_count()), able;
  std::iota(guides.begin(), guides.end(), 0u);
  for (std::uint32_t s : guides)
    if (rest.strand_size(s) > 1) able.push_back(s);
  if (const strands::Attribute* clump = painted(rest))
    lead_by_attribute(rest, *clump, able, guides);
  else
    lead_by_chance(rest, settings, able, guides);
  return guides;
}

template <class Real>
std::vector<ClumpedVertex> join_clumps(chains::Chains<Real>& chains, const strands::Groom& rest,
                                       const Settings& settings) {
  std::vector<ClumpedVertex> vertices;
  if (!(settings.rate > 0)) return vertices;
  const std::vector<std::uint32_t> guides = guides_of(rest, settings);
  for (std::uint32_t s = 0; s < guides.size(); ++s) {
    if (guides[s] == s || !chains.places[s].has_links || !chains.places[guides[s]].has_links) continue;
    const double chance = random_stream(settings.seed, Chance::clump, s).next_unit();
    join(chains, s, guides[s], settings, settings.tightness * (1 - settings.noise * chance), vertices);
  }
  return vertices;
}
template std::vector<ClumpedVertex> join_clumps<float>(chains::Chains<float>&, const strands::Groom&, const Settings&);
template std::vector<ClumpedVertex> join_clumps<double>(chains::Chains<double>&, const strands::Groom&,
                                                        const Settings&);

glm::dmat3 to_rest(const Substep& first) {
  return glm::transpose(chains::matrix_of(first.rotation_begin)) * chains::matrix_of(first.carry);
}

/// aim_of(vertex, the guide's place from its own anchor): where it is to be pulled in rest space.
template <class Real>
void aim_all(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices, const auto& aim_of) {
  using Vector = glm::vec<3, Real>;
  const auto place = [&](std::uint32_t at) {
    return Vector(chains.state[at], chains.state[at + k_lanes], chains.state[at + 2 * k_lanes]);
  };
  tbb::parallel_for(std::size_t(0), vertices.size(), [&](std::size_t k) {
    const ClumpedVertex& v = vertices[k];
    const Vector guide = guide_place(place(v.above), place(v.below), Real(v.between));
    if (!leads(guide, Real(v.most_squared))) return;
    const Vector aim = aim_of(v, guide);
    if (!is_place(aim)) return;
    for (int c = 0; c < 3; ++c) chains.rest[v.target + std::uint32_t(c * k_lanes)] = aim[c];
  });
}

template <class Real>
void aim(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices, const glm::dmat3& to_rest) {
  using Vector = glm::vec<3, Real>;
  const Vector x(to_rest[0]), y(to_rest[1]), z(to_rest[2]);
  aim_all(chains, vertices, [&](const ClumpedVertex& v, const Vector& guide) {
    return clump_aim(Vector(v.base), Real(v.share), guide, x, y, z);
  });
}
template void aim<float>(chains::Chains<float>&, const std::vector<ClumpedVertex>&, const glm::dmat3&);
template void aim<double>(chains::Chains<double>&, const std::vector<ClumpedVertex>&, const glm::dmat3&);

template <class Real>
void aim_at_rest(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices) {
  for (const ClumpedVertex& v : vertices)
    for (int c = 0; c < 3; ++c) chains.rest[v.target + std::uint32_t(c * k_lanes)] = Real(v.at_rest[c]);
}
template void aim_at_rest<float>(chains::Chains<float>&, const std::vector<ClumpedVertex>&);
template void aim_at_rest<double>(chains::Chains<double>&, const std::vector<ClumpedVertex>&);

template <class Real>
void aim_on_skin(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices,
                 std::span<const chains::SkinFrame> frames) {
  using Vector = glm::vec<3, Real>;
  aim_all(chains, vertices, [&](const ClumpedVertex& v, const Vector& guide) {
    const glm::dmat3 to_rest = glm::transpose(frames[v.strand].turn);
    const Vector from_own = guide + Vector(frames[v.guide].root - frames[v.strand].root);
    return clump_aim(Vector(v.base - v.apart * v.share), Real(v.share), from_own, Vector(to_rest[0]),
                     Vector(to_rest[1]), Vector(to_rest[2]));
  });
}
template void aim_on_skin<float>(chains::Chains<float>&, const std::vector<ClumpedVertex>&,
                                 std::span<const chains::SkinFrame>);
template void aim_on_skin<double>(chains::Chains<double>&, const std::vector<ClumpedVertex>&,
                                  std::span<const chains::SkinFrame>);

}  // namespace cuticle::sim::clumping
