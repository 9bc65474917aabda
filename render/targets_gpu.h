#pragma once
// What a frame is drawn into, and what each pixel of it sees.
#include <optional>
#include <vector>

#include "gpu/device.h"
#include "render/frame.h"
#include "render/inputs.h"
#include "render/resources_gpu.h"
#include "shadows/channels.h"

namespace cuticle::render {

/// Colour and depth, as passes that draw leave them.
struct Targets {
  const gpu::Texture *color = nullptr,
                     *depth = nullptr;     ///< at supersampled size, samples as the device offers
  const gpu::Texture* resolved = nullptr;  ///< single-sample, supersampled size
  int supersampling = 2;
  bool keep = false;     ///< they hold what an earlier pass of this frame drew
  bool resolves = true;  ///< this pass is the last to draw: its multisampled colour goes to `resolved`
};

/// The picture.
struct Output {
  const gpu::Texture* picture = nullptr;  ///< rgba32f or rgba16f
};

/// What a pixel sees of the hair, as seen.glsl has it.
struct Seen {
  std::uint32_t first, last;
  float coverage;
  std::uint32_t samples, cost;
};

/// What the pass that draws strands saw: one of the two.
struct SeenHair {
  const gpu::Buffer* pixels = nullptr;    ///< Seen per pixel of the picture
  const gpu::Texture* samples = nullptr;  ///< r32u, as large as the targets: per sample the segment, from 1
};

/// Pixels of what is drawn at once: a chunk, else the picture.
glm::ivec2 drawn_size(const Resources& resources);
/// World to clip space of what is drawn at once.
glm::dmat4 drawn_world_to_clip(const Resources& resources);
/// A pipeline that draws into the frame's targets, nearest wins; shaders and interface are still to be set.
gpu::GraphicsDescription target_description(const Resources& resources);
/// The colour target of a rendering, as `keep` and `resolves` say.
gpu::Commands::Target color_target(const Resources& resources);
/// Begins rendering into the frame's targets, as `keep` and `resolves` say.
void begin_target(gpu::Commands& commands, const Resources& resources);
/// A visibility buffer for a target: per sample the segment that it sees, from 1.
Result<gpu::Texture> make_visibility(gpu::Device& device, const gpu::Texture& target);
/// The buffer that a pass fills where SeenHair is wanted; else one that takes its place.
Result<gpu::Buffer> make_seen(gpu::Device& device, const Resources& resources);
/// The constants of channels.glsl, behind those that a shader has before them.
std::vector<std::uint32_t> with_channels(std::vector<std::uint32_t> before, const shadows::Channels& channels);

}  // namespace cuticle::render
