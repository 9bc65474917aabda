#include "sim/chains/skin/on_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace cuticle::sim::chains {
namespace {

constexpr double k_least_bend = 1e-3;   // of the distance from the anchor to the farthest vertex
constexpr double k_least_beside = 0.3;  // of a root's distance, off a strand's own line
constexpr std::size_t k_neighbours = 16;

glm::dvec3 any_across(const glm::dvec3& direction) {
  const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(direction, axis));
}

SkinStrand skin_strand(const strands::Groom& rest, std::size_t index, std::size_t anchor) {
  SkinStrand strand;
  strand.anchor = strand.farthest = strand.side = std::uint32_t(anchor);
  const glm::dvec3 origin(rest.positions[anchor]);
  const auto from_anchor = [&](std::size_t i) { return glm::dvec3(rest.positions[i]) - origin; };
  double most = 0, bend = 0;
  for (std::size_t i = rest.offsets[index]; i < rest.offsets[index + 1]; ++i)
    if (const double away = glm::length(from_anchor(i)); away > most) {
      most = away;
      strand.farthest = std::uint32_t(i);
    }
  const glm::dvec3 along = most > 0 ? from_anchor(strand.farthest) / most : glm::dvec3(0, -1, 0);
  glm::dvec3 across = any_across(along);
  for (std::size_t i = rest.offsets[index]; i < rest.offsets[index + 1]; ++i) {
    const glm::dvec3 off = from_anchor(i) - along * glm::dot(along, from_anchor(i));
    if (glm::length(off) <= std::max(bend, k_least_bend * most)) continue;
    bend = glm::length(off);
    across = off / bend;
    strand.side = std::uint32_t(i);
  }
  strand.root = rest.positions[anchor];
  strand.along = along;
  strand.across = across;
  strand.bends = bend > 0;
  return strand;
}

/// The ten bits with two zeros before each.
std::uint32_t spread(std::uint32_t bits) {
  for (const auto& [shift, mask] :
       {std::pair(16u, 0x030000FFu), {8u, 0x0300F00Fu}, {4u, 0x030C30C3u}, {2u, 0x09249249u}})
    bits = (bits | bits << shift) & mask;
  return bits;
}

/// Strands that have vertices, in an order in which near roots are near each other (Morton 1966).
std::vector<std::uint32_t> in_morton_order(const strands::Groom& rest, const std::vector<SkinStrand>& strands) {
  strands::Bounds bounds;
  for (const SkinStrand& strand : strands)
    bounds = {glm::min(bounds.lower, strand.root), glm::max(bounds.upper, strand.root)};
  const glm::vec3 size = bounds.upper - bounds.lower;
  const float scale = 1023 / std::max({size.x, size.y, size.z, 1e-9f});
  std::vector<std::uint32_t> codes, order;
  for (std::uint32_t s = 0; s < strands.size(); ++s) {
    const glm::uvec3 cell((strands[s].root - bounds.lower) * scale);
    codes.push_back(spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2);
    if (rest.strand_size(s) > 0) order.push_back(s);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t s) { return codes[s]; });
  return order;
}

