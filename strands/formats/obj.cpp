// Wavefront OBJ: positions, normals, texture coordinates and faces (fans of triangles). Everything else is skipped.
#include "strands/formats/formats.h"

#include <array>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "core/file.h"
#include "strands/formats/words.h"

namespace cuticle::strands {

namespace {

/// position / texture coordinate / normal of a face corner, 0-based; -1 where the corner has none.
using Corner = std::array<std::int64_t, 3>;

class ObjParser {
 public:
  explicit ObjParser(const std::string& where) : where_(where) {}

  Result<Mesh> parse(std::string_view text) {
    while (!text.empty()) {
      ++line_number_;
      CUTICLE_TRY(parse_line(next_line(text)));
    }
    return finish();
  }

 private:
  Error error(const std::string& field, const std::string& problem) const {
    return line_error(where_, line_number_, field + ": " + problem);
  }

  Result<void> parse_line(std::string_view line) {
    const std::string_view keyword = next_word(line);
    if (keyword == "v") return read_vector(line, "v", positions_);
    if (keyword == "vn") return read_vector(line, "vn", normals_);
    if (keyword == "vt") return read_vector(line, "vt", uv_);
    if (keyword == "f") return read_face(line);
    return {};
  }

  template <class Vector>
  Result<void> read_vector(std::string_view line, const char* field, std::vector<Vector>& out) {
    Vector value(0);
    for (int i = 0; i < Vector::length(); ++i) {
      const std::string_view word = next_word(line);
      if (!parse_whole(word, value[i]) || !std::isfinite(value[i]))
        return error(field, fmt::format("'{}' is not a finite number", word.substr(0, 40)));
    }
    out.push_back(value);
    return {};
  }

  Result<void> read_face(std::string_view line) {
    std::vector<std::uint32_t> corners;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      CUTICLE_ASSIGN(const std::uint32_t vertex, read_corner(word));
      corners.push_back(vertex);
    }
    if (corners.size() < 3) return error("f", fmt::format("{} corners, at least 3 are needed", corners.size()));
    for (std::size_t i = 2; i < corners.size(); ++i)
      mesh_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    return {};
  }

  /// "7", "7/3", "7//2", "7/3/2"; negative numbers count from the end.
  Result<std::uint32_t> read_corner(std::string_view word) {
    const std::size_t sizes[3] = {positions_.size(), uv_.size(), normals_.size()};
    Corner corner{-1, -1, -1};
    std::string_view rest = word;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view number = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (number.empty() && part > 0) continue;
      CUTICLE_ASSIGN(corner[part], read_index(number, sizes[part]));
    }
    if (!rest.empty()) return error("f", fmt::format("'{}' has more than three parts", word.substr(0, 40)));
    return vertex_of(corner);
  }

  Result<std::int64_t> read_index(std::string_view text, std::size_t size) {
    std::int64_t index = 0;
    const auto count = std::int64_t(size);
    if (count == 0)
      return error("f", fmt::format("index '{}' of a list with no items before this line", text.substr(0, 40)));
    if (!parse_whole(text, index) || index == 0 || index > count || index < -count)
      return error("f", fmt::format("index '{}', allowed 1 .. {} or -{} .. -1", text.substr(0, 40), count, count));
    return index > 0 ? index - 1 : count + index;
  }

  /// A vertex of the mesh for each distinct corner.
  std::uint32_t vertex_of(const Corner& corner) {
    const auto [found, is_new] = vertices_.try_emplace(corner, std::uint32_t(mesh_.positions.size()));
    if (!is_new) return found->second;
    mesh_.positions.push_back(positions_[std::size_t(corner[0])]);
    has_all_uv_ = has_all_uv_ && corner[1] >= 0;
    has_all_normals_ = has_all_normals_ && corner[2] >= 0;
    mesh_.uv.push_back(corner[1] >= 0 ? uv_[std::size_t(corner[1])] : glm::vec2(0));
    mesh_.normals.push_back(corner[2] >= 0 ? normals_[std::size_t(corner[2])] : glm::vec3(0, 1, 0));
    return found->second;
  }

  Result<Mesh> finish() {
    if (mesh_.triangles.empty())
      return bad_input(
          fmt::format("{}: no faces: {} vertices, but at least one triangle is needed", where_, positions_.size()));
    if (!has_all_uv_) mesh_.uv.clear();
    if (!has_all_normals_) compute_normals(mesh_);
    for (glm::vec3& normal : mesh_.normals) normal = unit_or_up(normal);
    return std::move(mesh_);
  }

  std::string where_;
  std::size_t line_number_ = 0;
  std::vector<glm::vec3> positions_, normals_;
  std::vector<glm::vec2> uv_;
  std::map<Corner, std::uint32_t> vertices_;
  bool has_all_uv_ = true, has_all_normals_ = true;
  Mesh mesh_;
};

}  // namespace

Result<Mesh> parse_obj(std::string_view text, const std::string& where) { return ObjParser(where).parse(text); }

Result<Mesh> read_obj(const std::string& path, double metres_per_unit) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  CUTICLE_ASSIGN(Mesh mesh, parse_obj(text, path));
  for (glm::vec3& position : mesh.positions) position = glm::vec3(glm::dvec3(position) * metres_per_unit);
  return mesh;
}

}  // namespace cuticle::strands
