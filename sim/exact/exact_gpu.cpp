#include <bit>

#include <cuticle/sim/exact/chains.h>
#include <cuticle/sim/exact/placing.h>
#include <cuticle/sim/solver_gpu.h>

#include <exact_free.spv.h>
#include <exact_pulled.spv.h>
#include <exact_pulled_touching.spv.h>
#include <exact_touching.spv.h>

namespace cuticle::sim::exact {
namespace {

constexpr std::string_view k_pass = "simulate.exact";
constexpr std::uint32_t k_buffers = 14;

/// The kernel's push constants.
struct Constants {
  std::uint32_t strand_count = 0, step_count = 0, sphere_count = 0, carries = 0;
};

/// FramePlace of exact.comp: columns of three matrices, then two vectors.
std::vector<glm::vec4> frame_place(const glm::vec4& carry, const Placing& placing) {
  std::vector<glm::vec4> place;
  const glm::dmat3 carried = matrix_of(carry);
  const auto axis = [](int k) { return glm::dvec3(k == 0, k == 1, k == 2); };
  const glm::dvec3 zero(0), moving = placing.velocity(zero);
  for (int k = 0; k < 3; ++k) place.emplace_back(glm::dvec4(carried[k], 0));
  for (int k = 0; k < 3; ++k) place.emplace_back(glm::dvec4(placing.turned(axis(k)), 0));
  for (int k = 0; k < 3; ++k) place.emplace_back(glm::dvec4(placing.velocity(axis(k)) - moving, 0));
  place.emplace_back(glm::dvec4(placing.world(zero), 0));
  place.emplace_back(glm::dvec4(moving, 0));
  return place;
}

struct Buffers {
  gpu::Buffer places, blocks, offsets, vertices, rest, state, strands, scratch, steps, spheres, frame, world,
      velocities, resets;
};

template <class T>
Result<void> refill(gpu::Device& device, gpu::Buffer& buffer, const std::vector<T>& data) {
  const std::span<const T> values(data);
  if (buffer.size() >= values.size_bytes()) return device.upload(buffer, std::as_bytes(values));
  CUTICLE_ASSIGN(buffer, gpu::make_buffer_from(device, values));
  return {};
}

class ExactGpuSolver final : public GpuSolver {
 public:
  ExactGpuSolver(std::shared_ptr<gpu::Device> device, const strands::Groom& rest, const Settings& settings)
      : device_(std::move(device)), settings_(settings), rest_(rest) {}

  Result<void> make() {
    CUTICLE_TRY(make_buffers());
    const gpu::ShaderInterface interface { .storage_buffers = k_buffers, .push_constant_bytes = sizeof(Constants) };
    const bool pulls = settings_.shape_stiffness > 0;
    CUTICLE_ASSIGN(free_,
                   pulls ? device_->make_kernel(exact_pulled, interface) : device_->make_kernel(exact_free, interface));
    if (!settings_.contact) return {};
    CUTICLE_ASSIGN(touching_, pulls ? device_->make_kernel(exact_pulled_touching, interface)
                                    : device_->make_kernel(exact_touching, interface));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    placing_.advance(parts);
    std::vector<ChainStep<float>> steps = clock_.steps<float>(settings_, parts);
    std::vector<LinkSphere<float>> spheres = link_spheres<float>(settings_, input.colliders);
    const Constants constants{std::uint32_t(rest_.strand_count()), std::uint32_t(steps.size()),
                              std::uint32_t(spheres.size()), parts[0].carry.w != 1.f};
    if (!steps.empty()) CUTICLE_TRY(refill(*device_, buffers_.steps, steps));
    if (!spheres.empty()) CUTICLE_TRY(refill(*device_, buffers_.spheres, spheres));
    CUTICLE_TRY(refill(*device_, buffers_.frame, frame_place(parts[0].carry, placing_)));
    commands.begin_pass(k_pass);
    dispatch(commands, spheres.empty() ? free_ : touching_, constants);
    commands.end_pass();
    return {};
  }

  Result<void> advance(const FrameInput& input) override {
    gpu::Commands commands = device_->record();
    CUTICLE_TRY(record(commands, input));
    CUTICLE_ASSIGN([[maybe_unused]] const gpu::SubmitCost cost, device_->submit(std::move(commands)));
    return {};
  }

  Result<State> state() override {
    const std::size_t vertices = rest_.vertex_count();
    CUTICLE_ASSIGN(const std::vector<glm::vec4> world, gpu::read_buffer<glm::vec4>(*device_, buffers_.world, vertices));
    CUTICLE_ASSIGN(const std::vector<glm::vec4> velocities,
                   gpu::read_buffer<glm::vec4>(*device_, buffers_.velocities, vertices));
    CUTICLE_ASSIGN(const std::vector<std::uint32_t> resets,
                   gpu::read_buffer<std::uint32_t>(*device_, buffers_.resets, rest_.strand_count()));
    State state;
    state.positions.assign(world.begin(), world.end());
    state.velocities.assign(velocities.begin(), velocities.end());
    for (std::uint32_t fired : resets) state.guards_fired += fired;
    return state;
  }

