#include "strands/gltf/glb.h"

#include <limits>

#include <glm/common.hpp>

#include "strands/formats/bytes.h"

namespace cuticle::strands {

namespace {

// Numbers that glTF names things by.
constexpr int k_float = 5126, k_uint = 5125, k_vertices = 34962, k_indices = 34963, k_clamp = 33071, k_linear = 9729,
              k_linear_mipmap_linear = 9987;
constexpr std::uint32_t k_magic = 0x46546c67, k_json_chunk = 0x4e4f534a, k_binary_chunk = 0x004e4942;

void pad(std::vector<std::byte>& bytes, char with) {
  while (bytes.size() % 4 != 0) bytes.push_back(std::byte(with));
}

void append_chunk(std::vector<std::byte>& file, std::uint32_t kind, std::span<const std::byte> bytes) {
  append(file, std::uint32_t(bytes.size()));
  append(file, kind);
  append_all(file, bytes);
}

Json list_of(const glm::vec3& v) { return Json::list({v.x, v.y, v.z}); }

}  // namespace

std::size_t GlbWriter::add_view(std::span<const std::byte> bytes, int target) {
  pad(buffer_, '\0');
  Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  append_all(buffer_, bytes);
  views_.push_back(view);
  return views_.size() - 1;
}

std::size_t GlbWriter::add_accessor(std::span<const std::byte> bytes, std::size_t count, const char* type,
                                    int component, int target) {
  const std::size_t view = add_view(bytes, target);
  accessors_.push_back({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return accessors_.size() - 1;
}

std::size_t GlbWriter::add_positions(std::span<const glm::vec3> values) {
  glm::vec3 lower(std::numeric_limits<float>::max()), upper(-std::numeric_limits<float>::max());
  for (const glm::vec3& value : values) {
    lower = glm::min(lower, value);
    upper = glm::max(upper, value);
  }
  const std::size_t accessor = add(values);
  accessors_[accessor]["min"] = list_of(lower);
  accessors_[accessor]["max"] = list_of(upper);
  return accessor;
}

std::size_t GlbWriter::add(std::span<const float> values) {
  return add_accessor(std::as_bytes(values), values.size(), "SCALAR", k_float, k_vertices);
}
std::size_t GlbWriter::add(std::span<const glm::vec2> values) {
  return add_accessor(std::as_bytes(values), values.size(), "VEC2", k_float, k_vertices);
}
std::size_t GlbWriter::add(std::span<const glm::vec3> values) {
  return add_accessor(std::as_bytes(values), values.size(), "VEC3", k_float, k_vertices);
}
std::size_t GlbWriter::add(std::span<const glm::vec4> values) {
  return add_accessor(std::as_bytes(values), values.size(), "VEC4", k_float, k_vertices);
}
std::size_t GlbWriter::add_indices(std::span<const std::uint32_t> values) {
  return add_accessor(std::as_bytes(values), values.size(), "SCALAR", k_uint, k_indices);
}

std::size_t GlbWriter::add_png(std::span<const std::byte> bytes) {
  images_.push_back({{"bufferView", add_view(bytes, 0)}, {"mimeType", "image/png"}});
  return images_.size() - 1;
}

Result<std::vector<std::byte>> GlbWriter::file(const std::string& name, const Json& primitive, const Json& material,
                                               double scale) const {
  Json node{{"mesh", 0}, {"name", name}};
  if (scale != 1) node["scale"] = Json::list({scale, scale, scale});
  Json root{{"asset", {{"version", "2.0"}, {"generator", "cuticle " CUTICLE_VERSION}}},
            {"scene", 0},
            {"scenes", Json::list({{{"nodes", Json::list({0})}}})},
            {"nodes", Json::list({node})},
            {"meshes", Json::list({{{"name", name}, {"primitives", Json::list({primitive})}}})},
            {"materials", Json::list({material})},
            {"accessors", accessors_},
            {"bufferViews", views_},
            {"buffers", Json::list({{{"byteLength", buffer_.size()}}})}};
  if (!extensions.empty()) root["extensionsUsed"] = Json(extensions);
  if (images_.size() > 0) {
    root["images"] = images_;
    root["samplers"] = Json::list(
        {{{"magFilter", k_linear}, {"minFilter", k_linear_mipmap_linear}, {"wrapS", k_clamp}, {"wrapT", k_clamp}}});
    root["textures"] = Json::list();
    for (std::size_t i = 0; i < images_.size(); ++i) root["textures"].push_back({{"sampler", 0}, {"source", i}});
  }
  std::vector<std::byte> text = to_bytes(root.dump()), binary = buffer_;
  pad(text, ' ');
  pad(binary, '\0');
  const std::uint64_t size = 12 + 8 + text.size() + 8 + binary.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    return bad_input("a .glb holds at most 4 GiB", "write .usdc, or fewer strands");
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  append(bytes, k_magic);
  append(bytes, std::uint32_t(2));
  append(bytes, std::uint32_t(size));
  append_chunk(bytes, k_json_chunk, text);
  append_chunk(bytes, k_binary_chunk, binary);
  return bytes;
}

}  // namespace cuticle::strands
