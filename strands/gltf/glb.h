#pragma once
// Binary glTF 2.0 (.glb): a JSON text and one buffer (Khronos, glTF 2.0 Specification, sections 3.6 and 4.4).
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/json/json.h"
#include "core/result.h"

namespace cuticle::strands {

/// Collects the arrays of a mesh in one buffer; `file` puts them under a scene of one node.
class GlbWriter {
 public:
  /// Numbers of an accessor; positions come with the bounds that glTF asks for.
  std::size_t add_positions(std::span<const glm::vec3> values);
  std::size_t add(std::span<const float> values);
  std::size_t add(std::span<const glm::vec2> values);
  std::size_t add(std::span<const glm::vec3> values);
  std::size_t add(std::span<const glm::vec4> values);
  std::size_t add_indices(std::span<const std::uint32_t> values);
  /// Number of the texture of a PNG file's bytes: clamped across and along, with mip maps.
  std::size_t add_png(std::span<const std::byte> bytes);
  /// The whole file: one mesh of one primitive, drawn with the material. `scale`: metres per unit of the positions.
  /// Error: bad_input where the file would pass 4 GiB, which its header cannot say.
  Result<std::vector<std::byte>> file(const std::string& name, const Json& primitive, const Json& material,
                                      double scale) const;
  /// Extensions that the material uses.
  std::vector<std::string> extensions;

 private:
  std::size_t add_view(std::span<const std::byte> bytes, int target);
  std::size_t add_accessor(std::span<const std::byte> bytes, std::size_t count, const char* type, int component,
                           int target);

  std::vector<std::byte> buffer_;
  Json views_ = Json::list(), accessors_ = Json::list(), images_ = Json::list();
};

}  // namespace cuticle::strands
