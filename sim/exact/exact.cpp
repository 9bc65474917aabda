#include <cuticle/sim/exact/exact.h>

#include <cmath>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cuticle/sim/exact/guard.h>

namespace cuticle::sim::exact {
namespace {

template <class Real>
Advance<Real> advance_for(bool pulls, bool touches) {
  const Kernels& kernels = best_kernels();
  if constexpr (std::is_same_v<Real, float>)
    return kernels.advance[pulls][touches];
  else
    return kernels.advance_double;
}

template <class Real>
class ExactSolver final : public Solver {
 public:
  ExactSolver(const strands::Groom& rest, const Settings& settings)
      : settings_(settings), rest_(rest), chains_(make_chains<Real>(rest, settings)), resets_(rest.strand_count(), 0) {}

  Result<void> advance(const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    placing_.advance(parts);
    const std::vector<ChainStep<Real>> steps = clock_.template steps<Real>(settings_, parts);
    const std::vector<LinkSphere<Real>> spheres = link_spheres<Real>(settings_, input.colliders);
    const Advance<Real> kernel = advance_for<Real>(settings_.shape_stiffness > 0, !spheres.empty());
    std::fill(resets_.begin(), resets_.end(), 0);
    const glm::vec4 carry = parts[0].carry;
    tbb::parallel_for(std::size_t(0), chains_.blocks.size(), [&](std::size_t b) {
      if (carry.w != 1.f) turn(b, carry);
      std::vector<Real>& room = room_.local();
      const ChainBlock<Real> block = chains_.block(b, cleared_scratch(room, b, spheres.size()));
      Real* const sphere_rows = room.data() + room.size() - spheres.size() * 4 * k_lanes;
      kernel(block, {steps.data(), int(steps.size()), spheres.data(), int(spheres.size()), sphere_rows});
      reset_broken_lanes(chains_, b, placing_);
    });
    if (!steps.empty()) count_resets();
    return {};
  }

  Result<State> state() override {
    State state;
    state.positions.reserve(rest_.vertex_count());
    state.velocities.reserve(rest_.vertex_count());
    for (std::size_t s = 0; s < rest_.strand_count(); ++s) append_strand(state, s);
    for (std::uint32_t fired : resets_) state.guards_fired += fired;
    return state;
  }

 private:
  Real* cleared_scratch(std::vector<Real>& room, std::size_t b, std::size_t spheres) {
    const std::size_t rows = (chains_.blocks[b].links + 2) * scratch_row::count + 4 * spheres;
    room.assign(rows * k_lanes, Real(0));
    return room.data();
  }

  /// The whole state turned with the head.
  void turn(std::size_t b, const glm::vec4& carry) {
    const glm::dmat3 matrix = matrix_of(carry);
    for (std::size_t i = 0; i <= chains_.blocks[b].links; ++i)
      for (std::size_t field = 0; field < std::size_t(state_row::tension); field += 3) {
        Real* const numbers = chains_.state_at(b, i, field);
        for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
          put_vector(numbers, lane, matrix * vector_at(numbers, lane));
      }
  }

  void count_resets() {
    for (std::size_t s = 0; s < rest_.strand_count(); ++s) {
      const ChainPlace& place = chains_.places[s];
      if (place.has_links)
        resets_[s] = chains_.strand_at(place.block, strand_row::guarded)[place.lane] == Real(k_was_reset);
    }
  }

  void append_strand(State& state, std::size_t s) {
    const ChainPlace& place = chains_.places[s];
    for (std::size_t i = rest_.offsets[s]; i < rest_.offsets[s + 1]; ++i) {
      const std::uint32_t link = chains_.links_of_vertex[i];
      const bool carried = i < rest_.offsets[s] + place.anchor || !place.has_links || link == 0;
      // What is welded to the anchor goes with it.
      const std::size_t rest =
          carried ? std::min<std::size_t>(i, rest_.offsets[s] + place.anchor) : rest_.offsets[s] + place.anchor;
      glm::dvec3 at = placing_.world(glm::dvec3(rest_.positions[rest])),
                 velocity = placing_.velocity(glm::dvec3(rest_.positions[rest]));
      if (!carried) {
        at += vector_at(chains_.state_at(place.block, link, state_row::here), place.lane);
        velocity = vector_at(chains_.state_at(place.block, link, state_row::velocity), place.lane);
      }
      state.positions.emplace_back(at);
      state.velocities.emplace_back(velocity);
    }
  }

  Settings settings_;
  strands::Groom rest_;
  Chains<Real> chains_;
  std::vector<std::uint32_t> resets_;
  tbb::enumerable_thread_specific<std::vector<Real>> room_;
  HeadMotion motion_;
  Placing placing_;
  ChainClock clock_;
};

}  // namespace

Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects) {
  CUTICLE_TRY(strands::validate(rest));
  const Settings settings = make_settings(solver, effects);
  if (settings.double_precision) return std::unique_ptr<Solver>(std::make_unique<ExactSolver<double>>(rest, settings));
  return std::unique_ptr<Solver>(std::make_unique<ExactSolver<float>>(rest, settings));
}

}  // namespace cuticle::sim::exact
