#include "sim/rod/equilibrium.h"

#include <algorithm>
#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "core/interrupt.h"
#include "sim/rod/holding.h"
#include "sim/rod/rod.h"
#include "sim/rod/strand_energy.h"

namespace cuticle::sim::rod {
namespace {

constexpr double k_sunk = 1e-6;                 ///< m that a strand's weight sinks in
constexpr double k_softer[] = {1e-4, 1e-2, 1};  ///< stiffness of contact, one solution after the other
constexpr double k_farthest_turn = 0.5;         ///< radians of a link in a step
constexpr double k_rounding = 1e-13;            ///< of the energy's terms

/// Newton's method for one strand under one load.
class Descent {
 public:
  Descent(const RodStrand& strand, const Load& load, double scale, Frames& frames)
      : strand_(strand), load_(load), scale_(scale), least_shift_(1e-9 * scale), frames_(frames) {}

  /// Until the residual is met or `most` steps are done.
  void run(double residual, int most, StrandRest& rest) {
    Energy energy = energy_of(strand_, frames_, load_);
    double shift = least_shift_;
    for (int k = 0; k < most; ++k, ++rest.steps) {
      const NewtonStep step = newton_step(strand_, frames_, load_, shift);
      if (!step.is_definite) {
        shift = std::max(10 * shift, 1e-4 * scale_);
        continue;
      }
      rest.residual = step.moment / scale_;
      if (rest.residual <= residual) return;
      shift = descend(step, energy) ? std::max(least_shift_, shift / 10) : std::max(10 * shift, 1e-4 * scale_);
      if (shift > 1e12 * scale_) return;  // no way leads down: rounding
    }
  }

 private:
  /// The longest of ever shorter shares of the step that lowers the energy; false: none does.
  bool descend(const NewtonStep& step, Energy& energy) {
    double farthest = 0;
    for (const glm::dvec3& turn : step.turns) farthest = std::max(farthest, glm::length(turn));
    double share = farthest > k_farthest_turn ? k_farthest_turn / farthest : 1;
    for (int halving = 0; halving < 12; ++halving, share /= 2) {
      Frames next = turned(frames_, step.turns, share);
      const Energy found = energy_of(strand_, next, load_);
      if (!(found.value <= energy.value + 1e-4 * share * step.slope + k_rounding * energy.magnitude)) continue;
      frames_ = std::move(next);
      energy = found;
      return true;
    }
    return false;
  }

  const RodStrand& strand_;
  const Load& load_;
  double scale_, least_shift_;
  Frames& frames_;
};

/// The colliders that any place of the strand may come near.
Contacts contacts_of(const RodStrand& strand, std::span<const PlacedCollider> colliders, double pearl) {
  Contacts contacts;
  for (const PlacedCollider& collider : colliders)
    if (distance(collider, strand.anchor) < strand.length() + pearl) contacts.near.push_back(collider);
  if (contacts.near.empty()) return contacts;
  const auto clearance_at = [&](const glm::dvec3& place) {
    double least = pearl;
    for (const PlacedCollider& collider : contacts.near) least = std::min(least, distance(collider, place));
    return least;
  };
  const std::vector<glm::dvec3> places = places_of(strand, strand.rest);
  contacts.clearance.push_back(0);
  for (std::size_t i = 1; i < places.size(); ++i) {
    contacts.clearance.push_back(clearance_at((places[i - 1] + places[i]) * 0.5));
    contacts.clearance.push_back(clearance_at(places[i]));
  }
  return contacts;
}

double deepest(const RodStrand& strand, const Frames& frames, const Contacts& contacts) {
  const std::vector<glm::dvec3> places = places_of(strand, frames);
  double depth = 0;
  for (const PlacedCollider& collider : contacts.near)
    for (std::size_t i = 1; i < places.size(); ++i) {
      depth = std::max(depth, contacts.clearance[2 * i] - distance(collider, places[i]));
      const glm::dvec3 middle = (places[i - 1] + places[i]) * 0.5;
      depth = std::max(depth, contacts.clearance[2 * i - 1] - distance(collider, middle));
    }
  return depth;
}

double scale_of(const RodStrand& strand, const glm::dvec3& gravity) {
  double scale = strand.weight(gravity) * strand.length();
  if (!(scale > 0))
    for (const HingeEnergy& hinge : strand.hinges) scale = std::max(scale, hinge.bending);
  return scale;
}

StrandRest settle(const RodStrand& strand, const glm::dvec3& gravity, Contacts contacts,
                  const EquilibriumRequest& request, Frames& frames) {
  StrandRest rest;
  const double scale = scale_of(strand, gravity);
  if (!(scale > 0)) return rest;  // nothing acts on it
  Load load{gravity, contacts.near.empty() ? nullptr : &contacts};
  for (const double softer : k_softer) {
    const bool is_last = softer == 1 || !load.contacts;
    contacts.stiffness = softer * scale / strand.length() / k_sunk;
    Descent(strand, load, scale, frames).run(is_last ? request.residual : 1e-4, request.most_steps, rest);
    if (is_last) break;
  }
  rest.is_balanced = rest.residual <= request.residual;
  rest.is_stable = newton_step(strand, frames, load, 1e-9 * scale).is_definite;
  rest.depth = deepest(strand, frames, contacts);
  return rest;
}

void put(const strands::Groom& rest, std::size_t strand, const chains::Chains<double>& chains,
         std::span<const glm::dvec3> places, std::vector<glm::vec3>& positions) {
  for (std::uint32_t v = rest.offsets[strand]; v < rest.offsets[strand + 1]; ++v)
    if (chains.links_of_vertex[v] > 0) positions[v] = glm::vec3(places[chains.links_of_vertex[v]]);
}

}  // namespace

Result<Equilibrium> find_equilibrium(const strands::Groom& rest, const registry::ParameterValues& solver,
                                     const EffectBlocks& effects, const EquilibriumRequest& request,
                                     Progress& progress) {
  CUTICLE_TRY(strands::validate(rest));
  const Settings settings = make_settings(solver, effects);
  const chains::Chains<double> chains = chains::make_chains<double>(rest, settings.chain);
  const chains::Rows<double> hinges = make_held_hinges(chains, settings).rows;
  const bool collides = settings.chain.contact.has_value();
  const double pearl = collides ? double(settings.chain.contact->pearl_radius) : 0;
  Equilibrium found{rest.positions, std::vector<StrandRest>(rest.strand_count())};
  constexpr std::size_t k_part = 256;
  const StopsBetweenSteps stop;
  for (std::size_t begin = 0; begin < rest.strand_count(); begin += k_part) {
    if (stop.is_asked()) return Error{ErrorKind::internal, "interrupted before every strand was at rest", ""};
    const std::size_t end = std::min(rest.strand_count(), begin + k_part);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 4), [&](const auto& range) {
      for (std::size_t s = range.begin(); s < range.end(); ++s) {
        if (!chains.places[s].has_links) continue;
        const RodStrand strand = rod_strand(chains, hinges, s);
        Frames frames = strand.rest;
        Contacts contacts =
            contacts_of(strand, collides ? request.colliders : std::span<const PlacedCollider>{}, pearl);
        found.strands[s] = settle(strand, settings.chain.gravity, std::move(contacts), request, frames);
        put(rest, s, chains, places_of(strand, frames), found.positions);
      }
    });
    progress.update("strands at rest", end, rest.strand_count());
  }
  return found;
}

}  // namespace cuticle::sim::rod
