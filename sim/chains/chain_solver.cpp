#include "sim/chains/chain_solver.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "sim/chains/contact/frame_colliders.h"
#include "sim/chains/guard.h"
#include "sim/chains/skin/on_skin.h"
#include "sim/chains/sleepers.h"
#include "sim/clumping/clumping.h"
#include "sim/colliders/distance_field.h"
#include "sim/strand_interaction/strand_interaction.h"

namespace cuticle::sim::chains {
namespace {

template <class Real>
class ChainSolver final : public Solver {
 public:
  ChainSolver(const strands::Groom& rest, const ChainSettings& settings, Chains<Real> chains,
              ChainProgram<Real> program, std::unique_ptr<strand_interaction::StrandInteraction> interaction)
      : settings_(settings),
        rest_(rest),
        chains_(std::move(chains)),
        program_(std::move(program)),
        interaction_(std::move(interaction)),
        resets_(rest.strand_count(), 0) {
    if (settings.sleep) sleepers_.emplace(*settings.sleep);
    if (settings.clumping) clumped_ = clumping::join_clumps(chains_, rest_, *settings.clumping);
  }

  Result<void> advance(const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, substeps_of(input));
    placing_.advance(parts);
    const std::vector<ChainStep<Real>> steps = clock_.template steps<Real>(settings_, parts);
    const FrameColliders<Real> colliders = frame_colliders<Real>(settings_, input, parts.size(), skin_.has_value());
    std::fill(resets_.begin(), resets_.end(), 0);
    if (!clumped_.empty() && !steps.empty()) aim_clumps(parts[0]);
    if (sleepers_) wake(input, pushes_of<Real>(steps));
    tbb::parallel_for(std::size_t(0), chains_.blocks.size(), [&](std::size_t b) {
      if (sleepers_ && !sleepers_->begin(chains_, b, woken_[b], own_rows(b))) return;
      advance_block(b, steps, colliders, parts[0].carry);
      if (sleepers_) sleepers_->end(chains_, b, input.duration, own_rows(b));
    });
    if (steps.empty()) return {};
    count_resets();
    if (interaction_) interact(input.duration);
    return {};
  }

  Result<State> state() override {
    State state;
    state.positions.reserve(rest_.vertex_count());
    state.velocities.reserve(rest_.vertex_count());
    state.tensions = tensions_of<Real>(chains_, rest_, chains_.state);
    for (std::size_t s = 0; s < rest_.strand_count(); ++s) append_strand(state, s);
    for (std::uint32_t fired : resets_) state.guards_fired += fired;
    state.resets = resets_;
    if (interaction_) state.left_out = interaction_->left_out();
    if (sleepers_) state.asleep = sleepers_->count(chains_);
    return state;
  }

 private:
  /// Hair that is put onto a skin keeps its own targets in that frame.
  void aim_clumps(const Substep& first) {
    if (!skin_)
      clumping::aim(chains_, clumped_, clumping::to_rest(first));
    else if (!first.onto_skin)
      clumping::aim_on_skin(chains_, clumped_, skin_->frames(0));
  }

  void wake(const FrameInput& input, const std::vector<Push>& pushes) {
    watch_.follow(input, pushes, skin_.has_value());
    woken_.assign(chains_.blocks.size(), 0);
    for (std::size_t s = 0; s < rest_.strand_count(); ++s)
      if (const ChainPlace& place = chains_.places[s];
          place.has_links && (watch_.wakes(s) || (skin_ && skin_->moves(s))))
        woken_[place.block] |= 1u << place.lane;
  }

  Result<std::vector<Substep>> substeps_of(const FrameInput& input) {
    const std::uint32_t count = substeps(settings_, input.duration);
    if (input.skinned.empty()) return motion_.advance(input, count);
    CUTICLE_TRY(check_skinned(input.skinned, rest_.vertex_count()));
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance_on_skin(input, count));
    if (!skin_) skin_.emplace(rest_, settings_, chains_);
    skin_->advance(input.skinned, parts[0].onto_skin, parts);
    if (parts[0].onto_skin) put_onto_skin();
    return parts;
  }