/// Of a strand that does not bend, the turn about its own line, by the nearest of some roots that lie off it.
void look_beside(std::vector<SkinStrand>& strands, const std::vector<std::uint32_t>& order, std::size_t at) {
  SkinStrand& strand = strands[order[at]];
  if (strand.bends > 0) return;
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t begin = at - std::min(at, k_neighbours), end = std::min(order.size(), at + k_neighbours + 1);
  for (std::size_t k = begin; k < end; ++k) {
    const glm::dvec3 away(strands[order[k]].root - strand.root), along(strand.along);
    const glm::dvec3 off = away - along * glm::dot(along, away);
    const double distance = glm::length(away), beside = glm::length(off);
    if (!(beside > k_least_beside * distance) || distance >= nearest) continue;
    nearest = distance;
    strand.across = off / beside;
    strand.side = strands[order[k]].anchor;
  }
  strand.bends = nearest < std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<SkinStrand> skin_strands(const strands::Groom& rest, const ChainSettings& settings) {
  std::vector<SkinStrand> result(rest.strand_count());
  for (std::size_t s = 0; s < result.size(); ++s) {
    if (rest.strand_size(s) == 0) continue;
    const std::size_t clamped = std::min<std::size_t>(settings.clamped_vertices, rest.strand_size(s));
    result[s] = skin_strand(rest, s, rest.offsets[s] + clamped - 1);
  }
  if (!settings.clumping && !settings.interaction) return result;
  const std::vector<std::uint32_t> order = in_morton_order(rest, result);
  for (std::size_t k = 0; k < order.size(); ++k) look_beside(result, order, k);
  return result;
}

template <class Real>
OnSkin<Real>::OnSkin(const strands::Groom& rest, const ChainSettings& settings, Chains<Real>& chains)
    : strands_(skin_strands(rest, settings)), strand_of_(chains.blocks.size() * k_lanes) {
  for (std::size_t s = 0; s < chains.places.size(); ++s)
    if (const ChainPlace& place = chains.places[s]; place.has_links)
      strand_of_[place.block * std::size_t(k_lanes) + place.lane] = std::uint32_t(s);
  for (std::size_t b = 0; b < chains.blocks.size(); ++b) {
    for (std::size_t lane = chains.blocks[b].strands; lane < std::size_t(k_lanes); ++lane)
      strand_of_[b * k_lanes + lane] = strand_of_[b * k_lanes];
    std::fill_n(chains.strand_at(b, strand_row::anchor), 3 * k_lanes, Real(0));  // the root is the strand's origin
  }
}

template <class Real>
void OnSkin<Real>::advance(std::span<const glm::vec3> skinned, bool onto_skin, std::span<const Substep> parts) {
  begin_ = onto_skin ? std::vector(skinned.begin(), skinned.end()) : std::move(end_);
  end_.assign(skinned.begin(), skinned.end());
  steps_ = parts.size();
  duration_ = double(parts[0].duration) * double(steps_);
}

template <class Real>
glm::dvec3 OnSkin<Real>::place_at(std::uint32_t vertex, double share) const {
  return skinned_place(glm::dvec3(begin_[vertex]), glm::dvec3(end_[vertex]), share);
}

template <class Real>
SkinTurn<double> OnSkin<Real>::turn_at(std::size_t strand, double share) const {
  const SkinStrand& s = strands_[strand];
  const glm::dvec3 anchor = place_at(s.anchor, share);
  return skin_turn(glm::dvec3(s.along), glm::dvec3(s.across), place_at(s.farthest, share) - anchor,
                   place_at(s.side, share) - anchor, s.bends > 0);
}

template <class Real>
void OnSkin<Real>::fill(std::size_t block, Rows<Real>& rows) const {
  rows.resize((steps_ + 1) * turn_row::count * k_lanes);
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane) {
    const std::size_t strand = strand_of_[block * k_lanes + lane];
    const std::uint32_t anchor = strands_[strand].anchor;
    const glm::dvec3 step = (glm::dvec3(end_[anchor]) - glm::dvec3(begin_[anchor])) / double(steps_);
    for (std::size_t m = 0; m <= steps_; ++m) {
      const SkinTurn<double> turn = turn_at(strand, double(m) / double(steps_));
      Real* const row = rows.data() + m * turn_row::count * k_lanes;
      put_vector(row + turn_row::x * k_lanes, lane, turn.x);
      put_vector(row + turn_row::y * k_lanes, lane, turn.y);
      put_vector(row + turn_row::z * k_lanes, lane, turn.z);
      put_vector(row + turn_row::step * k_lanes, lane, step);
      put_vector(row + turn_row::root * k_lanes, lane, place_at(anchor, double(m) / double(steps_)));
    }
  }
}

template <class Real>
bool OnSkin<Real>::within_reach(const Chains<Real>& chains, std::size_t block, const LinkSphere<Real>& sphere,
                                double pearl) const {
  const Real* const reach = chains.rest_at(block, chains.blocks[block].links, rest_row::reach);
  for (std::size_t lane = 0; lane < chains.blocks[block].strands; ++lane) {
    const std::uint32_t anchor = strands_[strand_of_[block * k_lanes + lane]].anchor;
    const glm::dvec3 begin(begin_[anchor]), end(end_[anchor]);
    const double most = 1.1 * double(reach[lane]) + double(sphere.radius) + pearl + glm::distance(begin, end);
    if (!(glm::distance(end, glm::dvec3(sphere.centre)) > most)) return true;
  }
  return false;
}

template <class Real>
Placing OnSkin<Real>::placing(std::size_t block, std::size_t lane) const {
  const std::size_t strand = strand_of_[block * k_lanes + lane];
  const SkinTurn<double> before = turn_at(strand, 1 - 1 / double(steps_)), now = turn_at(strand, 1);
  return Placing({before.x, before.y, before.z}, {now.x, now.y, now.z}, velocity(strands_[strand].anchor),
                 duration_ / double(steps_));
}

template <class Real>
std::vector<SkinFrame> OnSkin<Real>::frames(double share) const {
  std::vector<SkinFrame> frames(strands_.size());
  tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t s) {
    const SkinTurn<double> turn = turn_at(s, share);
    frames[s] = {{turn.x, turn.y, turn.z}, place_at(strands_[s].anchor, share)};
  });
  return frames;
}

template <class Real>
bool OnSkin<Real>::moves(std::size_t strand) const {
  const SkinStrand& s = strands_[strand];
  return begin_[s.anchor] != end_[s.anchor] || begin_[s.farthest] != end_[s.farthest] || begin_[s.side] != end_[s.side];
}

template <class Real>
glm::dvec3 OnSkin<Real>::velocity(std::size_t vertex) const {
  return duration_ > 0 ? (glm::dvec3(end_[vertex]) - glm::dvec3(begin_[vertex])) / duration_ : glm::dvec3(0);
}

template class OnSkin<float>;
template class OnSkin<double>;

}  // namespace cuticle::sim::chains
