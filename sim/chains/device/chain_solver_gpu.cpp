#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include <fmt/core.h>

#include "sim/chains/contact/frame_colliders.h"
#include "sim/chains/device/chain_solver_gpu.h"
#include "sim/chains/device/frame_place.h"
#include "sim/chains/skin/on_skin.h"
#include "sim/clumping/clumping_gpu.h"
#include "sim/colliders/distance_field.h"
#include "sim/strand_interaction/strand_interaction_gpu.h"

namespace cuticle::sim::chains {
namespace {

static_assert(sizeof(SkinStrand) == 64, "the layout of skin_strand.glsl");
constexpr std::uint32_t k_buffers = 16, k_buffers_beside_all = 20, k_skin_buffers = 3;
static_assert(sizeof(LinkField<float>) == 80, "the layout of field_contact.glslh");
static_assert(sizeof(ColliderCarry<float>) == 48, "the layout of moving_contact.glslh");

struct Buffers {
  gpu::Buffer places, blocks, offsets, vertices, rest, state, strands, scratch, steps, spheres, frame, world,
      velocities, resets, own, reach, boxes, fields, field_values, carries, skin_strands, skin_begin;
};

template <class T>
Result<void> refill(gpu::Device& device, gpu::Buffer& buffer, const T& data) {
  const std::span<const typename T::value_type> values(data);
  if (buffer.size() >= values.size_bytes()) return device.upload(buffer, std::as_bytes(values));
  CUTICLE_ASSIGN(buffer, gpu::make_buffer_from(device, values));
  return {};
}

class ChainGpuSolver final : public GpuSolver {
 public:
  ChainGpuSolver(std::shared_ptr<gpu::Device> device, const strands::Groom& rest, const ChainSettings& settings,
                 Chains<float> chains, ChainGpuProgram program)
      : device_(std::move(device)),
        settings_(settings),
        rest_(rest),
        chains_(std::move(chains)),
        program_(std::move(program)) {}

  Result<void> make() {
    if (settings_.clumping) CUTICLE_TRY(make_clumps());
    CUTICLE_TRY(make_buffers());
    CUTICLE_ASSIGN(free_, kernel_of(program_.free, k_buffers));
    if (settings_.interaction) {
      CUTICLE_ASSIGN(interaction_, strand_interaction::StrandInteractionGpu::create(
                                       *device_, rest_, *settings_.interaction, velocity_layout()));
    }
    if (!settings_.contact) return {};
    CUTICLE_ASSIGN(touching_, kernel_of(program_.touching, k_buffers));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    placing_.advance(parts);
    std::vector<ChainStep<float>> steps = clock_.steps<float>(settings_, parts);
    const FrameColliders<float> colliders = frame_colliders<float>(settings_, input, parts.size(), false);
    Constants constants{std::uint32_t(rest_.strand_count()),     std::uint32_t(steps.size()),
                        std::uint32_t(colliders.spheres.size()), std::uint32_t(colliders.box_count()),
                        std::uint32_t(colliders.field_count()),  parts[0].carry.w != 1.f};
    if (settings_.sleep) set_sleep(constants, input, steps, false);
    if (!steps.empty()) CUTICLE_TRY(refill(*device_, buffers_.steps, steps));
    CUTICLE_TRY(upload(colliders));
    CUTICLE_TRY(upload_reach(input));
    CUTICLE_TRY(refill(*device_, buffers_.frame, std::array{frame_place(parts[0].carry, placing_)}));
    CUTICLE_ASSIGN(const gpu::Kernel* kernel, kernel_for(constants, !colliders.carries.empty()));
    if (clumping_ && !steps.empty())
      clumping_->record(commands, buffers_.state, buffers_.rest, clumping::to_rest(parts[0]));
    commands.begin_pass(program_.name);
    dispatch(commands, *kernel, constants);
    commands.end_pass();
    if (interaction_ && !steps.empty())
      interaction_->record(commands, {&buffers_.world, &buffers_.velocities, &buffers_.state}, placing_.rotation(),
                           placing_.world(glm::dvec3(0)), input.duration);
    return {};
  }