  void put_onto_skin() {
    clumping::aim_at_rest(chains_, clumped_);
    for (std::size_t b = 0; b < chains_.blocks.size(); ++b)
      for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
        reset_lane(chains_, b, lane, skin_->placing(b, lane));
  }

  void advance_block(std::size_t b, const std::vector<ChainStep<Real>>& steps, const FrameColliders<Real>& colliders,
                     const glm::vec4& carry) {
    if (carry.w != 1.f) turn(b, carry);
    Room& room = room_.local();
    FrameColliders<Real>& near = room.near;
    if (settings_.contact)
      find_near<Real>(
          colliders, [&](const LinkSphere<Real>& around) { return may_reach(b, around); }, near);
    room.values.clear();
    for (const FieldPointer& field : near.baked) room.values.push_back(field->values.data());
    const std::size_t scratch = (chains_.blocks[b].links + 2) * std::size_t(program_.scratch_rows) * k_lanes;
    const std::size_t rows_of_each = collider_row::count + (near.carries.empty() ? 0 : 3);
    room.numbers.resize(scratch + near.count() * rows_of_each * k_lanes);
    ChainBlock<Real> block = chains_.block(b, room.numbers.data());
    block.scratch_rows = program_.scratch_rows;
    if (!program_.own.empty()) block.own = own_rows(b).data();
    if (skin_) skin_->fill(b, room.turns);
    const Advance<Real> advance = near.count() > 0 ? program_.touching : program_.free;
    advance(block, {steps.data(), int(steps.size()), near.spheres.data(), int(near.spheres.size()), near.boxes.data(),
                    int(near.box_count()), room.numbers.data() + scratch, near.fields.data(), int(near.field_count()),
                    room.values.data(), near.carries.empty() ? nullptr : near.carries.data(),
                    skin_ ? room.turns.data() : nullptr});
    reset_broken_lanes<Real>(chains_, b, [&](std::size_t lane) { return skin_ ? skin_->placing(b, lane) : placing_; });
  }

  /// Whether the block's strands can come to a sphere: in the world on a skin, else in rest space.
  bool may_reach(std::size_t b, const LinkSphere<Real>& around) const {
    const double pearl = double(settings_.contact->pearl_radius);
    return skin_ ? skin_->within_reach(chains_, b, around, pearl) : chains_.within_reach(b, around, pearl);
  }

