#include <algorithm>
#include <map>

#include <glm/geometric.hpp>

#include "sim/chains/chains.h"

#include "sim/classic/verlet.glslh"

namespace cuticle::sim::chains {
namespace {

constexpr double k_welded = 1e-7;  // of the strand's length

/// One strand's chain: vertex 0 is the anchor.
struct Chain {
  std::vector<glm::dvec3> places;      ///< relative to the anchor, rest space
  std::vector<double> lengths, along;  ///< towards the root; share of the strand's length
  glm::dvec3 anchor{0};
};

double arc_length(std::span<const glm::vec3> strand) {
  double total = 0;
  for (std::size_t i = 1; i < strand.size(); ++i)
    total += glm::distance(glm::dvec3(strand[i - 1]), glm::dvec3(strand[i]));
  return total;
}

/// `links`: receives the chain's vertex of every vertex of the strand.
Chain chain_of(std::span<const glm::vec3> strand, std::size_t anchor, std::span<std::uint32_t> links) {
  const double total = arc_length(strand);
  double arc = arc_length(strand.first(anchor + 1));
  Chain chain{{glm::dvec3(0)}, {0}, {0}, glm::dvec3(strand[anchor])};
  for (std::size_t i = anchor + 1; i < strand.size(); ++i) {
    const double length = glm::distance(glm::dvec3(strand[i - 1]), glm::dvec3(strand[i]));
    arc += length;
    if (length > k_welded * total) {
      chain.places.push_back(glm::dvec3(strand[i]) - chain.anchor);
      chain.lengths.push_back(length);
      chain.along.push_back(std::min(1.0, arc / total));
    }
    links[i] = static_cast<std::uint32_t>(chain.places.size() - 1);
  }
  return chain;
}

/// A lane's rows of one kind.
template <class Real>
struct LaneRows {
  Rows<Real>& numbers;
  std::size_t first_row, lane;
  Real& at(std::size_t row) { return numbers[(first_row + row) * k_lanes + lane]; }
  void put(std::size_t row, const glm::dvec3& v) {
    for (int c = 0; c < 3; ++c) at(row + std::size_t(c)) = Real(v[c]);
  }
};

double mass(const Chain& chain, std::size_t i) {
  return chain.lengths[i] + (i + 1 < chain.lengths.size() ? chain.lengths[i + 1] : 0);
}

template <class Real>
void fill_lane(Chains<Real>& chains, const Chain& chain, const ChainSettings& settings, std::size_t block,
               std::size_t lane) {
  const std::size_t first = chains.blocks[block].first_vertex, links = chain.places.size() - 1;
  double mean = 0, reach = 0;
  for (double length : chain.lengths) mean += length / double(links);
  LaneRows<Real>{chains.strand, block * strand_row::count, lane}.put(strand_row::anchor, chain.anchor);
  for (std::size_t i = 1; i <= links; ++i) {
    LaneRows<Real> rest{chains.rest, (first + i) * rest_row::count, lane};
    reach += chain.lengths[i];
    rest.at(rest_row::length) = Real(chain.lengths[i]);
    rest.at(rest_row::inverse_length) = Real(1 / chain.lengths[i]);
    rest.at(rest_row::mass) = Real(mass(chain, i) / (2 * mean));
    rest.at(rest_row::inverse_mass) = Real(2 * mean / mass(chain, i));
    rest.at(rest_row::mass_ratio) = i > 1 ? Real(mass(chain, i) / mass(chain, i - 1)) : Real(0);
    rest.at(rest_row::reach) = Real(reach);
    rest.at(rest_row::pull) = Real(shape_rate_at(settings.shape_stiffness, settings.shape_tip, chain.along[i]));
    rest.put(rest_row::target, chain.places[i]);
    LaneRows<Real> state{chains.state, (first + i) * state_row::count, lane};
    state.put(state_row::here, chain.places[i]);
    state.put(state_row::before, chain.places[i]);
  }
}

template <class Real>
void add_block(Chains<Real>& chains, std::span<const Chain> all, std::span<const std::size_t> strands,
               const ChainSettings& settings) {
  const std::size_t links = all[strands[0]].places.size() - 1, block = chains.blocks.size();
  const std::size_t first = chains.rest.size() / (rest_row::count * k_lanes);
  chains.blocks.push_back({std::uint32_t(links), std::uint32_t(first), std::uint32_t(strands.size()), 0});
  chains.rest.resize((first + links + 2) * rest_row::count * k_lanes, Real(0));
  chains.state.resize((first + links + 2) * state_row::count * k_lanes, Real(0));
  chains.strand.resize((block + 1) * strand_row::count * k_lanes, Real(0));
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane) {
    const bool own = lane < strands.size();
    fill_lane(chains, all[strands[own ? lane : 0]], settings, block, lane);
    if (!own) continue;
    chains.places[strands[lane]].block = static_cast<std::uint32_t>(block);
    chains.places[strands[lane]].lane = static_cast<std::uint32_t>(lane);
    chains.places[strands[lane]].has_links = true;
  }
}

}  // namespace

