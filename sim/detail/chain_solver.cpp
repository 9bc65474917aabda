#include <cuticle/sim/detail/chain_solver.h>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cuticle/sim/colliders/distance_field.h>
#include <cuticle/sim/detail/guard.h>

namespace cuticle::sim::detail {
namespace {

/// Of a frame, or those of them within reach.
template <class Real>
struct Colliders {
  std::vector<LinkSphere<Real>> spheres = {};
  std::vector<LinkBox<Real>> boxes = {};
  std::vector<LinkField<Real>> fields = {};
  std::vector<const float*> field_values = {};
  std::size_t count() const { return spheres.size() + boxes.size() + fields.size(); }
};

template <class Real>
Colliders<Real> colliders_of(const ChainSettings& settings, const FrameInput& input) {
  Colliders<Real> colliders{link_spheres<Real>(settings, input.colliders), link_boxes<Real>(settings, input.boxes),
                            link_fields<Real>(settings, input.fields)};
  for (const FieldPointer& field : input.fields) colliders.field_values.push_back(field->values.data());
  return colliders;
}

template <class Real>
class ChainSolver final : public Solver {
 public:
  ChainSolver(const strands::Groom& rest, const ChainSettings& settings, Chains<Real> chains,
              ChainProgram<Real> program)
      : settings_(settings),
        rest_(rest),
        chains_(std::move(chains)),
        program_(std::move(program)),
        resets_(rest.strand_count(), 0) {}

  Result<void> advance(const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    placing_.advance(parts);
    const std::vector<ChainStep<Real>> steps = clock_.template steps<Real>(settings_, parts);
    const Colliders<Real> colliders = colliders_of<Real>(settings_, input);
    std::fill(resets_.begin(), resets_.end(), 0);
    tbb::parallel_for(std::size_t(0), chains_.blocks.size(),
                      [&](std::size_t b) { advance_block(b, steps, colliders, parts[0].carry); });
    if (!steps.empty()) count_resets();
    return {};
  }

  Result<State> state() override {
    State state;
    state.positions.reserve(rest_.vertex_count());
    state.velocities.reserve(rest_.vertex_count());
    state.tensions = tensions_of<Real>(chains_, rest_, chains_.state);
    for (std::size_t s = 0; s < rest_.strand_count(); ++s) append_strand(state, s);
    for (std::uint32_t fired : resets_) state.guards_fired += fired;
    return state;
  }

 private:
  void find_near(std::size_t b, const Colliders<Real>& all, Colliders<Real>& near) const {
    const auto reached = [&](const LinkSphere<Real>& around) {
      return chains_.within_reach(b, around, settings_.contact->pearl_radius);
    };
    near.spheres.clear();
    near.boxes.clear();
    near.fields.clear();
    near.field_values.clear();
    for (const LinkSphere<Real>& sphere : all.spheres)
      if (reached(sphere)) near.spheres.push_back(sphere);
    for (const LinkBox<Real>& box : all.boxes)
      if (reached(sphere_around(box))) near.boxes.push_back(box);
    for (std::size_t k = 0; k < all.fields.size(); ++k) {
      if (!reached(sphere_around(all.fields[k].grid))) continue;
      near.fields.push_back(all.fields[k]);
      near.field_values.push_back(all.field_values[k]);
    }
  }

  void advance_block(std::size_t b, const std::vector<ChainStep<Real>>& steps, const Colliders<Real>& colliders,
                     const glm::vec4& carry) {
    if (carry.w != 1.f) turn(b, carry);
    Room& room = room_.local();
    const Colliders<Real>& near = room.near;
    find_near(b, colliders, room.near);
    const std::size_t scratch = (chains_.blocks[b].links + 2) * std::size_t(program_.scratch_rows) * k_lanes;
    room.numbers.resize(scratch + 4 * near.count() * k_lanes);
    ChainBlock<Real> block = chains_.block(b, room.numbers.data());
    block.scratch_rows = program_.scratch_rows;
    if (!program_.own.empty())
      block.own = program_.own.data() + chains_.blocks[b].first_vertex * std::size_t(program_.own_rows) * k_lanes;
    const Advance<Real> advance = near.count() > 0 ? program_.touching : program_.free;
    advance(block, {steps.data(), int(steps.size()), near.spheres.data(), int(near.spheres.size()), near.boxes.data(),
                    int(near.boxes.size()), room.numbers.data() + scratch, near.fields.data(), int(near.fields.size()),
                    near.field_values.data()});
    reset_broken_lanes(chains_, b, placing_);
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

  /// What a thread needs for a block.
  struct Room {
    Rows<Real> numbers;
    Colliders<Real> near;
  };
  ChainSettings settings_;
  strands::Groom rest_;
  Chains<Real> chains_;
  ChainProgram<Real> program_;
  std::vector<std::uint32_t> resets_;
  tbb::enumerable_thread_specific<Room> room_;
  HeadMotion motion_{true};  // meets all colliders
  Placing placing_;
  ChainClock clock_;
};

}  // namespace

template <class Real>
std::unique_ptr<Solver> make_chain_solver(const strands::Groom& rest, const ChainSettings& settings,
                                          Chains<Real> chains, ChainProgram<Real> program) {
  return std::make_unique<ChainSolver<Real>>(rest, settings, std::move(chains), std::move(program));
}
template std::unique_ptr<Solver> make_chain_solver<float>(const strands::Groom&, const ChainSettings&, Chains<float>,
                                                          ChainProgram<float>);
template std::unique_ptr<Solver> make_chain_solver<double>(const strands::Groom&, const ChainSettings&, Chains<double>,
                                                           ChainProgram<double>);

}  // namespace cuticle::sim::detail