  Result<void> record_on_skin(gpu::Commands& commands, const FrameInput& input, const gpu::Buffer& skinned) override {
    CUTICLE_EXPECT(skinned.size() >= buffers_.world.size(), "a place per vertex");
    CUTICLE_ASSIGN(const std::vector<Substep> parts,
                   motion_.advance_on_skin(input, substeps(settings_, input.duration)));
    placing_.advance(parts);
    if (!buffers_.skin_begin) CUTICLE_TRY(make_for_skin());
    const std::vector<ChainStep<float>> steps = clock_.steps<float>(settings_, parts);
    if (!steps.empty()) CUTICLE_TRY(refill(*device_, buffers_.steps, steps));
    if (parts[0].onto_skin) commands.copy(skinned, buffers_.skin_begin, buffers_.world.size());
    const FrameColliders<float> colliders = frame_colliders<float>(settings_, input, parts.size(), true);
    CUTICLE_TRY(upload(colliders));
    Constants constants{.strand_count = std::uint32_t(rest_.strand_count()),
                        .step_count = std::uint32_t(steps.size()),
                        .all_boxes = std::uint32_t(colliders.box_count()),
                        .all_fields = std::uint32_t(colliders.field_count()),
                        .carries = parts[0].onto_skin,
                        .frame_time = float(input.duration)};
    if (settings_.sleep) {
      set_sleep(constants, input, steps, true);
      CUTICLE_TRY(upload_reach(input));
    }
    CUTICLE_ASSIGN(const gpu::Kernel* kernel, skin_kernel_for(constants));
    if (clumping_ && parts[0].onto_skin) CUTICLE_TRY(refill(*device_, buffers_.rest, chains_.rest));
    if (clumping_ && !steps.empty())
      clumping_->record_on_skin(commands, buffers_.state, buffers_.rest,
                                {&buffers_.skin_strands, &buffers_.skin_begin, parts[0].onto_skin});
    commands.begin_pass(program_.name);
    dispatch(commands, *kernel, constants, &skinned);
    commands.end_pass();
    if (interaction_ && !steps.empty())
      interaction_->record_on_skin(commands, {&buffers_.world, &buffers_.velocities, &buffers_.state},
                                   {&buffers_.skin_strands, &skinned}, input.duration);
    commands.copy(skinned, buffers_.skin_begin, buffers_.world.size());
    return {};
  }

  Result<void> advance(const FrameInput& input) override { return run(*device_, input); }

  Result<State> state() override {
    const std::size_t vertices = rest_.vertex_count();
    CUTICLE_ASSIGN(const std::vector<glm::vec4> world, gpu::read_buffer<glm::vec4>(*device_, buffers_.world, vertices));
    CUTICLE_ASSIGN(const std::vector<glm::vec4> velocities,
                   gpu::read_buffer<glm::vec4>(*device_, buffers_.velocities, vertices));
    CUTICLE_ASSIGN(std::vector<std::uint32_t> resets,
                   gpu::read_buffer<std::uint32_t>(*device_, buffers_.resets, rest_.strand_count()));
    CUTICLE_ASSIGN(const std::vector<float> numbers,
                   gpu::read_buffer<float>(*device_, buffers_.state, buffers_.state.size() / sizeof(float)));
    State state;
    if (settings_.sleep) CUTICLE_TRY(count_sleepers(state));
    state.tensions = tensions_of<float>(chains_, rest_, numbers);
    state.positions.assign(world.begin(), world.end());
    state.velocities.assign(velocities.begin(), velocities.end());
    for (std::uint32_t fired : resets) state.guards_fired += fired;
    state.resets = std::move(resets);
    if (interaction_) {
      CUTICLE_ASSIGN(state.left_out, interaction_->left_out(*device_));
    }
    return state;
  }

  const gpu::Buffer& positions() const override { return buffers_.world; }
  const gpu::Buffer& velocities() const override { return buffers_.velocities; }

  std::map<std::string, std::uint32_t> dispatches(const FrameInput& input) const override {
    std::map<std::string, std::uint32_t> result{{std::string(program_.name), 1}};
    if (interaction_ && input.duration > 0) result["strand_interaction"] = 2;
    if (clumping_ && input.duration > 0) result["clumping"] = 1;
    return result;
  }

 private:
  Result<gpu::Kernel> kernel_of(std::span<const std::uint32_t> code, std::uint32_t buffers, bool meets_fields = false,
                                bool some_move = false) {
    return device_->make_kernel(code, {.storage_buffers = buffers,
                                       .push_constant_bytes = sizeof(Constants),
                                       .specialization = {settings_.sleep.has_value(), meets_fields, some_move,
                                                          settings_.clumping.has_value()}});
  }

