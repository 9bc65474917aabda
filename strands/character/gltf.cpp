// glTF 2.0 by tinygltf, which is private to this file: nodes, skins, clips and triangles. Images and materials are not
// read.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <numeric>

#include <fmt/core.h>
#include <tiny_gltf.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "core/file.h"
#include "strands/character/assemble.h"
#include "strands/character/elements.h"
#include "strands/character/gltf_text.h"

namespace cuticle::strands {

namespace {

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const std::string& where) : model_(model), where_(where) {}

  Result<Character> read(const Convention& convention) {
    CUTICLE_ASSIGN(const glm::dmat4 turn, axes_to_ours(convention));
    CUTICLE_TRY(read_nodes());
    CUTICLE_TRY(read_skins());
    rest_ = node_transforms(character_, -1, 0);
    for (std::size_t node = 0; node < model_.nodes.size(); ++node)
      if (model_.nodes[node].mesh >= 0) CUTICLE_TRY(read_mesh(node));
    weld(vertices_, triangles_, character_);
    if (character_.mesh.triangles.empty()) return error("meshes", "no triangle with area, at least 1 is needed");
    for (std::size_t k = 0; k < model_.animations.size(); ++k) CUTICLE_TRY(read_clip(k));
    scale_to_metres(character_, convention, turn);
    return std::move(character_);
  }

 private:
  Error error(const std::string& part, const std::string& problem) const {
    return bad_input(fmt::format("{}: {}: {}", where_, part, problem));
  }

  template <class Index>
  static bool holds(const std::vector<Index>& list, int index) {
    return index >= 0 && std::size_t(index) < list.size();
  }