template <class Real>
ChainBlock<Real> Chains<Real>::block(std::size_t index, Real* scratch) {
  const BlockPlace& place = blocks[index];
  return {int(place.links),
          rest.data() + place.first_vertex * rest_row::count * k_lanes,
          state.data() + place.first_vertex * state_row::count * k_lanes,
          strand.data() + index * strand_row::count * k_lanes,
          scratch,
          scratch_row::count,
          nullptr};
}

template <class Real>
bool Chains<Real>::within_reach(std::size_t block, const LinkSphere<Real>& sphere, double pearl) const {
  const Real* const reach = rest_at(block, blocks[block].links, rest_row::reach);
  for (std::size_t lane = 0; lane < blocks[block].strands; ++lane) {
    const glm::dvec3 anchor = vector_at(strand_at(block, strand_row::anchor), lane);
    const double most = 1.1 * double(reach[lane]) + double(sphere.radius) + pearl;
    if (!(glm::distance(anchor, glm::dvec3(sphere.centre)) > most)) return true;
  }
  return false;
}

template <class Real>
Chains<Real> make_chains(const strands::Groom& groom, const ChainSettings& settings) {
  Chains<Real> chains;
  chains.places.resize(groom.strand_count());
  chains.links_of_vertex.resize(groom.vertex_count(), 0);
  std::vector<Chain> all(groom.strand_count());
  std::map<std::size_t, std::vector<std::size_t>> by_links;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> strand = groom.strand(s);
    if (strand.empty()) continue;
    chains.places[s].anchor = std::uint32_t(std::min<std::size_t>(settings.clamped_vertices, strand.size()) - 1);
    all[s] = chain_of(strand, chains.places[s].anchor,
                      std::span(chains.links_of_vertex).subspan(groom.offsets[s], strand.size()));
    if (all[s].places.size() > 1) by_links[all[s].places.size() - 1].push_back(s);
  }
  for (const auto& [links, strands] : by_links)
    for (std::size_t first = 0; first < strands.size(); first += std::size_t(k_lanes))
      add_block(chains, all, std::span(strands).subspan(first, std::min(std::size_t(k_lanes), strands.size() - first)),
                settings);
  chains.longest = by_links.empty() ? 0 : std::uint32_t(by_links.rbegin()->first);
  return chains;
}

template <class Real>
std::vector<float> tensions_of(const Chains<Real>& chains, const strands::Groom& rest, std::span<const Real> numbers) {
  std::vector<float> tensions(rest.vertex_count(), 0.f);
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    const ChainPlace& place = chains.places[s];
    if (!place.has_links) continue;
    const BlockPlace& block = chains.blocks[place.block];
    const double mean = double(chains.rest_at(place.block, block.links, rest_row::reach)[place.lane]) / block.links;
    for (std::size_t i = rest.offsets[s] + place.anchor + 1; i < rest.offsets[s + 1]; ++i) {
      const std::size_t link = chains.links_of_vertex[i], row = (block.first_vertex + link) * state_row::count;
      const double length = double(chains.rest_at(place.block, link, rest_row::length)[place.lane]);
      tensions[i] =
          static_cast<float>(double(numbers[(row + state_row::tension) * k_lanes + place.lane]) * length * mean);
    }
  }
  return tensions;
}
template std::vector<float> tensions_of<float>(const Chains<float>&, const strands::Groom&, std::span<const float>);
template std::vector<float> tensions_of<double>(const Chains<double>&, const strands::Groom&, std::span<const double>);

template struct Chains<float>;
template struct Chains<double>;
template Chains<float> make_chains<float>(const strands::Groom&, const ChainSettings&);
template Chains<double> make_chains<double>(const strands::Groom&, const ChainSettings&);

}  // namespace cuticle::sim::chains