  /// The root of a strand is its origin there.
  Result<void> make_for_skin() {
    Rows<float> strands = chains_.strand;
    for (std::size_t row = 0; row < strands.size(); row += strand_row::count * std::size_t(k_lanes))
      std::fill_n(strands.begin() + std::ptrdiff_t(row), 3 * k_lanes, 0.f);
    if (!strands.empty()) CUTICLE_TRY(refill(*device_, buffers_.strands, strands));
    CUTICLE_TRY(refill(*device_, buffers_.skin_strands, skin_strands(rest_, settings_)));
    CUTICLE_TRY(
        refill(*device_, buffers_.frame, std::array{frame_place({0, 0, 0, 1}, placing_)}));  // which nobody reads
    CUTICLE_ASSIGN(buffers_.skin_begin, device_->make_buffer(buffers_.world.size()));
    if (clumping_) CUTICLE_TRY(clumping_->make_for_skin(*device_));
    return interaction_ ? interaction_->make_for_skin(*device_, rest_) : Result<void>();
  }

  /// None where nobody follows.
  Result<void> make_clumps() {
    const std::vector<clumping::ClumpedVertex> vertices = clumping::join_clumps(chains_, rest_, *settings_.clumping);
    if (vertices.empty()) return {};
    CUTICLE_ASSIGN(clumping_, clumping::ClumpingGpu::create(*device_, vertices));
    return {};
  }

  /// The one for such colliders, made when they are first met.
  /// That of all kinds of colliders met so far: each kernel rounds in its own way, and a frame whose colliders are left
  /// out because they are far must not differ for that.
  Result<const gpu::Kernel*> kernel_for(const Constants& constants, bool some_move) {
    met_.spheres = met_.spheres || constants.all_spheres > 0;
    met_.fields = met_.fields || constants.all_fields > 0;
    met_.others = met_.others || constants.all_boxes + constants.all_fields > 0;
    met_.moving = met_.moving || some_move;
    if (!met_.others) return met_.spheres ? &touching_ : &free_;
    gpu::Kernel& kernel = beside_all_[met_.moving][met_.fields];
    if (!kernel) {
      CUTICLE_ASSIGN(kernel, kernel_of(program_.beside_all, k_buffers_beside_all, met_.fields, met_.moving));
    }
    return &kernel;
  }

  /// The same for hair on a skin.
  Result<const gpu::Kernel*> skin_kernel_for(const Constants& constants) {
    const bool touches = constants.all_boxes + constants.all_fields > 0;
    gpu::Kernel& kernel = on_skin_[touches][constants.all_fields > 0];
    if (!kernel) {
      CUTICLE_ASSIGN(kernel, kernel_of(touches ? program_.on_skin_beside_all : program_.on_skin,
                                       (touches ? k_buffers_beside_all : k_buffers) + k_skin_buffers,
                                       constants.all_fields > 0, touches));
    }
    return &kernel;
  }

  Result<void> upload(const FrameColliders<float>& colliders) {
    if (!colliders.spheres.empty()) CUTICLE_TRY(refill(*device_, buffers_.spheres, colliders.spheres));
    if (!colliders.boxes.empty()) CUTICLE_TRY(refill(*device_, buffers_.boxes, colliders.boxes));
    if (!colliders.carries.empty()) CUTICLE_TRY(refill(*device_, buffers_.carries, colliders.carries));
    if (colliders.fields.empty()) return {};
    CUTICLE_TRY(refill(*device_, buffers_.fields, colliders.fields));
    return upload_values(colliders.baked);
  }

  /// Bits of each strand (chain_storage.glsl), only when they are others than the last.
  Result<void> upload_reach(const FrameInput& input) {
    CUTICLE_EXPECT(input.reached.empty() || input.reached.size() == rest_.strand_count(),
                   "FrameInput::reached has an entry for each strand");
    std::vector<std::uint32_t> bits(std::max<std::size_t>(1, rest_.strand_count()), 1);
    for (std::size_t s = 0; s < rest_.strand_count(); ++s)
      bits[s] = std::uint32_t(input.reached.empty() || input.reached[s] != 0) |
                std::uint32_t(settings_.sleep && watch_.wakes(s)) << 1;
    if (bits == reach_) return {};
    reach_ = std::move(bits);
    return refill(*device_, buffers_.reach, reach_);
  }

