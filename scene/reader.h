#pragma once
// Reads keys of a checked scene file.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "core/json/json.h"
#include "scene/scene.h"

namespace cuticle::scene {

/// Keys of one object; absent keys leave the default in place.
struct Reader {
  const Json& value;
  const std::string& where;
  const std::string& folder;

  template <class T>
  void get(const char* key, T& target) const {
    if (const Json* found = value.find(key)) target = found->get<T>();
  }
  void get(const char* key, glm::dvec3& target) const {
    if (const Json* found = value.find(key))
      target = {(*found)[0].number(), (*found)[1].number(), (*found)[2].number()};
  }
  /// A number, or three.
  void get_rgb(const char* key, glm::dvec3& target) const {
    const Json* found = value.find(key);
    if (found && found->is_number())
      target = glm::dvec3(found->number());
    else
      get(key, target);
  }
  bool has(const char* key) const { return value.contains(key); }
  Reader child(const char* key) const {
    static const Json empty = Json::object();
    const Json* found = value.find(key);
    return {found ? *found : empty, where, folder};
  }
  /// A name whose leading ${VARIABLE} is replaced by the environment variable of that name.
  Result<std::string> expanded(const std::string& name, std::string_view path) const {
    const std::size_t end = name.find('}');
    if (!name.starts_with("${") || end == std::string::npos) return name;
    const std::string variable = name.substr(2, end - 2);
    if (const char* value = std::getenv(variable.c_str())) return value + name.substr(end + 1);
    return bad_input(fmt::format("{}: {}: the environment variable {} is not set", where, path, variable));
  }
  /// The absolute name of a file that exists; empty when the key is absent.
  Result<std::string> file(const char* key, std::string_view path) const {
    if (!has(key)) return std::string();
    CUTICLE_ASSIGN(const std::string given, expanded(value[key].text(), path));
    const std::filesystem::path name = std::filesystem::path(folder) / given;
    std::error_code code;
    if (std::filesystem::is_regular_file(name, code)) return name.lexically_normal().string();
    return bad_input(fmt::format("{}: {}: no file '{}'", where, path, name.lexically_normal().string()),
                     "file names are relative to the scene file");
  }
};

/// A unit vector. Error: bad_input, for zero; `path` names the object.
inline Result<glm::dvec3> direction(const Reader& reader, const char* key, const std::string& path) {
  glm::dvec3 vector{0};
  reader.get(key, vector);
  if (glm::length(vector) > 0) return glm::normalize(vector);
  return bad_input(fmt::format("{}: {}.{} is the zero vector; allowed: any direction", reader.where, path, key));
}

/// The objects of a list; none where the key is absent.
inline std::vector<Reader> items(const Reader& reader, const char* key) {
  std::vector<Reader> result;
  if (reader.has(key))
    for (const Json& item : reader.value[key]) result.push_back({item, reader.where, reader.folder});
  return result;
}

/// What hair may not enter. `reader`: of "colliders".
Result<void> read_colliders(const Reader& reader, Scene& scene);

/// The camera and its path. `reader`: of "camera".
Result<void> read_camera(const Reader& reader, Scene& scene);

/// The scene's distant lights, point lights and environment.
Result<void> read_lights(const Reader& root, Scene& scene);

}  // namespace cuticle::scene
