#include "sim/classic/classic.h"

#include <cmath>

#include <tbb/parallel_for.h>

#include "sim/classic/particles.h"
#include "sim/classic/shape_sphere.glslh"
#include "sim/classic/verlet.glslh"

namespace cuticle::sim::classic {
namespace {

/// A frame's colliders, how strands meet them, and which strands may.
struct Contacts {
  colliders::SubstepSpheres spheres;
  colliders::ContactSettings settings;
  std::span<const std::uint8_t> reached;

  bool may_touch(std::size_t strand) const { return spheres.count > 0 && (reached.empty() || reached[strand] != 0); }
};

std::size_t anchor_of(const Particles& strand, const StepConstants& step) {
  return std::min<std::size_t>(step.clamped_vertices, strand.size()) - 1;
}

/// Pulls vertex i back into the reach of the vertex that the head carries.
void keep_reach(const Particles& strand, std::size_t i, std::size_t anchor) {
  const glm::vec3 before = direction_of(strand.starts[i] - strand.starts[anchor]);
  strand.positions[i] -= reach_excess(strand.positions[i] - strand.positions[anchor], strand.traits[i].z, before);
}

/// The segment from vertex i - 1 to i.
void keep_length(const Particles& strand, std::size_t i, const glm::vec4& rotation) {
  keep_distance(strand, i - 1, i, strand.places[i].w, rotation);
}

void keep_in_sphere(const Particles& strand, std::size_t i, const glm::vec4& rotation, const Sweep& sweep) {
  const float radius = shape_radius(sweep.sphere_root, sweep.sphere_tip, strand.traits[i].y);
  strand.positions[i] = kept_within(strand.positions[i], strand.target(i, rotation), radius);
}

void sweep_in_sequence(const Particles& strand, std::size_t anchor, const StepConstants& step, const Sweep& sweep) {
  for (std::size_t i = anchor + 1; i < strand.size(); ++i) {
    if (sweep.long_range) keep_reach(strand, i, anchor);
    keep_length(strand, i, step.rotation_end);
  }
}

/// The segments of a colour share no vertex, so that a kernel may correct them at once.
void sweep_red_black(const Particles& strand, std::size_t anchor, const StepConstants& step, const Sweep& sweep) {
  for (std::size_t i = anchor + 1; sweep.long_range && i < strand.size(); ++i) keep_reach(strand, i, anchor);
  for (std::size_t colour : {1, 2})
    for (std::size_t i = anchor + colour; i < strand.size(); i += 2) keep_length(strand, i, step.rotation_end);
}

/// One pass over the constraints of a strand.
void sweep_lengths(const Particles& strand, const StepConstants& step, const Sweep& sweep) {
  const std::size_t anchor = anchor_of(strand, step);
  (sweep.order == Order::red_black ? sweep_red_black : sweep_in_sequence)(strand, anchor, step, sweep);
  for (std::size_t i = anchor + 1; sweep.has_spheres() && i < strand.size(); ++i)
    keep_in_sphere(strand, i, step.rotation_end, sweep);
}

void constrain(const Particles& strand, const StepConstants& step, const Settings& settings) {
  for (std::uint32_t k = 0; k < settings.iterations; ++k) sweep_lengths(strand, step, settings.sweep);
}

/// Lengths and spheres in turn, of a strand that touches one; others stay as the constraints put them. Where a vertex
/// began the substep inside a sphere, its begin is pushed out as well, so that leaving an overlap gives no velocity.
void meet_spheres(const Particles& strand, const StepConstants& step, std::size_t substep, const Contacts& contacts,
                  const Settings& settings) {
  const std::size_t anchor = anchor_of(strand, step);
  const glm::vec3 outward =
      direction_of(strand.target(strand.size() - 1, step.rotation_end) - strand.target(0, step.rotation_end));
  const colliders::Contact begin{strand.traits, strand.starts, anchor, step.rotation_begin, outward},
      end{strand.traits, strand.positions, anchor, step.rotation_end, outward};
  const auto at_begin = contacts.spheres.at_begin(substep), at_end = contacts.spheres.at_end(substep);
  if (!touches(begin, at_begin, contacts.settings) && !touches(end, at_end, contacts.settings)) return;
  push_out(begin, at_begin, contacts.settings);
  for (std::uint32_t k = 0; k < settings.iterations; ++k) {
    sweep_lengths(strand, step, settings.sweep);
    push_out(end, at_end, contacts.settings);
  }
}

/// Where a skin carries the vertices at a frame's begin and end, and at a substep's begin. Empty: a head carries them.
struct Skin {
  std::vector<glm::vec3> begin, end;
  std::vector<glm::vec4> part_begin;
};

class ClassicSolver final : public Solver {
 public:
  ClassicSolver(const strands::Groom& rest, const Settings& settings)
      : settings_(settings),
        rest_(make_rest_pose(rest, settings.clamped_vertices)),
        positions_(rest.positions),
        starts_(rest.positions),
        velocities_(rest.vertex_count(), glm::vec3(0)),
        resets_(rest.strand_count(), 0) {}

