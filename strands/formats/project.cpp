#include <cuticle/strands/formats/project.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

#include <fmt/core.h>

#include <cuticle/core/file.h>
#include <cuticle/strands/formats/words.h>

namespace cuticle::strands {

namespace {

namespace fs = std::filesystem;

Error line_error(const std::string& where, int line, const std::string& what) {
  return bad_input(fmt::format("{}: line {}: {}", where, line, what));
}

bool is_part(std::string_view word) { return word.size() > 4 && word.substr(word.size() - 4) == ".tfx"; }

/// A part may not lead out of the project's folder: a project from elsewhere must not reach other files.
bool stays_inside(std::string_view name) {
  const fs::path path(name);
  return path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

Result<void> read_version(std::string_view line, const std::string& where, int number) {
  const std::string_view word = next_word(line);
  double version = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), version);
  if (code == std::errc() && end == word.data() + word.size() && version >= 1 && version < 5) return {};
  return line_error(where, number, fmt::format("version '{}', allowed 1 <= version < 5", word));
}

Result<void> read_part(std::string_view name, std::string_view line, const std::string& where, int number,
                       ProjectParts& parts) {
  if (!stays_inside(name))
    return line_error(where, number, fmt::format("part '{}' lies outside the project's folder", name));
  if (std::find(parts.files.begin(), parts.files.end(), name) != parts.files.end())
    return line_error(where, number, fmt::format("part '{}' is named twice", name));
  parts.files.emplace_back(name);
  const std::string_view word = next_word(line);
  std::size_t followers = 0;
  std::from_chars(word.data(), word.data() + word.size(), followers);
  parts.followers = std::max(parts.followers, followers);
  return {};
}

/// Whether every groom so far has the attribute in the same form.
bool same_form(const Attribute& a, const Attribute& b) { return a.domain == b.domain && a.components == b.components; }

void keep_common_attributes(Groom& groom, const Groom& part) {
  std::erase_if(groom.attributes, [&part](const auto& entry) {
    const auto other = part.attributes.find(entry.first);
    return other == part.attributes.end() || !same_form(entry.second, other->second);
  });
  for (auto& [name, attribute] : groom.attributes) {
    const std::vector<float>& more = part.attributes.at(name).values;
    attribute.values.insert(attribute.values.end(), more.begin(), more.end());
  }
}

void append(Groom& groom, const Groom& part) {
  const std::uint32_t first = groom.offsets.back();
  for (std::size_t s = 1; s < part.offsets.size(); ++s) groom.offsets.push_back(first + part.offsets[s]);
  groom.positions.insert(groom.positions.end(), part.positions.begin(), part.positions.end());
  groom.radii.insert(groom.radii.end(), part.radii.begin(), part.radii.end());
  if (groom.root_uv.empty() || part.root_uv.empty())
    groom.root_uv.clear();
  else
    groom.root_uv.insert(groom.root_uv.end(), part.root_uv.begin(), part.root_uv.end());
  keep_common_attributes(groom, part);
}

Result<Groom> read_part_file(const std::string& path) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  return parse_tfx(bytes, path);
}

Result<void> check_room(const Groom& groom, const Groom& part, const std::string& where) {
  const std::uint64_t vertices = std::uint64_t(groom.vertex_count()) + part.vertex_count();
  if (vertices <= 0xffffffffull) return {};
  return bad_input(fmt::format("{}: {} points in all parts, allowed 2 .. {}", where, vertices, 0xffffffffull));
}

}  // namespace

Result<ProjectParts> parse_project(std::string_view text, const std::string& where) {
  ProjectParts parts;
  bool has_version = false;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = next_line(text);
    const std::string_view word = next_word(line);
    if (word == "version") {
      CUTICLE_TRY(read_version(line, where, number));
      has_version = true;
    } else if (is_part(word)) {
      CUTICLE_TRY(read_part(word, line, where, number, parts));
    }
  }
  if (!has_version) return bad_input(fmt::format("{}: no line 'version', a .tfxproj has one", where));
  if (parts.files.empty()) return bad_input(fmt::format("{}: names no .tfx file, at least 1 is needed", where));
  return parts;
}

Result<GroomFile> read_project(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  CUTICLE_ASSIGN(const ProjectParts parts, parse_project(text, path));
  GroomFile file;
  for (const std::string& name : parts.files) {
    CUTICLE_ASSIGN(Groom part, read_part_file((fs::path(path).parent_path() / name).string()));
    CUTICLE_TRY(check_room(file.groom, part, path));
    file.notes.push_back(fmt::format("{}: {} strands", name, part.strand_count()));
    if (name == parts.files.front())
      file.groom = std::move(part);
    else
      append(file.groom, part);
  }
  if (parts.followers > 0)
    file.notes.push_back(
        fmt::format("the project asks for {} follow hairs per guide hair: only the guides are read", parts.followers));
  return file;
}

std::string project_of(const std::string& tfx_path) {
  const fs::path part(tfx_path);
  std::vector<std::string> candidates;
  std::error_code code;
  const fs::path folder = part.has_parent_path() ? part.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().extension() == ".tfxproj") candidates.push_back(entry->path().string());
  std::sort(candidates.begin(), candidates.end());
  for (const std::string& candidate : candidates) {
    const Result<std::string> text = read_text_file(candidate);
    const Result<ProjectParts> parts = text ? parse_project(*text, candidate) : Result<ProjectParts>(text.error());
    if (parts && std::find(parts->files.begin(), parts->files.end(), part.filename().string()) != parts->files.end())
      return candidate;
  }
  return "";
}

}  // namespace cuticle::strands
