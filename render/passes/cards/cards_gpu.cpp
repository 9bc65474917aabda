#include <array>

#include <fmt/core.h>

#include "render/lights_gpu.h"
#include "render/passes/cards/cards.h"
#include "render/passes/cards/placement_gpu.h"
#include "render/passes/cards/sorting_gpu.h"
#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "render/strand_shading/frame_gpu.h"

#include <cards_early_frag.spv.h>
#include <cards_frag.spv.h>
#include <cards_prime_frag.spv.h>
#include <cards_vert.spv.h>

namespace cuticle::render::cards {

namespace {

/// As cards_frame.glsl has it.
struct CardFrame {
  glm::mat4 world_to_clip;
  glm::vec4 eye, atlas, diffuse, primary, secondary, shifts, multiple;
  std::uint32_t vertex_count, unused[3];
  LightRows lights;
};
static_assert(sizeof(CardFrame) == 64 + 16 * 8 + 16 * 3 * k_max_lights);

/// What light scattered many times is taken from; cards_shade.glsl has the same numbers.
enum class ScatteredBy : std::uint32_t { none, frame_multiple, dual_scattering };

void set_material(CardFrame& frame, const bsdf::scheuermann::Parameters& p) {
  const glm::dvec3 all = p.base * p.occlusion;
  frame.diffuse = glm::vec4(all * p.diffuse, 0);
  frame.primary = glm::vec4(all * p.primary, p.primary_exponent);
  frame.secondary = glm::vec4(all * p.secondary, p.secondary_exponent);
  frame.shifts = glm::vec4(p.primary_shift, p.secondary_shift, 1, 0);
}

/// u = 0 and 1 of a card lie at the borders of its kind's hair.
glm::vec4 atlas_of(const strands::CardTextures& textures, double opaque_alpha) {
  const float first = textures.atlas_uv(0, 0, 0).x, last = textures.atlas_uv(0, 1, 0).x;
  return {first, last - first, textures.atlas_uv(1, 0, 0).x - first, float(opaque_alpha)};
}

void set_view(CardFrame& frame, const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const Lights& lights = resources.get<Lights>();
  frame.world_to_clip = glm::mat4(projection_matrix(view.camera) * view_matrix(view.camera));
  frame.eye = glm::vec4(view.camera.position, 1);
  frame.diffuse.w = float(lights.all.size());
  frame.lights = light_rows(lights.all);
}

constexpr std::size_t k_max_steps = 4;

/// One draw of all cards.
struct Step {
  const char* name;
  bool depth_alone;  ///< no colour
  gpu::GraphicsPipeline pipeline;
};

class Cards : public GpuPass {
 public:
  explicit Cards(std::shared_ptr<gpu::Device> device) : device_(std::move(device)) {}

  Result<void> make_parts(const Resources& resources) {
    const auto parameters = parameters_of<Parameters>(resources);
    CUTICLE_ASSIGN(
        const strands::HairCards cards,
        strands::make_hair_cards(*resources.get<RestStrands>().groom, resources.get<Surfaces>().head, parameters));
    CUTICLE_ASSIGN(placement_, Placement::make(*device_, resources, cards));
    frame_.vertex_count = placement_.row_count();
    CUTICLE_ASSIGN(sorting_, Sorting::make(*device_, cards.mesh, parameters.order));
    CUTICLE_ASSIGN(texture_,
                   device_->make_texture({.size = {cards.textures.atlas.width, cards.textures.atlas.height}}));
    CUTICLE_TRY(device_->upload(texture_, cards.textures.atlas.pixels));
    CUTICLE_ASSIGN(frame_buffer_, device_->make_buffer(sizeof(CardFrame)));
    CUTICLE_ASSIGN(shaded_, device_->make_buffer(k_max_steps * sizeof(std::uint32_t)));
    CUTICLE_TRY(take_parameters(resources));
    frame_.atlas = atlas_of(cards.textures, parameters.opaque_alpha);
    counts_ = parameters.count_fragments;
    return make_steps(resources, parameters);
  }