  /// Only when they are others than the last.
  Result<void> upload_values(std::span<const FieldPointer> fields) {
    if (std::ranges::equal(fields, fields_)) return {};
    std::vector<float> values;
    for (const FieldPointer& field : fields) values.insert(values.end(), field->values.begin(), field->values.end());
    CUTICLE_TRY(refill(*device_, buffers_.field_values, values));
    fields_.assign(fields.begin(), fields.end());
    return {};
  }

  void set_sleep(Constants& constants, const FrameInput& input, std::span<const ChainStep<float>> steps, bool on_skin) {
    watch_.follow(input, pushes_of<float>(steps), on_skin);
    constants.sleep_speed = settings_.sleep->speed;
    constants.sleep_time = settings_.sleep->time;
    constants.frame_time = float(input.duration);
  }

  Result<void> count_sleepers(State& state) {
    CUTICLE_ASSIGN(const std::vector<float> rows,
                   gpu::read_buffer<float>(*device_, buffers_.strands, chains_.strand.size()));
    for (const ChainPlace& place : chains_.places) {
      const std::size_t row = place.block * std::size_t(strand_row::count) + strand_row::quiet;
      state.asleep += place.has_links && rows[row * k_lanes + place.lane] >= settings_.sleep->time;
    }
    return {};
  }

  std::uint32_t velocity_at(const ChainPlace& place, std::uint32_t link) const {
    const std::uint32_t row = (chains_.blocks[place.block].first_vertex + link) * std::uint32_t(state_row::count);
    return (row + std::uint32_t(state_row::velocity)) * std::uint32_t(k_lanes) + place.lane;
  }

  strand_interaction::VelocityLayout velocity_layout() const {
    strand_interaction::VelocityLayout layout{
        {}, std::uint32_t(k_lanes), std::uint32_t((state_row::velocity_before - state_row::velocity) * k_lanes)};
    for (std::size_t s = 0; s < rest_.strand_count(); ++s) {
      const ChainPlace& place = chains_.places[s];
      std::uint32_t above = 0;
      for (std::size_t i = rest_.offsets[s]; i < rest_.offsets[s + 1]; ++i) {
        // What is carried has none, and what is welded is pushed once.
        const std::uint32_t link = place.has_links ? chains_.links_of_vertex[i] : 0;
        layout.places.push_back(link == above ? layout.k_carried : velocity_at(place, link));
        above = link;
      }
    }
    return layout;
  }

  Result<void> make_buffers() {
    std::vector<glm::uvec4> places, blocks{{0, 0, 0, 0}};
    for (const ChainPlace& place : chains_.places)
      places.emplace_back(place.block, place.lane, place.anchor, place.has_links);
    if (!chains_.blocks.empty()) blocks.clear();
    for (const BlockPlace& block : chains_.blocks)
      blocks.emplace_back(block.links, block.first_vertex, block.strands, 0);
    std::vector<glm::uvec4> vertices;
    std::vector<glm::vec4> world;
    for (std::size_t i = 0; i < rest_.vertex_count(); ++i) {
      const glm::vec3& at = rest_.positions[i];
      vertices.push_back({std::bit_cast<glm::uvec3>(at), chains_.links_of_vertex[i]});
      world.emplace_back(at, 1);
    }
    CUTICLE_TRY(make_chain_buffers());
    CUTICLE_TRY(upload_reach({}));
    CUTICLE_TRY(refill(*device_, buffers_.places, places));
    CUTICLE_TRY(refill(*device_, buffers_.blocks, blocks));
    CUTICLE_TRY(refill(*device_, buffers_.offsets, rest_.offsets));
    CUTICLE_TRY(refill(*device_, buffers_.vertices, vertices));
    CUTICLE_TRY(refill(*device_, buffers_.world, world));
    CUTICLE_TRY(refill(*device_, buffers_.velocities, std::vector<glm::vec4>(vertices.size(), glm::vec4(0))));
    return refill(*device_, buffers_.resets,
                  std::vector<std::uint32_t>(std::max<std::size_t>(1, rest_.strand_count()), 0));
  }

