#pragma once
// GPU half of a render pass, and the resources that the passes of one frame share.
#include <map>
#include <memory>
#include <optional>

#include "core/registry/members.h"
#include "core/view.h"
#include "gpu/device.h"
#include "lut/table_set.h"
#include "render/pass.h"
#include "shadows/channels.h"
#include "shadows/method_gpu.h"
#include "strands/binding/carry_gpu.h"
#include "strands/mesh.h"
#include "strands/skinning/skinning_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace cuticle::render {

namespace tile_lists {
struct TileLists;
}
namespace cull_strands {
struct SeenStrands;
}
namespace surface_shadow {
struct Maps;
}

/// What a pixel sees of the hair, as seen.glsl has it.
struct Seen {
  std::uint32_t first, last;
  float coverage;
  std::uint32_t samples, cost;
};

/// How strands become triangles or lines, for what looks at which of them show.
struct StrandDraw {
  double (*full_px)(const PassParameters&);  ///< that parameter of the pass that draws them
  std::uint32_t corners;                     ///< vertices a segment
  double width_factor = 0;                   ///< the greatest on a strand's own width
  bool of_one_width = false;                 ///< drawn as wide as lines::line_width says, not by their own widths
};

/// A character's skin, and the hair on it, posed for the frame.
struct PosedCharacter {
  strands::GpuSkin* skin;
  strands::GpuCarry* hair;
  std::span<const strands::JointMotion> motions;
  strands::Skinning method;
};

/// What the passes of a frame read and write. Pointers are null where the plan left the producer out.
struct FrameResources {
  Camera camera;
  /// Of a picture that is drawn in chunks, the one that the targets hold: pixels; no size: all of the picture.
  glm::ivec2 part_corner{0}, part_size{0};
  std::vector<Light> lights;
  shadows::GpuStrands strands;                    ///< drawn strands: vec4 (position, radius) per vertex
  shadows::GpuStrands casters;                    ///< those of them that cast shadows
  const gpu::Buffer* tangents = nullptr;          ///< vec4 (unit tangent, fraction of the strand's length) per vertex
  shadows::Channels channels;                     ///< whose transmittance differs
  std::vector<const gpu::Buffer*> transmittance;  ///< per light, for each of `channels.alpha`: one float per vertex
  bool of_surfaces_alone = false;                 ///< `transmittance` is no shadow method's
  const surface_shadow::Maps* surface_shadow = nullptr;  ///< what surfaces and hair cast on each other
  std::vector<const gpu::Texture*> tables;               ///< in the layout's order
  const lut::TableSet* table_set = nullptr;
  const gpu::Buffer* dual_scattering = nullptr;  ///< DualTerms of its glsl; null: not asked for
  glm::dvec3 fibre_alpha{0.4};                   ///< opacity of one crossing per channel, as shadows have it
  const bsdf::Model* model = nullptr;            ///< the material's, with its parameters
  const registry::ParameterValues* model_values = nullptr;
  bool evaluates_directly = false;                    ///< strands are shaded by the model's formulas, not by tables
  const strands::Groom* rest = nullptr;               ///< drawn strands at rest, where a pass makes something of them
  const gpu::Buffer* strand_colors = nullptr;         ///< per vertex four halves: radiance, 1 where the strand is kept
  const gpu::Buffer* shaded_vertices = nullptr;       ///< uint: how many vertices were shaded, then which; by points
  const tile_lists::TileLists* tile_lists = nullptr;  ///< which segments each tile of the screen has to draw
  std::optional<StrandDraw> strand_draw;              ///< of the pass that draws strands as triangles or lines
  const cull_strands::SeenStrands* seen_strands = nullptr;  ///< which of them it draws; null: all
  bool says_seen = false;                                   ///< whether passes that draw strands fill `seen`
  const gpu::Buffer* seen = nullptr;                        ///< Seen per pixel of the picture
  const gpu::Texture* seen_samples = nullptr;  ///< r32u, as large as the targets: per sample the segment, from 1
  const gpu::Buffer* aovs = nullptr;           ///< floats per pixel: aovs::k_channels
  const gpu::Buffer* pixel_depth = nullptr;    ///< float per pixel: 1 / distance of the nearest thing; 0: none
  std::uint32_t vertices_per_strand = 0;       ///< of the drawn strands, all alike
  double strand_radius = 35e-6;                ///< of a drawn strand, metres, at the root
  const strands::Mesh* head = nullptr;         ///< rest pose
  const strands::Mesh* scalp = nullptr;        ///< the part of the head where hair grows, rest pose; may be null
  glm::dmat4 head_transform{1};
  std::optional<PosedCharacter> character;         ///< that the picture moves; none where the simulation has
  strands::DrawnStrands* drawn_strands = nullptr;  ///< what makes `strands` of the control hairs
  strands::StrandGenerator* generator = nullptr;   ///< the same, where strands are interpolated
  const gpu::Buffer* control_positions = nullptr;  ///< vec4 per control vertex
  strands::ControlMotion control_motion;           ///< of these; without values where nothing asks how hair moves
  double frame_duration = 0;                       ///< seconds
  const gpu::Buffer* velocities = nullptr;         ///< vec4 per drawn vertex, m/s; null where nothing asks
  std::uint32_t control_vertices = 0;
  Camera camera_before;                          ///< of the frame before; the frame's own in the first
  std::uint32_t frames_since_cut = 1;            ///< frames that follow each other, this one with them
  const gpu::Buffer* seen_velocities = nullptr;  ///< of what a pixel sees, m/s: three floats; null where nothing asks
  const gpu::Buffer* motion_vectors = nullptr;   ///< vec2 per pixel: pixels since the frame before
  /// A head that deforms: its vertices of this frame, vec4 each (position, 1 where hair grows; unit normal); else null.
  const gpu::Buffer *head_positions = nullptr, *head_normals = nullptr;
  std::optional<Floor> floor;
  /// Fins: their mesh at rest, and its vertices of this frame, vec4 each (world place, painted weight; unit normal).
  const strands::Mesh* fins = nullptr;
  const gpu::Buffer *fin_positions = nullptr, *fin_normals = nullptr;
  const gpu::Texture *color = nullptr,
                     *depth = nullptr;     ///< targets, at supersampled size, samples as the device offers
  const gpu::Texture* resolved = nullptr;  ///< single-sample, supersampled size
  const gpu::Texture* output = nullptr;    ///< rgba32f or rgba16f, output size
  int supersampling = 2;
  bool keep_target = false;    ///< the targets hold what an earlier pass of this frame drew
  bool resolve_target = true;  ///< this pass is the last to draw: its multisampled colour goes to `resolved`
  PassParameters parameters;
};