  Result<bool> take_parameters(const Resources& resources) override {
    CUTICLE_ASSIGN(const bsdf::scheuermann::Parameters material,
                   material_of(*resources.get<FibreMaterial>().model, *resources.get<FibreMaterial>().values));
    set_material(frame_, material);
    if (is_lit_as_strands(resources)) CUTICLE_TRY(light_as_strands(resources, parameters_of<Parameters>(resources)));
    return true;
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    set_view(frame_, resources);
    CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
    placement_.record(commands, resources);
    sorting_.record(commands, resources.get<FrameView>().camera, placement_.placed());
    if (counts_) commands.fill(shaded_, 0);
    for (std::size_t k = 0; k < steps_.size(); ++k) draw(commands, resources, k);
    return {};
  }

  /// What depth left to shade, counted by the shaders: the device's own statistics may count before depth is tested.
  Result<Settled> settle() override {
    Settled settled;
    if (!counts_) return settled;
    CUTICLE_ASSIGN(const auto shaded, gpu::read_buffer<std::uint32_t>(*device_, shaded_, steps_.size()));
    for (std::size_t k = 0; k < steps_.size(); ++k)
      if (!steps_[k].depth_alone)
        settled.notes.push_back(fmt::format("{}: {} fragments shaded", steps_[k].name, shaded[k]));
    return settled;
  }

 private:
  /// Whether what the hair about a point scatters stands in place of a diffuse colour, as by the other ways of drawing:
  /// where a material is of a fibre, and hair shadows hair or dual scattering is asked for.
  static bool is_lit_as_strands(const Resources& resources) {
    return resources.get<FibreMaterial>().model->entry.name != "scheuermann" &&
           (resources.find<dual_scattering::Terms>() || is_shadowed_by_hair(resources));
  }
  static bool is_shadowed_by_hair(const Resources& resources) {
    return !transmittance_of(resources).reached.empty() && !transmittance_of(resources).of_surfaces_alone;
  }

  /// The base texture, which varies a diffuse colour from 1 down, then leaves the mean as it is.
  Result<void> light_as_strands(const Resources& resources, const Parameters& parameters) {
    const FibreMaterial& material = resources.get<FibreMaterial>();
    frame_.diffuse = glm::vec4(0);
    frame_.shifts.z = float(1 / (1 - 0.5 * parameters.base_variation));
    scattered_by_ =
        resources.find<dual_scattering::Terms>() ? ScatteredBy::dual_scattering : ScatteredBy::frame_multiple;
    if (scattered_by_ == ScatteredBy::dual_scattering) return {};
    const double strength = parameters_of<lines::Parameters>(resources).ambient;
    CUTICLE_ASSIGN(frame_.multiple, strand_shading::multiple_scattering(*material.model, *material.values, strength));
    return {};
  }

  /// A step's shader, blending and depth; every step has the same vertices.
  struct StepSettings {
    std::span<const std::uint32_t> fragment;
    bool is_opaque = false, writes_depth = false;
    gpu::DepthCompare compare = gpu::DepthCompare::less;
    bool cull_front = false, cull_back = false;
  };

  Result<void> add_step(const Resources& resources, const char* name, const StepSettings& settings) {
    gpu::GraphicsDescription description = target_description(resources);
    const bool depth_alone = settings.fragment.data() == cards_prime_frag;
    description.vertex_spirv = cards_vert;
    description.fragment_spirv = settings.fragment;
    description.interface = {
        .storage_buffers = 7,
        .textures = 1,
        .specialization = with_channels({settings.is_opaque ? 1u : 0u, std::uint32_t(steps_.size()), counts_ ? 1u : 0u,
                                         transmittance_of(resources).reached.empty() ? 0u : 1u},
                                        transmittance_of(resources).channels),
        .texels = {GatheredTransmittance::texels(5)}};
    for (std::uint32_t constant : {std::uint32_t(scattered_by_), std::uint32_t(is_shadowed_by_hair(resources)),
                                   std::uint32_t(resources.find<surface_shadow::Maps>() != nullptr)})
      description.interface.specialization.push_back(constant);
    if (depth_alone) description.color_formats.clear();
    description.blend = settings.is_opaque || depth_alone ? gpu::BlendMode::none : gpu::BlendMode::alpha;
    description.depth_write = settings.writes_depth;
    description.depth_compare = settings.compare;
    description.cull_front_faces = settings.cull_front;
    description.cull_back_faces = settings.cull_back;
    CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device_->make_graphics(description));
    steps_.push_back({name, depth_alone, std::move(pipeline)});
    return {};
  }

