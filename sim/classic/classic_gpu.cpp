#include "sim/classic/settings.h"
#include "sim/colliders/contact_gpu.h"
#include "sim/rest_pose.h"
#include "sim/solver_gpu.h"
#include "sim/strand_buffers_gpu.h"

#include <algorithm>
#include <bit>
#include <functional>

#include <constraints_comp.spv.h>
#include <constraints_red_black_comp.spv.h>
#include <integrate_head.spv.h>
#include <integrate_skin.spv.h>

namespace cuticle::sim::classic {
namespace {

/// The kernels' push constants.
struct KernelConstants {
  StepConstants step;
  glm::vec3 translation{0};
  std::uint32_t iterations = 1, part = 0, ends_substep = 0;
  float pearl_radius = 0;
  std::uint32_t contacts = 0;
};
static_assert(sizeof(KernelConstants) == 128, "the layout of sim/strand_kernel.glsl");

constexpr std::string_view k_pass = "classic";

/// In the order of the constant ids in constraints.glsl.
std::vector<std::uint32_t> specialization(const Sweep& sweep) {
  return {sweep.order == Order::red_black, sweep.long_range, std::bit_cast<std::uint32_t>(sweep.sphere_root),
          std::bit_cast<std::uint32_t>(sweep.sphere_tip)};
}
std::span<const std::uint32_t> constraints_code(const Sweep& sweep) {
  if (sweep.order == Order::red_black) return constraints_red_black_comp;
  return constraints_comp;
}

/// Work groups that every device takes in one dispatch; the kernel of a group per strand walks on from there.
constexpr std::uint32_t k_max_groups = 65535;

class ClassicGpuSolver final : public GpuSolver {
 public:
  ClassicGpuSolver(std::shared_ptr<gpu::Device> device, const strands::Groom& rest, const Settings& settings)
      : device_(std::move(device)), settings_(settings), pose_(make_rest_pose(rest, settings.clamped_vertices)) {}

  Result<void> make() {
    CUTICLE_ASSIGN(buffers_, make_strand_buffers(*device_, pose_));
    CUTICLE_ASSIGN(integrate_, device_->make_kernel(integrate_head, shader_interface(k_strand_buffers)));
    CUTICLE_ASSIGN(constraints_,
                   device_->make_kernel(constraints_code(settings_.sweep), shader_interface(k_strand_buffers)));
    if (!settings_.contact) return {};
    CUTICLE_ASSIGN(contact_, colliders::make_contact_kernel(*device_, shader_interface(k_strand_buffers)));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameInput& input) override {
    CUTICLE_ASSIGN(const std::vector<Substep> parts, motion_.advance(input, substeps(settings_, input.duration)));
    return record_parts(commands, input, parts, nullptr);
  }

  Result<void> record_on_skin(gpu::Commands& commands, const FrameInput& input, const gpu::Buffer& skinned) override {
    CUTICLE_EXPECT(skinned.size() >= buffers_.world.size(), "a place per vertex");
    CUTICLE_ASSIGN(const std::vector<Substep> parts,
                   motion_.advance_on_skin(input, substeps(settings_, input.duration)));
    if (skin_begin_.size() == 0) CUTICLE_TRY(make_for_skin());
    const std::size_t bytes = buffers_.world.size();
    if (parts[0].onto_skin) {
      for (const gpu::Buffer* put : {&skin_begin_, &buffers_.positions}) commands.copy(skinned, *put, bytes);
      commands.fill(buffers_.velocities, 0);
    }
    CUTICLE_TRY(record_parts(commands, input, parts, &skinned));
    commands.copy(skinned, skin_begin_, bytes);
    return {};
  }

  Result<void> advance(const FrameInput& input) override { return run(*device_, input); }

  Result<State> state() override {
    const std::size_t vertices = pose_.places.size();
    CUTICLE_ASSIGN(const std::vector<glm::vec4> world, gpu::read_buffer<glm::vec4>(*device_, buffers_.world, vertices));
    CUTICLE_ASSIGN(const std::vector<glm::vec4> velocities,
                   gpu::read_buffer<glm::vec4>(*device_, buffers_.velocities, vertices));
    CUTICLE_ASSIGN(std::vector<std::uint32_t> resets,
                   gpu::read_buffer<std::uint32_t>(*device_, buffers_.resets, pose_.strand_count()));
    State state;
    state.positions.assign(world.begin(), world.end());
    state.velocities.assign(velocities.begin(), velocities.end());
    for (std::uint32_t fired : resets) state.guards_fired += fired;
    state.resets = std::move(resets);
    return state;
  }

  const gpu::Buffer& positions() const override { return buffers_.world; }
  const gpu::Buffer& velocities() const override { return buffers_.velocities; }

  std::map<std::string, std::uint32_t> dispatches(const FrameInput& input) const override {
    const std::uint32_t count = substeps(settings_, input.duration);
    std::map<std::string, std::uint32_t> result{{"classic", 2 * count}};
    const bool reaches = input.reached.empty() || std::ranges::any_of(input.reached, std::identity());
    if (settings_.contact && reaches && !(input.colliders.empty() && input.moving.empty())) result["colliders"] = count;
    return result;
  }

