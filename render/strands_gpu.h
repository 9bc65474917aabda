#pragma once
// Hair on its way to the picture: control hairs, drawn strands, and the light that reaches these.
#include <span>
#include <vector>

#include "render/frame.h"
#include "render/resources_gpu.h"
#include "shadows/channels.h"
#include "shadows/method_gpu.h"
#include "strands/binding/carry_gpu.h"
#include "strands/skinning/skinning_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace cuticle::render {

/// A character's skin, and the hair on it, to be posed for the frame; not there where the simulation has.
struct PosedCharacter {
  strands::GpuSkin* skin;
  strands::GpuCarry* hair;
  std::span<const strands::JointMotion> motions;
  strands::Skinning method;
};

/// Vertices of a mesh in this frame, vec4 each.
struct MeshVertices {
  const gpu::Buffer *positions = nullptr, *normals = nullptr;
};
/// Of a head that deforms: position, 1 where hair grows; unit normal.
struct HeadVertices : MeshVertices {};
/// Of fins: world place, painted weight; unit normal.
struct FinVertices : MeshVertices {};

struct ControlHairs {
  const gpu::Buffer* positions = nullptr;  ///< vec4 per control vertex
  strands::ControlMotion motion;           ///< of these; without values where nothing asks how hair moves
  std::uint32_t vertex_count = 0;
};

/// What makes drawn strands of the control hairs.
struct StrandMaker {
  strands::DrawnStrands* strands = nullptr;
  strands::StrandGenerator* generator = nullptr;  ///< the same, where strands are interpolated
};

/// Control hairs with curves through them.
struct SmoothedHairs {};

struct DrawnHair {
  shadows::GpuStrands strands;            ///< vec4 (position, radius) per vertex
  shadows::GpuStrands casters = {};       ///< those of them that cast shadows
  const gpu::Buffer* tangents = nullptr;  ///< vec4 (unit tangent, fraction of the strand's length) per vertex
  std::uint32_t vertices_per_strand = 0;  ///< all alike
  std::uint32_t segment_parts = 1;        ///< so many segments after each other lie on one line
  double radius = 35e-6;                  ///< of a strand, metres, at the root
};

struct DrawnVelocities {
  const gpu::Buffer* values = nullptr;  ///< vec4 per drawn vertex, m/s
};

/// What reaches the vertices of drawn strands.
struct HairTransmittance {
  shadows::Channels channels = {};               ///< whose transmittance differs
  std::vector<const gpu::Buffer*> reached = {};  ///< per light, for each of `channels.alpha`: one float per vertex
  bool of_surfaces_alone = false;                ///< `reached` is no shadow method's
};
/// Where nothing shadows hair: one channel that nothing reaches.
const HairTransmittance& transmittance_of(const Resources& resources);

}  // namespace cuticle::render
