#pragma once
// BVH motion: joints with channels, frames; world transforms at any time.
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/result.h"

namespace cuticle::strands {

struct Joint {
  std::string name;
  int parent = -1;
  glm::dvec3 offset{0};             ///< file units
  std::vector<int> channels;        ///< 0..2 position xyz, 3..5 rotation xyz, in file order
  int first_channel = 0;
};
struct Motion {
  std::vector<Joint> joints;
  double frame_time = 1.0 / 30;     ///< seconds
  std::size_t frame_count = 0;
  std::vector<float> values;        ///< frame_count x channel_count
  std::size_t channel_count = 0;
  double duration() const { return frame_count > 1 ? frame_time * double(frame_count - 1) : 0; }
};
/// Error: bad_input naming file, line and what was expected.
Result<Motion> read_bvh(const std::string& path);
Result<Motion> parse_bvh(std::string_view text, const std::string& where);
/// Index of a joint by name (case-insensitive, then by suffix: "mixamorig:Head" matches "Head"). Error lists the joints.
Result<int> find_joint(const Motion& motion, std::string_view name);
/// World transform of a joint, interpolated between frames (rotations spherically), clamped to the clip.
glm::dmat4 joint_transform(const Motion& motion, int joint, double time);

}  // namespace cuticle::strands