  Result<void> advance(const FrameInput& input) override {
    CUTICLE_TRY(check_skinned(input.skinned, positions_.size()));
    const std::uint32_t count = substeps(settings_, input.duration);
    CUTICLE_ASSIGN(const std::vector<Substep> parts,
                   input.skinned.empty() ? motion_.advance(input, count) : motion_.advance_on_skin(input, count));
    if (!input.skinned.empty()) follow_skin(input.skinned, parts[0].onto_skin);
    translation_ = parts.back().translation;
    std::vector<StepConstants> steps;
    for (const Substep& part : parts)
      steps.push_back(make_step(settings_, part, static_cast<std::uint32_t>(rest_.strand_count())));
    Contacts contacts;
    if (settings_.contact)
      contacts = {colliders::packed(input.skinned.empty() ? input : without_head(input), parts.size()),
                  *settings_.contact, input.reached};
    tbb::parallel_for(std::size_t(0), rest_.strand_count(), [&](std::size_t s) { run_strand(s, steps, contacts); });
    return {};
  }

  Result<State> state() override {
    State state{.positions = positions_, .velocities = velocities_};
    for (glm::vec3& position : state.positions) position += translation_;
    for (std::uint32_t fired : resets_) state.guards_fired += fired;
    state.resets = resets_;
    return state;
  }

 private:
  void run_strand(std::size_t index, std::span<const StepConstants> steps, const Contacts& contacts) {
    const Particles strand = view(index);
    resets_[index] = 0;
    if (strand.size() == 0) return;
    const bool may_touch = contacts.may_touch(index);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const StepConstants& step = steps[k];
      if (!skin_.end.empty()) move_places(index, float(k) / float(steps.size()), float(k + 1) / float(steps.size()));
      integrate(strand, step);
      constrain(strand, step, settings_);
      if (may_touch) meet_spheres(strand, step, k, contacts, settings_);
      if (finish(strand, step)) resets_[index] = 1;
    }
  }

  Particles view(std::size_t index) {
    const std::size_t first = rest_.offsets[index], count = rest_.offsets[index + 1] - first;
    const auto part = [&](auto& values) { return std::span(values).subspan(first, count); };
    const auto places = part(rest_.places), begin_places = skin_.end.empty() ? places : part(skin_.part_begin);
    return {places, part(rest_.traits), part(positions_), part(starts_), part(velocities_), begin_places};
  }

  void follow_skin(std::span<const glm::vec3> skinned, bool onto_skin) {
    skin_.begin = onto_skin ? std::vector(skinned.begin(), skinned.end()) : std::move(skin_.end);
    skin_.end.assign(skinned.begin(), skinned.end());
    skin_.part_begin.resize(skinned.size());
    if (!onto_skin) return;
    positions_ = skin_.begin;
    velocities_.assign(skinned.size(), glm::vec3(0));
  }

  /// To where the skin has a strand when these shares of the frame have passed.
  void move_places(std::size_t strand, float begin_share, float end_share) {
    for (std::size_t i = rest_.offsets[strand]; i < rest_.offsets[strand + 1]; ++i) {
      skin_.part_begin[i] = glm::vec4(skinned_place(skin_.begin[i], skin_.end[i], begin_share), 0);
      rest_.places[i] = glm::vec4(skinned_place(skin_.begin[i], skin_.end[i], end_share), rest_.places[i].w);
    }
  }

  Settings settings_;
  RestPose rest_;
  std::vector<glm::vec3> positions_, starts_, velocities_;
  std::vector<std::uint32_t> resets_;
  Skin skin_;
  HeadMotion motion_;
  glm::vec3 translation_{0};
};

}  // namespace

Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects) {
  CUTICLE_TRY(check_effects(effects));
  CUTICLE_TRY(strands::validate(rest));
  return std::unique_ptr<Solver>(
      std::make_unique<ClassicSolver>(rest, make_settings(registry::from_values<Classic>(solver), effects)));
}

}  // namespace cuticle::sim::classic