  /// A8: opaque parts, back faces, front faces, each by alpha test. A9: the depth of opaque parts first, so that the
  /// tests of depth do the rest, before anything is shaded.
  Result<void> make_steps(const Resources& resources, const Parameters& parameters) {
    using gpu::DepthCompare;
    const bool primes = !parameters.three_pass;
    const TransparentDepth writes = parameters.transparent_depth;
    const bool both = writes == TransparentDepth::both;
    const bool front = writes == TransparentDepth::front || both || (writes == TransparentDepth::printed && !primes);
    const std::span<const std::uint32_t> rest =
        primes ? std::span<const std::uint32_t>(cards_early_frag) : std::span<const std::uint32_t>(cards_frag);
    if (primes) {
      CUTICLE_TRY(add_step(resources, "cards: depth", {.fragment = cards_prime_frag, .writes_depth = true}));
      CUTICLE_TRY(
          add_step(resources, "cards: opaque", {.fragment = rest, .is_opaque = true, .compare = DepthCompare::equal}));
    } else {
      CUTICLE_TRY(add_step(resources, "cards: opaque", {.fragment = rest, .is_opaque = true, .writes_depth = true}));
    }
    CUTICLE_TRY(add_step(resources, "cards: back faces", {.fragment = rest, .writes_depth = both, .cull_front = true}));
    return add_step(resources, "cards: front faces", {.fragment = rest, .writes_depth = front, .cull_back = true});
  }

  void draw(gpu::Commands& commands, const Resources& resources, std::size_t k) const {
    const Step& step = steps_[k];
    // The first step that draws begins the targets as the frame has them; what follows goes on.
    const bool begins_depth = k == 0 && !resources.get<Targets>().keep,
               first_color = k == (steps_[0].depth_alone ? 1u : 0u);
    gpu::Commands::Target target = color_target(resources);
    target.keep = target.keep || !first_color;
    if (k + 1 < steps_.size()) target.resolve = nullptr;
    if (counts_) commands.begin_count(step.name);
    commands.begin_rendering({&target, step.depth_alone ? 0u : 1u}, resources.get<Targets>().depth, !begins_depth);
    commands.draw(step.pipeline,
                  {&placement_.placed(), &placement_.rests(), &sorting_.indices(), &frame_buffer_, &shaded_,
                   &placement_.reached(),
                   scattered_by_ == ScatteredBy::dual_scattering ? resources.get<dual_scattering::Terms>().values
                                                                 : &frame_buffer_},
                  {&texture_}, {}, sorting_.index_count());
    commands.end_rendering();
    if (counts_) commands.end_count();
  }

  std::shared_ptr<gpu::Device> device_;
  Placement placement_;
  Sorting sorting_;
  gpu::Texture texture_;
  gpu::Buffer frame_buffer_;
  gpu::Buffer shaded_;  ///< per step the fragments that its shader ran for, where they are counted
  CardFrame frame_{};
  std::vector<Step> steps_;
  bool counts_ = false;
  ScatteredBy scattered_by_ = ScatteredBy::none;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_EXPECT(resources.get<RestStrands>().groom && resources.get<FibreMaterial>().model,
                 "cards were planned without strands");
  auto pass = std::make_unique<Cards>(std::move(device));
  CUTICLE_TRY(pass->make_parts(resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"cards", create};
  return table;
}

}  // namespace cuticle::render::cards