  Result<Elements> elements(int index, int components, const std::string& part) const {
    if (!holds(model_.accessors, index))
      return error(part, fmt::format("accessor {} of {}", index, model_.accessors.size()));
    const tinygltf::Accessor& accessor = model_.accessors[std::size_t(index)];
    const std::string name = fmt::format("{}: accessor {}", part, index);
    if (accessor.sparse.isSparse) return error(name, "sparse accessors are not read");
    if (tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)) != components)
      return error(name, fmt::format("{} components per element expected", components));
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE ||
        accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT)
      return error(name, fmt::format("component type {} is none of glTF's", accessor.componentType));
    if (!holds(model_.bufferViews, accessor.bufferView))
      return error(name, "has no buffer view (compressed meshes are not read)");
    return elements_in(accessor, components, name);
  }

  Result<Elements> elements_in(const tinygltf::Accessor& accessor, int components, const std::string& name) const {
    const tinygltf::BufferView& view = model_.bufferViews[std::size_t(accessor.bufferView)];
    if (!holds(model_.buffers, view.buffer)) return error(name, "its buffer is missing");
    const std::size_t available = model_.buffers[std::size_t(view.buffer)].data.size();
    const int part_size = tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType));
    if (part_size <= 0) return error(name, fmt::format("unknown component type {}", accessor.componentType));
    const std::size_t size = std::size_t(part_size) * std::size_t(components);
    const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
    const bool fits = view.byteOffset <= available && view.byteLength <= available - view.byteOffset &&
                      accessor.byteOffset <= view.byteLength && stride >= size;
    const std::size_t room = fits ? view.byteLength - accessor.byteOffset : 0;
    const std::size_t most = room < size ? 0 : (room - size) / stride + 1;
    if (accessor.count == 0 || accessor.count > most)
      return error(name,
                   fmt::format("{} elements, but its bytes hold {} (at least 1 is needed)", accessor.count, most));
    return Elements{model_.buffers[std::size_t(view.buffer)].data.data() + view.byteOffset + accessor.byteOffset,
                    stride, accessor.count, accessor.componentType, accessor.normalized};
  }

  Result<void> read_nodes() {
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      CUTICLE_ASSIGN(Node node, read_node(model_.nodes[i], fmt::format("nodes[{}]", i)));
      character_.nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      for (int child : model_.nodes[i].children) {
        if (!holds(character_.nodes, child) || character_.nodes[std::size_t(child)].parent >= 0)
          return error(fmt::format("nodes[{}].children", i), fmt::format("{} is no node, or has two parents", child));
        character_.nodes[std::size_t(child)].parent = int(i);
      }
    return order_nodes(character_, where_);
  }

  Result<Node> read_node(const tinygltf::Node& from, const std::string& part) const {
    Node node{.name = from.name};
    const auto take = [](const std::vector<double>& values, auto& to) {
      for (int k = 0; k < int(values.size()); ++k) to[k] = values[std::size_t(k)];
    };
    if (from.translation.size() == 3) take(from.translation, node.translation);
    if (from.scale.size() == 3) take(from.scale, node.scale);
    if (from.rotation.size() == 4)
      node.rotation = glm::dquat(from.rotation[3], from.rotation[0], from.rotation[1], from.rotation[2]);
    if (from.matrix.size() == 16) set_matrix(glm::make_mat4(from.matrix.data()), node);
    const double sum = glm::dot(node.translation, glm::dvec3(1)) + glm::dot(node.scale, glm::dvec3(1)) +
                       glm::dot(node.rotation, node.rotation);
    if (!std::isfinite(sum)) return error(part, "its transform is not finite");
    if (glm::dot(node.rotation, node.rotation) == 0) return error(part, "its rotation is zero");
    node.rotation = glm::normalize(node.rotation);
    return node;
  }

  Result<void> read_skins() {
    for (std::size_t s = 0; s < model_.skins.size(); ++s) {
      const tinygltf::Skin& skin = model_.skins[s];
      const std::string part = fmt::format("skins[{}]", s);
      first_joints_.push_back(character_.joints.size());
      if (skin.joints.empty()) return error(part, "no joints, at least 1 is needed");
      for (int node : skin.joints) {
        if (!holds(character_.nodes, node))
          return error(part, fmt::format("joint node {} of {}", node, character_.nodes.size()));
        character_.joints.push_back(node);
      }
      CUTICLE_TRY(read_inverse_bind(skin, part));
    }
    return {};
  }

  Result<void> read_inverse_bind(const tinygltf::Skin& skin, const std::string& part) {
    if (skin.inverseBindMatrices < 0) {
      character_.inverse_bind.resize(character_.joints.size(), glm::dmat4(1));
      return {};
    }
    CUTICLE_ASSIGN(const Elements matrices, elements(skin.inverseBindMatrices, 16, part + ".inverseBindMatrices"));
    if (matrices.count < skin.joints.size())
      return error(part, fmt::format("{} inverse bind matrices for {} joints", matrices.count, skin.joints.size()));
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      glm::dmat4 matrix;
      for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = matrices.number(j, k);
      for (int k = 0; k < 16; ++k)
        if (!std::isfinite(matrix[k / 4][k % 4]))
          return error(part, fmt::format("inverse bind matrix {} is not finite", j));
      character_.inverse_bind.push_back(matrix);
    }
    return {};
  }

  /// The joints that a mesh's vertices name: those of its skin, or the node that carries it.
  struct Joints {
    std::size_t first = 0, count = 0;
    bool is_skin = false;
    glm::dmat4 place{1};  ///< of the vertices, into the bind pose
  };
  Result<Joints> joints_of(std::size_t node) {
    const int skin = model_.nodes[node].skin;
    if (holds(model_.skins, skin))
      return Joints{first_joints_[std::size_t(skin)], model_.skins[std::size_t(skin)].joints.size(), true,
                    glm::dmat4(1)};
    const Joints joints{character_.joints.size(), 1, false, rest_[node]};
    if (glm::determinant(rest_[node]) == 0)
      return error(fmt::format("nodes[{}]", node), "its transform flattens its mesh");
    character_.joints.push_back(int(node));
    character_.inverse_bind.push_back(glm::inverse(rest_[node]));
    return joints;
  }

  Result<void> read_mesh(std::size_t node) {
    const int index = model_.nodes[node].mesh;
    if (!holds(model_.meshes, index))
      return error(fmt::format("nodes[{}]", node), fmt::format("mesh {} is not there", index));
    CUTICLE_ASSIGN(const Joints joints, joints_of(node));
    const auto& primitives = model_.meshes[std::size_t(index)].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p)
      CUTICLE_TRY(read_primitive(primitives[p], joints, fmt::format("meshes[{}].primitives[{}]", index, p)));
    return {};
  }

  static int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  }

  Result<void> read_primitive(const tinygltf::Primitive& primitive, const Joints& joints, const std::string& part) {
    if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP || primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN)
      return error(part, "strips and fans are not read, give triangles");
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
      character_.report.notes.push_back(part + " holds points or lines: left out");
      return {};
    }
    if (!primitive.targets.empty()) character_.report.notes.push_back(part + " has morph targets: left at rest");
    const std::size_t first = vertices_.size();
    CUTICLE_ASSIGN(const Elements positions, elements(attribute(primitive, "POSITION"), 3, part + ".POSITION"));
    for (std::size_t v = 0; v < positions.count; ++v) {
      const glm::dvec3 place(positions.number(v, 0), positions.number(v, 1), positions.number(v, 2));
      const glm::vec3 position(joints.place * glm::dvec4(place, 1));
      if (!std::isfinite(position.x + position.y + position.z))
        return error(part, fmt::format("vertex {} is not finite", v));
      vertices_.push_back({.position = position, .first_joint = std::uint32_t(joints.first)});
    }
    CUTICLE_TRY(read_uv(primitive, first, part));
    CUTICLE_TRY(read_weights(primitive, joints, first, part));
    return read_triangles(primitive, first, part);
  }

  Result<void> read_uv(const tinygltf::Primitive& primitive, std::size_t first, const std::string& part) {
    const int index = attribute(primitive, "TEXCOORD_0");
    if (index < 0) return {};
    CUTICLE_ASSIGN(const Elements uv, elements(index, 2, part + ".TEXCOORD_0"));
    for (std::size_t v = 0; v < std::min(uv.count, vertices_.size() - first); ++v) {
      const glm::vec2 place(uv.number(v, 0), uv.number(v, 1));
      if (std::isfinite(place.x + place.y)) vertices_[first + v].uv = place;
    }
    return {};
  }

  Result<void> read_weights(const tinygltf::Primitive& primitive, const Joints& joints, std::size_t first,
                            const std::string& part) {
    if (!joints.is_skin) {
      for (std::size_t v = first; v < vertices_.size(); ++v)
        vertices_[v].influences = {{std::uint32_t(joints.first), 1}};
      return {};
    }
    for (int set = 0;; ++set) {
      const int index = attribute(primitive, fmt::format("JOINTS_{}", set).c_str());
      if (index < 0) return {};
      const std::string name = fmt::format("{}.JOINTS_{}", part, set);
      CUTICLE_ASSIGN(const Elements indices, elements(index, 4, name));
      CUTICLE_ASSIGN(const Elements weights,
                     elements(attribute(primitive, fmt::format("WEIGHTS_{}", set).c_str()), 4, name));
      const std::size_t count = std::min({indices.count, weights.count, vertices_.size() - first});
      for (std::size_t v = 0; v < count; ++v)
        for (int k = 0; k < 4; ++k) {
          const double joint = indices.number(v, k);
          const bool is_there = joint >= 0 && joint < double(joints.count);
          const std::size_t named = joints.first + (is_there ? std::size_t(joint) : 0);
          vertices_[first + v].influences.push_back({std::uint32_t(named), float(weights.number(v, k)), !is_there});
        }
    }
  }

  Result<void> read_triangles(const tinygltf::Primitive& primitive, std::size_t first, const std::string& part) {
    const std::size_t count = vertices_.size() - first;
    std::vector<std::uint32_t> indices(primitive.indices < 0 ? count : 0);
    std::iota(indices.begin(), indices.end(), std::uint32_t(first));
    if (primitive.indices >= 0) {
      CUTICLE_ASSIGN(const Elements given, elements(primitive.indices, 1, part + ".indices"));
      for (std::size_t i = 0; i < given.count; ++i) {
        const double index = given.number(i, 0);
        if (!(index >= 0 && index < double(count)))
          return error(part, fmt::format("index {} of {} vertices", index, count));
        indices.push_back(std::uint32_t(first + std::size_t(index)));
      }
    }
    if (indices.size() % 3 != 0) return error(part, fmt::format("{} corners are no whole triangles", indices.size()));
    for (std::size_t i = 0; i < indices.size(); i += 3)
      triangles_.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return {};
  }

  Result<void> read_clip(std::size_t index) {
    const tinygltf::Animation& animation = model_.animations[index];
    Clip clip{.name = animation.name.empty() ? fmt::format("clip {}", index) : animation.name};
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation.channels[c];
      const std::string part = fmt::format("animations[{}].channels[{}]", index, c);
      Track track{.node = channel.target_node};
      const bool is_known = set_target(channel.target_path, track);
      if (!is_known || channel.target_node < 0) {
        ++character_.report.skipped_tracks;
        continue;
      }
      if (!holds(character_.nodes, track.node)) return error(part, fmt::format("node {} is not there", track.node));
      if (!holds(animation.samplers, channel.sampler))
        return error(part, fmt::format("sampler {} is not there", channel.sampler));
      CUTICLE_TRY(read_keys(animation.samplers[std::size_t(channel.sampler)], part, track));
      clip.duration = std::max(clip.duration, double(track.times.back()));
      clip.tracks.push_back(std::move(track));
    }
    character_.clips.push_back(std::move(clip));
    return {};
  }

  static bool set_target(const std::string& path, Track& track) {
    if (path == "rotation") track.target = TrackTarget::rotation;
    if (path == "scale") track.target = TrackTarget::scale;
    return path == "translation" || path == "rotation" || path == "scale";
  }

  Result<void> read_keys(const tinygltf::AnimationSampler& sampler, const std::string& part, Track& track) const {
    if (sampler.interpolation == "STEP") track.interpolation = Interpolation::step;
    if (sampler.interpolation == "CUBICSPLINE") track.interpolation = Interpolation::cubic_spline;
    CUTICLE_ASSIGN(const Elements times, elements(sampler.input, 1, part));
    CUTICLE_ASSIGN(const Elements values, elements(sampler.output, int(track.components()), part));
    const std::size_t per_key = track.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (values.count != times.count * per_key)
      return error(
          part, fmt::format("{} values for {} keys, {} are needed", values.count, times.count, times.count * per_key));
    for (std::size_t i = 0; i < times.count; ++i) track.times.push_back(float(times.number(i, 0)));
    for (std::size_t i = 0; i < values.count; ++i)
      for (int k = 0; k < int(track.components()); ++k) track.values.push_back(float(values.number(i, k)));
    return check_keys(track, where_ + ": " + part);
  }

  const tinygltf::Model& model_;
  std::string where_;
  Character character_;
  std::vector<std::size_t> first_joints_;  ///< per skin
  std::vector<glm::dmat4> rest_;           ///< per node
  std::vector<FileVertex> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