/// The parameters of a pass in this frame.
template <class Parameters>
Parameters parameters_of(const FrameResources& resources) {
  return parameters_of<Parameters>(resources.parameters);
}
/// Pixels of what is drawn at once: a chunk, else the picture.
glm::ivec2 drawn_size(const FrameResources& resources);
/// World to clip space of what is drawn at once.
glm::dmat4 drawn_world_to_clip(const FrameResources& resources);
/// A pipeline that draws into the frame's targets, nearest wins; shaders and interface are still to be set.
gpu::GraphicsDescription target_description(const FrameResources& resources);
/// The colour target of a rendering, as `keep_target` and `resolve_target` say.
gpu::Commands::Target color_target(const FrameResources& resources);
/// A visibility buffer for a target: per sample the segment that it sees, from 1.
Result<gpu::Texture> make_visibility(gpu::Device& device, const gpu::Texture& target);

/// The buffer that a pass fills where `says_seen`; else one that takes its place.
Result<gpu::Buffer> make_seen(gpu::Device& device, const FrameResources& resources);
/// The constants of channels.glsl, behind those that a shader has before them.
std::vector<std::uint32_t> with_channels(std::vector<std::uint32_t> before, const shadows::Channels& channels);
/// Begins rendering into the frame's targets, as `keep_target` and `resolve_target` say.
void begin_target(gpu::Commands& commands, const FrameResources& resources);

/// What a pass says of the submission that it was recorded into.
struct Settled {
  bool holds = true;                    ///< false: its buffers were too small and have grown; the frame is drawn again
  std::vector<std::string> notes = {};  ///< what was left out of the picture, one sentence each
};

/// The runner opens the pass of the entry's name around `record`.
class GpuPass {
 public:
  virtual ~GpuPass() = default;
  /// Adds what other passes read and this one owns; called once, before the later ones are made.
  virtual void publish(FrameResources&) const {}
  virtual Result<Settled> settle() { return Settled{}; }
  virtual Result<void> record(gpu::Commands& commands, const FrameResources& resources) = 0;
};
struct GpuPassEntry {
  std::string_view name;
  /// Makes pipelines for the targets, tables, head and parameters named in `resources`; these stay alive and unchanged.
  Result<std::unique_ptr<GpuPass>> (*create)(std::shared_ptr<gpu::Device>, const FrameResources& resources);
};
std::span<const GpuPassEntry* const> gpu_passes();

}  // namespace cuticle::render
