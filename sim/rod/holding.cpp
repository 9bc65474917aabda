#include "sim/rod/holding.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "sim/rod/strand_energy.h"

namespace cuticle::sim::rod {
namespace {

constexpr double k_reserve = 1.25;    ///< times the gravity that the rest pose must withstand
constexpr double k_exactness = 1.01;  ///< of the factor

/// The search for one strand's factor; its rows hold what was last tried.
template <class Real>
class Search {
 public:
  Search(const chains::Chains<Real>& chains, const Settings& settings, std::size_t strand, chains::Rows<Real>& rows)
      : chains_(chains), settings_(settings), strand_(strand), rows_(rows) {}

  Hold find() {
    if (is_stable()) return {};
    double low = 1, high = 1;
    for (bool stable = false; !stable; stable = is_stable_at(high)) {
      if (high >= settings_.stiffen_at_most) return {float(high), false};
      low = high;
      high = std::min(2 * high, settings_.stiffen_at_most);
    }
    while (high > k_exactness * low) {
      const double middle = std::sqrt(low * high);
      (is_stable_at(middle) ? high : low) = middle;
    }
    return {float(high), is_stable_at(high)};
  }

 private:
  bool is_stable_at(double factor) {
    const chains::ChainPlace& place = chains_.places[strand_];
    put_hinges(chains_, place.block, place.lane,
               {settings_.stiffness.bending * factor, settings_.stiffness.twisting * factor},
               settings_.balanced_gravity, rows_);
    return is_stable();
  }
  bool is_stable() const {
    const RodStrand rod = rod_strand(chains_, rows_, strand_);
    const double shift = 1e-9 * rod.weight(settings_.balanced_gravity) * rod.length();
    return newton_step(rod, rod.rest, {settings_.balanced_gravity * k_reserve, nullptr}, shift).is_definite;
  }

  const chains::Chains<Real>& chains_;
  const Settings& settings_;
  std::size_t strand_;
  chains::Rows<Real>& rows_;
};

}  // namespace

template <class Real>
HeldHinges<Real> make_held_hinges(const chains::Chains<Real>& chains, const Settings& settings) {
  HeldHinges<Real> held{make_hinges(chains, settings.stiffness, settings.balanced_gravity),
                        std::vector<Hold>(chains.places.size())};
  const bool is_pulled = glm::dot(settings.balanced_gravity, settings.balanced_gravity) > 0;
  if (!is_pulled || !(settings.stiffness.bending > 0)) return held;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chains.places.size(), 16), [&](const auto& range) {
    for (std::size_t s = range.begin(); s < range.end(); ++s)
      if (chains.places[s].has_links) held.holds[s] = Search<Real>(chains, settings, s, held.rows).find();
  });
  return held;
}
template HeldHinges<float> make_held_hinges<float>(const chains::Chains<float>&, const Settings&);
template HeldHinges<double> make_held_hinges<double>(const chains::Chains<double>&, const Settings&);

Result<std::vector<Hold>> find_holds(const strands::Groom& rest, const registry::ParameterValues& solver,
                                     const EffectBlocks& effects) {
  CUTICLE_TRY(strands::validate(rest));
  const Settings settings = make_settings(solver, effects);
  return make_held_hinges(chains::make_chains<float>(rest, settings.chain), settings).holds;
}

}  // namespace cuticle::sim::rod