 private:
  gpu::ShaderInterface shader_interface(std::uint32_t buffers) const {
    return {.storage_buffers = buffers,
            .push_constant_bytes = sizeof(KernelConstants),
            .specialization = specialization(settings_.sweep)};
  }

  Result<void> make_for_skin() {
    CUTICLE_ASSIGN(integrate_, device_->make_kernel(integrate_skin, shader_interface(k_strand_buffers + 2)));
    CUTICLE_ASSIGN(skin_begin_, device_->make_buffer(buffers_.world.size()));
    return {};
  }

  /// `skinned`: null where a head carries the rest pose.
  Result<void> record_parts(gpu::Commands& commands, const FrameInput& input, std::span<const Substep> parts,
                            const gpu::Buffer* skinned) {
    colliders::SubstepSpheres spheres;
    if (settings_.contact) spheres = colliders::packed(skinned ? without_head(input) : input, parts.size());
    std::uint32_t met_strands = 0;
    if (spheres.count > 0) {
      CUTICLE_TRY(upload_spheres(*device_, buffers_, spheres.spheres));
      CUTICLE_ASSIGN(met_strands, upload_reach(*device_, buffers_, pose_.strand_count(), input.reached));
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      KernelConstants part = constants(parts[k], spheres);
      part.part = std::uint32_t(k) | std::uint32_t(parts.size()) << 16;
      record_substep(commands, part, met_strands, skinned);
    }
    return {};
  }

  KernelConstants constants(const Substep& part, const colliders::SubstepSpheres& spheres) const {
    KernelConstants constants{.step = make_step(settings_, part, static_cast<std::uint32_t>(pose_.strand_count()))};
    constants.translation = part.translation;
    constants.iterations = settings_.iterations;
    if (settings_.contact) {
      constants.pearl_radius = settings_.contact->pearl_radius;
      constants.contacts = std::uint32_t(spheres.count) | (spheres.move ? 0x40000000u : 0u) |
                           (settings_.contact->fit_pearls ? 0x80000000u : 0u);
    }
    return constants;
  }

  void dispatch(gpu::Commands& commands, const gpu::Kernel& kernel, const KernelConstants& constants,
                std::uint32_t groups, const gpu::Buffer* skinned = nullptr) const {
    const StrandBuffers& b = buffers_;
    std::vector<const gpu::Buffer*> bound{&b.offsets,    &b.places, &b.traits, &b.positions, &b.starts,
                                          &b.velocities, &b.resets, &b.world,  &b.spheres,   &b.reach};
    if (skinned) bound.insert(bound.end(), {&skin_begin_, skinned});
    commands.dispatch(kernel, bound, {}, gpu::bytes_of(constants), groups);
  }

  /// With spheres the contact's kernel, which sweeps lengths and spheres in turn, ends the substep of the strands
  /// that they may touch.
  void record_substep(gpu::Commands& commands, KernelConstants constants, std::uint32_t met_strands,
                      const gpu::Buffer* skinned) const {
    const std::uint32_t strands = constants.step.strand_count, groups = (strands + 63) / 64;
    commands.begin_pass(k_pass);
    dispatch(commands, integrate_, constants, groups, skinned);
    constants.ends_substep = met_strands == 0;
    dispatch(commands, constraints_, constants,
             settings_.sweep.order == Order::red_black ? std::min(strands, k_max_groups) : groups);
    commands.end_pass();
    if (met_strands == 0) return;
    commands.begin_pass(colliders::k_contact_pass);
    constants.ends_substep = met_strands;
    dispatch(commands, contact_, constants, (met_strands + 63) / 64);
    commands.end_pass();
  }

  std::shared_ptr<gpu::Device> device_;
  Settings settings_;
  RestPose pose_;
  StrandBuffers buffers_;
  gpu::Buffer skin_begin_;  ///< where the skin carried the vertices a frame before; empty: a head does
  gpu::Kernel integrate_, constraints_, contact_;
  HeadMotion motion_;
};

Result<std::unique_ptr<GpuSolver>> create_gpu(std::shared_ptr<gpu::Device> device, const strands::Groom& rest,
                                              const registry::ParameterValues& solver, const EffectBlocks& effects) {
  CUTICLE_TRY(check_effects(effects));
  CUTICLE_TRY(strands::validate(rest));
  if (rest.vertex_count() == 0) return bad_input("groom: no strands to simulate");
  auto made = std::make_unique<ClassicGpuSolver>(std::move(device), rest,
                                                 make_settings(registry::from_values<Classic>(solver), effects));
  CUTICLE_TRY(made->make());
  return std::unique_ptr<GpuSolver>(std::move(made));
}

}  // namespace

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"classic", create_gpu};
  return effect;
}

}  // namespace cuticle::sim::classic
