#pragma once
// A skinned, animated character as a growth mesh: glTF 2.0 (.glb, .gltf) in metres, y up, facing +z.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include "core/result.h"
#include "strands/character/convention.h"
#include "strands/skinning/skinning.h"

namespace cuticle::strands {

/// A node of the scene graph, relative to its parent, at rest.
struct Node {
  std::string name;
  int parent = -1;
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};
};

enum class Interpolation { step, linear, cubic_spline };
enum class TrackTarget { translation, rotation, scale };
/// What one property of one node does in a clip. Values per key: 3, or 4 (x, y, z, w) for rotations; a cubic spline has
/// three times as many: in-tangent, value, out-tangent.
struct Track {
  int node = 0;
  TrackTarget target = TrackTarget::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times = {};  ///< seconds, not falling; at least 1
  std::vector<float> values = {};
  std::size_t components() const { return target == TrackTarget::rotation ? 4 : 3; }
};
struct Clip {
  std::string name;
  double duration = 0;  ///< seconds: the last key of all tracks
  std::vector<Track> tracks = {};
};

/// What was found amiss, and what the stated rules (README.md) did about it.
struct CharacterReport {
  std::size_t file_vertices = 0;         ///< before vertices at one place were made one
  std::size_t welded_conflicts = 0;      ///< vertices at one place, but of other weights than the one that was kept
  std::size_t degenerate_triangles = 0;  ///< without area: left out
  std::size_t reduced_vertices = 0;      ///< with more than 4 influences: the greatest 4 were kept
  double largest_weight_dropped = 0;     ///< of those
  std::size_t unweighted_vertices = 0;   ///< without a usable weight: they follow the skin's first joint
  std::size_t missing_joints = 0;        ///< influences that name a joint that the skin lacks: dropped
  std::size_t bad_weights = 0;           ///< influences with a negative or not finite weight: dropped
  std::size_t skipped_tracks = 0;        ///< morph targets and the like: not sampled
  std::vector<std::string> notes;        ///< what was guessed or left out, one sentence each
};

struct Character {
  Mesh mesh;                             ///< bind pose; one vertex per place, smooth normals, triangles with area only
  std::vector<Influences> influences;    ///< one per vertex
  std::vector<Node> nodes;               ///< in file units and axes
  std::vector<int> order;                ///< all nodes, parents before children
  std::vector<int> joints;               ///< node of each joint
  std::vector<glm::dmat4> inverse_bind;  ///< one per joint, file units
  glm::dmat4 to_metres{1};               ///< file units and axes -> metres, y up, facing +z
  double metres_per_unit = 1;
  std::vector<Clip> clips;
  CharacterReport report;
};

/// Error: bad_input naming file, part and what was expected.
Result<Character> read_character(const std::string& path, const Convention& convention = {});
/// .glb or .gltf from bytes (fuzzed); other files are not opened.
Result<Character> parse_gltf(std::span<const std::byte> bytes, const std::string& where,
                             const Convention& convention = {});

/// Index of a clip by name (case-insensitive). Error: bad_input listing the clips.
Result<int> find_clip(const Character& character, std::string_view name);

/// World transforms of all nodes, file units, at a time (seconds, clamped to each track's keys) of a clip; clip -1: at
/// rest. Rotations are interpolated spherically, the short way; cubic splines as glTF 2.0, appendix C.
std::vector<glm::dmat4> node_transforms(const Character& character, int clip, double time);

/// Bind pose -> pose, in metres, one per joint: what joint_motions() takes.
std::vector<glm::dmat4> joint_matrices(const Character& character, int clip, double time);

/// `time` in a clip that repeats, seconds in [0, duration); 0 for a clip without duration.
double looped(const Clip& clip, double time);

}  // namespace cuticle::strands
