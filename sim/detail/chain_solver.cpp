#include <cuticle/sim/detail/chain_solver.h>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cuticle/sim/detail/guard.h>

namespace cuticle::sim::detail {
namespace {

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
    const std::vector<LinkSphere<Real>> spheres = link_spheres<Real>(settings_, input.colliders);
    const std::vector<LinkBox<Real>> boxes = link_boxes<Real>(settings_, input.boxes);
    std::fill(resets_.begin(), resets_.end(), 0);
    tbb::parallel_for(std::size_t(0), chains_.blocks.size(),
                      [&](std::size_t b) { advance_block(b, steps, spheres, boxes, parts[0].carry); });
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
  void advance_block(std::size_t b, const std::vector<ChainStep<Real>>& steps,
                     const std::vector<LinkSphere<Real>>& spheres, const std::vector<LinkBox<Real>>& boxes,
                     const glm::vec4& carry) {
    if (carry.w != 1.f) turn(b, carry);
    Room& room = room_.local();
    room.near.clear();
    for (const LinkSphere<Real>& sphere : spheres)
      if (chains_.within_reach(b, sphere, settings_.contact->pearl_radius)) room.near.push_back(sphere);
    room.near_boxes.clear();
    for (const LinkBox<Real>& box : boxes)
      if (chains_.within_reach(b, sphere_around(box), settings_.contact->pearl_radius)) room.near_boxes.push_back(box);
    const std::size_t scratch = (chains_.blocks[b].links + 2) * std::size_t(program_.scratch_rows) * k_lanes;
    room.numbers.resize(scratch + 4 * (room.near.size() + room.near_boxes.size()) * k_lanes);
    ChainBlock<Real> block = chains_.block(b, room.numbers.data());
    block.scratch_rows = program_.scratch_rows;
    if (!program_.own.empty())
      block.own = program_.own.data() + chains_.blocks[b].first_vertex * std::size_t(program_.own_rows) * k_lanes;
    const bool touches = !room.near.empty() || !room.near_boxes.empty();
    const Advance<Real> advance = touches ? program_.touching : program_.free;
    advance(block, {steps.data(), int(steps.size()), room.near.data(), int(room.near.size()), room.near_boxes.data(),
                    int(room.near_boxes.size()), room.numbers.data() + scratch});
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
    std::vector<LinkSphere<Real>> near;
    std::vector<LinkBox<Real>> near_boxes;
  };
  ChainSettings settings_;
  strands::Groom rest_;
  Chains<Real> chains_;
  ChainProgram<Real> program_;
  std::vector<std::uint32_t> resets_;
  tbb::enumerable_thread_specific<Room> room_;
  HeadMotion motion_{true};  // meets boxes
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