  Result<void> make_chain_buffers() {
    const auto or_one = [](Rows<float> values) {
      if (values.empty()) values.resize(1, 0.f);
      return values;
    };
    const std::size_t vertices = chains_.state.size() / std::size_t(state_row::count);
    CUTICLE_TRY(refill(*device_, buffers_.rest, or_one(chains_.rest)));
    CUTICLE_TRY(refill(*device_, buffers_.state, or_one(chains_.state)));
    CUTICLE_TRY(refill(*device_, buffers_.strands, or_one(chains_.strand)));
    CUTICLE_TRY(
        refill(*device_, buffers_.scratch, or_one(Rows<float>(vertices * std::size_t(program_.scratch_rows), 0.f))));
    CUTICLE_TRY(refill(*device_, buffers_.own, or_one(program_.own)));
    CUTICLE_TRY(refill(*device_, buffers_.steps, std::vector<ChainStep<float>>(1)));
    CUTICLE_TRY(refill(*device_, buffers_.boxes, std::vector<LinkBox<float>>(1)));
    CUTICLE_TRY(refill(*device_, buffers_.fields, std::vector<LinkField<float>>(1)));
    CUTICLE_TRY(refill(*device_, buffers_.field_values, std::vector<float>(1)));
    CUTICLE_TRY(refill(*device_, buffers_.carries, std::vector<ColliderCarry<float>>(1)));
    return refill(*device_, buffers_.spheres, std::vector<LinkSphere<float>>(1));
  }

  /// `skinned`: null where a head carries the hair.
  void dispatch(gpu::Commands& commands, const gpu::Kernel& kernel, const Constants& constants,
                const gpu::Buffer* skinned = nullptr) const {
    const Buffers& b = buffers_;
    std::vector<const gpu::Buffer*> bound{&b.places,     &b.blocks,  &b.offsets, &b.vertices, &b.rest,  &b.state,
                                          &b.strands,    &b.scratch, &b.steps,   &b.spheres,  &b.frame, &b.world,
                                          &b.velocities, &b.resets,  &b.own,     &b.reach};
    if (skinned ? constants.all_boxes + constants.all_fields > 0 : met_.others)
      bound.insert(bound.end(), {&b.boxes, &b.fields, &b.field_values, &b.carries});
    if (skinned) bound.insert(bound.end(), {&b.skin_strands, &b.skin_begin, skinned});
    commands.dispatch(kernel, bound, {}, gpu::bytes_of(constants), (constants.strand_count + 63) / 64);
  }

  std::shared_ptr<gpu::Device> device_;
  ChainSettings settings_;
  strands::Groom rest_;
  Chains<float> chains_;
  ChainGpuProgram program_;
  Buffers buffers_;
  gpu::Kernel free_, touching_;
  /// By whether colliders move by themselves, and whether there are fields; made with the first such collider.
  std::array<std::array<gpu::Kernel, 2>, 2> beside_all_;
  struct {
    bool spheres = false, fields = false, moving = false, others = false;  ///< others: than spheres
  } met_;
  std::array<std::array<gpu::Kernel, 2>, 2> on_skin_;  ///< by whether there are colliders, and fields
  std::vector<FieldPointer> fields_;                   ///< whose values are on the device
  std::vector<std::uint32_t> reach_;                   ///< as it is on the device
  std::unique_ptr<strand_interaction::StrandInteractionGpu> interaction_;  ///< null without the effect
  std::unique_ptr<clumping::ClumpingGpu> clumping_;                        ///< null without the effect
  sleep::Watch watch_;
  HeadMotion motion_{true};  // meets all colliders
  Placing placing_;
  ChainClock clock_;
};

}  // namespace

Result<std::unique_ptr<GpuSolver>> make_chain_solver_gpu(std::shared_ptr<gpu::Device> device,
                                                         const strands::Groom& rest, const ChainSettings& settings,
                                                         Chains<float> chains, ChainGpuProgram program) {
  auto made =
      std::make_unique<ChainGpuSolver>(std::move(device), rest, settings, std::move(chains), std::move(program));
  CUTICLE_TRY(made->make());
  return std::unique_ptr<GpuSolver>(std::move(made));
}

Result<void> check_for_gpu(const strands::Groom& rest, const ChainSettings& settings) {
  CUTICLE_TRY(strands::validate(rest));
  CUTICLE_TRY(check(settings));
  if (rest.vertex_count() == 0) return bad_input("groom: no strands to simulate");
  if (settings.double_precision)
    return usage_error("double_precision: the kernel computes in float", "leave it out on a GPU");
  return {};
}

}  // namespace cuticle::sim::chains
