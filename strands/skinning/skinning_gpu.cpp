#include "strands/skinning/skinning_gpu.h"

#include "gpu/groups.h"

#include <skin_comp.spv.h>

namespace cuticle::strands {

namespace {

constexpr std::size_t k_written_bytes = 65536;  // at most, in one write of recorded commands

struct SkinConstants {
  std::uint32_t count, dual;
};

std::vector<glm::vec4> tagged(std::span<const glm::vec3> points, std::span<const float> tags) {
  std::vector<glm::vec4> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.emplace_back(points[i], tags.empty() ? 0.0f : tags[i]);
  return result;
}

}  // namespace

Result<GpuSkin> GpuSkin::create(gpu::Device& device, const Mesh& bind, std::span<const Influences> influences,
                                std::size_t joint_count, std::span<const float> tags) {
  const std::size_t count = bind.positions.size();
  CUTICLE_EXPECT(influences.size() == count && bind.normals.size() == count, "influences and a normal for each vertex");
  CUTICLE_EXPECT(tags.empty() || tags.size() == count, "one tag for each vertex");
  if (count == 0) return bad_input("growth mesh: no vertices, at least 1 is needed");
  std::vector<std::array<std::uint32_t, 4>> joints;
  std::vector<glm::vec4> weights;
  for (const Influences& vertex : influences) joints.push_back(vertex.joints), weights.push_back(vertex.weights);
  GpuSkin skin;
  skin.count_ = std::uint32_t(count);
  skin.joint_count_ = joint_count;
  CUTICLE_ASSIGN(skin.positions_, gpu::make_buffer_from<glm::vec4>(device, tagged(bind.positions, tags)));
  CUTICLE_ASSIGN(skin.normals_, gpu::make_buffer_from<glm::vec4>(device, tagged(bind.normals, {})));
  CUTICLE_ASSIGN(skin.joints_, (gpu::make_buffer_from<std::array<std::uint32_t, 4>>(device, joints)));
  CUTICLE_ASSIGN(skin.weights_, gpu::make_buffer_from<glm::vec4>(device, weights));
  CUTICLE_ASSIGN(skin.motions_, device.make_buffer(std::max<std::size_t>(1, joint_count) * sizeof(JointMotion)));
  CUTICLE_ASSIGN(skin.moved_positions_, device.make_buffer(count * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(skin.moved_normals_, device.make_buffer(count * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(skin.kernel_,
                 device.make_kernel(skin_comp, {.storage_buffers = 7, .push_constant_bytes = sizeof(SkinConstants)}));
  return skin;
}

Result<void> GpuSkin::record(gpu::Commands& commands, std::span<const JointMotion> motions, Skinning method) {
  CUTICLE_EXPECT(motions.size() == joint_count_, "one motion for each joint");
  const std::span<const std::byte> bytes = std::as_bytes(motions);
  for (std::size_t at = 0; at < bytes.size(); at += k_written_bytes)
    commands.write(motions_, bytes.subspan(at, std::min(k_written_bytes, bytes.size() - at)), at);
  const SkinConstants constants{count_, method == Skinning::dual_quaternion ? 1u : 0u};
  const gpu::Groups groups = gpu::groups_for(count_);
  commands.begin_pass("skin");
  commands.dispatch(kernel_,
                    {&positions_, &normals_, &joints_, &weights_, &motions_, &moved_positions_, &moved_normals_}, {},
                    gpu::bytes_of(constants), groups.x, groups.y);
  commands.end_pass();
  return {};
}

}  // namespace cuticle::strands
