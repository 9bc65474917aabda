#include "strands/character/gltf_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <fmt/core.h>

#include "core/json/json.h"
#include "core/text.h"

namespace cuticle::strands {

namespace {

constexpr const char* k_counts[] = {"byteOffset", "byteLength", "byteStride", "count"};

std::string decoded(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const bool is_code = uri[i] == '%' && i + 2 < uri.size() &&
                         std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3;
    name += is_code ? char(code) : uri[i];
    if (is_code) i += 2;
  }
  return name;
}

Result<void> check_counts(const Json& object, const std::string& name) {
  for (const char* key : k_counts) {
    const Json* count = object.find(key);
    if (count && !(count->is_whole() && count->number() >= 0))
      return bad_input(
          fmt::format("{}.{}: {}; allowed: whole numbers from 0", name, key, printable(count->dump(), 40)));
  }
  return {};
}

Result<void> check_uri(const Json& buffer, const std::string& name) {
  const Json* uri = buffer.find("uri");
  if (!uri || !uri->is_text() || uri->text().starts_with("data:") || stays_inside(uri->text())) return {};
  return bad_input(fmt::format("{}.uri: {} lies outside the file's own folder", name, in_quotes(uri->text())),
                   "put the buffer beside the file");
}

/// The objects of a list under a key, each by `check`.
template <class Check>
Result<void> check_each(const Json& root, const char* key, const std::string& where, Check check) {
  const Json* list = root.find(key);
  if (!list || !list->is_list()) return {};
  for (std::size_t i = 0; i < list->size(); ++i)
    CUTICLE_TRY(check((*list)[i], fmt::format("{}: {}[{}]", where, key, i)));
  return {};
}

}  // namespace

std::string_view gltf_text(std::span<const std::byte> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  constexpr std::size_t length_at = 12, text_at = 20;
  if (!all.starts_with("glTF")) return all;
  if (all.size() < text_at) return {};
  std::uint32_t length = 0;
  std::memcpy(&length, all.data() + length_at, sizeof(length));
  return all.substr(text_at, length);
}

bool stays_inside(std::string_view uri) {
  const std::string name = decoded(uri);
  const std::filesystem::path path(name);
  return path.is_relative() && name.find("://") == name.npos && name.find('\0') == name.npos &&
         std::find(path.begin(), path.end(), "..") == path.end();
}

Result<void> check_gltf_text(std::string_view text, const std::string& where) {
  const Result<Json> root = Json::parse(text);
  if (!root) return bad_input(fmt::format("{}: no glTF 2.0: {}", where, root.error().message));
  for (const char* key : {"accessors", "bufferViews"}) CUTICLE_TRY(check_each(*root, key, where, check_counts));
  return check_each(*root, "buffers", where, [](const Json& buffer, const std::string& name) -> Result<void> {
    CUTICLE_TRY(check_counts(buffer, name));
    return check_uri(buffer, name);
  });
}

}  // namespace cuticle::strands