  /// The rows that the program adds to a block's vertices.
  std::span<Real> own_rows(std::size_t b) {
    const std::size_t row = std::size_t(program_.own_rows) * k_lanes;
    return std::span(program_.own).subspan(chains_.blocks[b].first_vertex * row, (chains_.blocks[b].links + 2) * row);
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

  /// Where vertex i of a strand stands: a rest place that the head carries, and the chain's vertex, from there (0:
  /// none).
  struct Stand {
    std::size_t rest;
    std::uint32_t link;
  };
  Stand stand_of(std::size_t strand, std::size_t i) const {
    const ChainPlace& place = chains_.places[strand];
    const std::size_t anchor = rest_.offsets[strand] + place.anchor;
    // What is welded to the anchor goes with it.
    if (i < anchor || !place.has_links || chains_.links_of_vertex[i] == 0) return {std::min(i, anchor), 0};
    return {anchor, chains_.links_of_vertex[i]};
  }

  void append_strand(State& state, std::size_t s) {
    for (std::size_t i = rest_.offsets[s]; i < rest_.offsets[s + 1]; ++i) {
      const Stand stand = stand_of(s, i);
      const glm::dvec3 rest(rest_.positions[stand.rest]);
      glm::dvec3 at = skin_ ? skin_->place(stand.rest) : placing_.world(rest);
      if (stand.link) at += state_of(s, stand, state_row::here);
      state.positions.emplace_back(at);
      state.velocities.emplace_back(stand.link ? state_of(s, stand, state_row::velocity)
                                               : carried_velocity(stand.rest));
    }
  }

  glm::dvec3 state_of(std::size_t strand, const Stand& stand, std::size_t row) {
    const ChainPlace& place = chains_.places[strand];
    return vector_at(chains_.state_at(place.block, stand.link, row), place.lane);
  }

  void interact(double duration) {
    std::vector<glm::dmat3> rotations{placing_.rotation()};
    if (skin_) {
      rotations.clear();
      for (const SkinFrame& frame : skin_->frames(1)) rotations.push_back(frame.turn);
    }
    tbb::parallel_for(std::size_t(0), rest_.strand_count(),
                      [&](std::size_t s) { show_to_interaction(s, rotations[skin_ ? s : 0]); });
    const std::span<const glm::vec3> changes = interaction_->changes(rotations, duration);
    tbb::parallel_for(std::size_t(0), rest_.strand_count(), [&](std::size_t s) { push(s, changes); });
  }

  /// Places by the strand's root at rest, as far as the strand stands from where it is carried.
  void show_to_interaction(std::size_t s, const glm::dmat3& rotation) {
    for (std::size_t i = rest_.offsets[s]; i < rest_.offsets[s + 1]; ++i) {
      const Stand stand = stand_of(s, i);
      const glm::dvec3 rest(rest_.positions[stand.rest]);
      interaction_->places()[i] = stand.link ? rest + state_of(s, stand, state_row::here) * rotation : rest;
      interaction_->velocities()[i] =
          stand.link ? state_of(s, stand, state_row::velocity) : carried_velocity(stand.rest);
    }
  }

  glm::dvec3 carried_velocity(std::size_t vertex) const {
    return skin_ ? skin_->velocity(vertex) : placing_.velocity(glm::dvec3(rest_.positions[vertex]));
  }

  /// Velocities of both substeps: what BDF2 takes for a change between them would go on by itself.
  void push(std::size_t s, std::span<const glm::vec3> changes) {
    const ChainPlace& place = chains_.places[s];
    std::uint32_t above = 0;
    for (std::size_t i = rest_.offsets[s]; i < rest_.offsets[s + 1]; ++i) {
      const Stand stand = stand_of(s, i);
      if (stand.link == above) continue;  // carried, or welded
      above = stand.link;
      for (const std::size_t row : {state_row::velocity, state_row::velocity_before})
        put_vector(chains_.state_at(place.block, stand.link, row), place.lane,
                   state_of(s, stand, row) + glm::dvec3(changes[i]));
    }
  }

  /// What a thread needs for a block.
  struct Room {
    Rows<Real> numbers, turns;
    FrameColliders<Real> near;
    std::vector<const float*> values;  ///< of its fields
  };
  ChainSettings settings_;
  strands::Groom rest_;
  Chains<Real> chains_;
  ChainProgram<Real> program_;
  std::unique_ptr<strand_interaction::StrandInteraction> interaction_;  ///< null without the effect
  std::optional<Sleepers<Real>> sleepers_;                              ///< none without the effect
  std::vector<clumping::ClumpedVertex> clumped_;                        ///< empty without the effect
  std::optional<OnSkin<Real>> skin_;                                    ///< none where a head carries the hair
  sleep::Watch watch_;
  std::vector<std::uint32_t> woken_;  ///< by block, a bit for each lane; empty without the effect
  std::vector<std::uint32_t> resets_;
  tbb::enumerable_thread_specific<Room> room_;
  HeadMotion motion_{true};  // meets all colliders
  Placing placing_;
  ChainClock clock_;
};

}  // namespace

template <class Real>
Result<std::unique_ptr<Solver>> make_chain_solver(const strands::Groom& rest, const ChainSettings& settings,
                                                  Chains<Real> chains, ChainProgram<Real> program) {
  CUTICLE_TRY(check(settings));
  std::unique_ptr<strand_interaction::StrandInteraction> interaction;
  if (settings.interaction) {
    CUTICLE_ASSIGN(interaction, strand_interaction::StrandInteraction::create(rest, *settings.interaction));
  }
  return std::unique_ptr<Solver>(std::make_unique<ChainSolver<Real>>(rest, settings, std::move(chains),
                                                                     std::move(program), std::move(interaction)));
}
template Result<std::unique_ptr<Solver>> make_chain_solver<float>(const strands::Groom&, const ChainSettings&,
                                                                  Chains<float>, ChainProgram<float>);
template Result<std::unique_ptr<Solver>> make_chain_solver<double>(const strands::Groom&, const ChainSettings&,
                                                                   Chains<double>, ChainProgram<double>);

}  // namespace cuticle::sim::chains