/// The library also looks in the current folder: only files of the folder named are there for it, and only regular
/// ones, links followed. An empty name: none.
bool is_in_folder(const std::string& path, void* folder) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path parent = fs::canonical(*static_cast<const std::string*>(folder), failed);
  const fs::path file = failed ? fs::path() : fs::canonical(path, failed);
  if (failed || !fs::is_regular_file(file, failed)) return false;
  return std::mismatch(parent.begin(), parent.end(), file.begin(), file.end()).first == parent.end();
}
bool read_in_folder(std::vector<unsigned char>* bytes, std::string* problem, const std::string& path, void* folder) {
  if (!is_in_folder(path, folder)) return false;
  const auto read = read_file(path);
  if (!read) {
    *problem = read.error().message;
    return false;
  }
  const auto* begin = reinterpret_cast<const unsigned char*>(read->data());
  bytes->assign(begin, begin + read->size());
  return true;
}
std::string same_path(const std::string& path, void*) { return path; }

/// The file as tinygltf holds it. Buffers in other files are looked for in `folder`; empty: they are refused.
Result<tinygltf::Model> load(std::span<const std::byte> bytes, const std::string& where, const std::string& folder) {
  constexpr std::size_t most = 0xFFFFFFFF;
  if (bytes.size() < 12 || bytes.size() > most)
    return bad_input(fmt::format("{}: {} bytes; allowed: 12 .. {}", where, bytes.size(), most));
  CUTICLE_TRY(check_gltf_text(gltf_text(bytes), where));
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  loader.SetFsCallbacks(
      {is_in_folder, same_path, read_in_folder, tinygltf::WriteWholeFile, const_cast<std::string*>(&folder)});
  tinygltf::Model model;
  std::string problem, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const auto size = static_cast<unsigned>(bytes.size());
  bool loaded = false;
  try {  // the JSON reader inside throws on some malformed numbers
    loaded =
        std::memcmp(data, "glTF", 4) == 0
            ? loader.LoadBinaryFromMemory(&model, &problem, &warning, data, size, folder)
            : loader.LoadASCIIFromString(&model, &problem, &warning, reinterpret_cast<const char*>(data), size, folder);
  } catch (const std::exception& thrown) {
    problem = thrown.what();
  }
  if (loaded) return model;
  std::ranges::replace(problem, '\n', ' ');
  return bad_input(fmt::format("{}: no glTF 2.0: {}", where, problem.substr(0, 200)));
}

}  // namespace

Result<Character> parse_gltf(std::span<const std::byte> bytes, const std::string& where, const Convention& convention) {
  CUTICLE_ASSIGN(const tinygltf::Model model, load(bytes, where, ""));
  return GltfReader(model, where).read(convention);
}

Result<Character> read_character(const std::string& path, const Convention& convention) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  std::error_code code;
  const std::string folder = std::filesystem::absolute(path, code).parent_path().string();
  CUTICLE_ASSIGN(const tinygltf::Model model, load(bytes, path, folder));
  return GltfReader(model, path).read(convention);
}

}  // namespace cuticle::strands