  const gpu::Buffer& positions() const override { return buffers_.world; }

  std::map<std::string, std::uint32_t> dispatches(const FrameInput&) const override { return {{"exact", 1}}; }

 private:
  Result<void> make_buffers() {
    const Chains<float> chains = make_chains<float>(rest_, settings_);
    std::vector<glm::uvec4> places, blocks{{0, 0, 0, 0}};
    for (const ChainPlace& place : chains.places)
      places.emplace_back(place.block, place.lane, place.anchor, place.has_links);
    if (!chains.blocks.empty()) blocks.clear();
    for (const BlockPlace& block : chains.blocks)
      blocks.emplace_back(block.links, block.first_vertex, block.strands, 0);
    std::vector<glm::uvec4> vertices;
    std::vector<glm::vec4> world;
    for (std::size_t i = 0; i < rest_.vertex_count(); ++i) {
      const glm::vec3& at = rest_.positions[i];
      vertices.push_back({std::bit_cast<glm::uvec3>(at), chains.links_of_vertex[i]});
      world.emplace_back(at, 1);
    }
    CUTICLE_TRY(make_chain_buffers(chains));
    CUTICLE_TRY(refill(*device_, buffers_.places, places));
    CUTICLE_TRY(refill(*device_, buffers_.blocks, blocks));
    CUTICLE_TRY(refill(*device_, buffers_.offsets, rest_.offsets));
    CUTICLE_TRY(refill(*device_, buffers_.vertices, vertices));
    CUTICLE_TRY(refill(*device_, buffers_.world, world));
    CUTICLE_TRY(refill(*device_, buffers_.velocities, std::vector<glm::vec4>(vertices.size(), glm::vec4(0))));
    return refill(*device_, buffers_.resets,
                  std::vector<std::uint32_t>(std::max<std::size_t>(1, rest_.strand_count()), 0));
  }

  Result<void> make_chain_buffers(const Chains<float>& chains) {
    const auto or_one = [](std::vector<float> values) {
      if (values.empty()) values.resize(1, 0.f);
      return values;
    };
    const std::size_t vertices = chains.state.size() / std::size_t(state_row::count);
    CUTICLE_TRY(refill(*device_, buffers_.rest, or_one(chains.rest)));
    CUTICLE_TRY(refill(*device_, buffers_.state, or_one(chains.state)));
    CUTICLE_TRY(refill(*device_, buffers_.strands, or_one(chains.strand)));
    CUTICLE_TRY(refill(*device_, buffers_.scratch,
                       or_one(std::vector<float>(vertices * std::size_t(scratch_row::count), 0.f))));
    CUTICLE_TRY(refill(*device_, buffers_.steps, std::vector<ChainStep<float>>(1)));
    return refill(*device_, buffers_.spheres, std::vector<LinkSphere<float>>(1));
  }

  void dispatch(gpu::Commands& commands, const gpu::Kernel& kernel, const Constants& constants) const {
    const Buffers& b = buffers_;
    commands.dispatch(kernel,
                      {&b.places, &b.blocks, &b.offsets, &b.vertices, &b.rest, &b.state, &b.strands, &b.scratch,
                       &b.steps, &b.spheres, &b.frame, &b.world, &b.velocities, &b.resets},
                      {}, gpu::bytes_of(constants), (constants.strand_count + 63) / 64);
  }

  std::shared_ptr<gpu::Device> device_;
  Settings settings_;
  strands::Groom rest_;
  Buffers buffers_;
  gpu::Kernel free_, touching_;
  HeadMotion motion_;
  Placing placing_;
  ChainClock clock_;
};

Result<std::unique_ptr<GpuSolver>> create_gpu(std::shared_ptr<gpu::Device> device, const strands::Groom& rest,
                                              const registry::ParameterValues& solver, const EffectBlocks& effects) {
  CUTICLE_TRY(strands::validate(rest));
  if (rest.vertex_count() == 0) return bad_input("groom: no strands to simulate");
  const Settings settings = make_settings(solver, effects);
  if (settings.double_precision)
    return usage_error("double_precision: the kernel computes in float", "leave it out on a GPU");
  auto made = std::make_unique<ExactGpuSolver>(std::move(device), rest, settings);
  CUTICLE_TRY(made->make());
  return std::unique_ptr<GpuSolver>(std::move(made));
}

}  // namespace

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"exact", create_gpu};
  return effect;
}

}  // namespace cuticle::sim::exact
