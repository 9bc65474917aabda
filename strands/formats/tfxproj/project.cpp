#include "strands/formats/tfxproj/project.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

#include <fmt/core.h>

#include "core/file.h"
#include "core/mapped_file.h"
#include "strands/formats/formats.h"
#include "strands/formats/words.h"

namespace cuticle::strands {

namespace {

namespace fs = std::filesystem;

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

/// A number within a range; 0 where the line has ended.
Result<double> read_number(std::string_view& line, std::string_view what, double least, double most,
                           const std::string& where, int number) {
  const std::string_view word = next_word(line);
  if (word.empty()) return 0.0;
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code == std::errc() && end == word.data() + word.size() && value >= least && value <= most) return value;
  return line_error(where, number, fmt::format("{} '{}', allowed {} .. {}", what, word, least, most));
}

/// How many per guide hair, how far from it, and how much farther at the tip.
Result<FollowHairs> read_follow_hairs(std::string_view line, const std::string& where, int number) {
  FollowHairs hairs;
  CUTICLE_ASSIGN(const double count, read_number(line, "follow hairs", 0, double(k_max_follow_hairs), where, number));
  CUTICLE_ASSIGN(hairs.reach, read_number(line, "follow hairs' radius", 0, 1e6, where, number));
  CUTICLE_ASSIGN(hairs.tip_separation, read_number(line, "tip separation", -1, 1e3, where, number));
  hairs.per_guide = std::size_t(count);
  return hairs;
}

Result<void> read_part(std::string_view name, std::string_view line, const std::string& where, int number,
                       ProjectParts& parts) {
  if (!stays_inside(name))
    return line_error(where, number, fmt::format("part '{}' lies outside the project's folder", name));
  if (std::find(parts.files.begin(), parts.files.end(), name) != parts.files.end())
    return line_error(where, number, fmt::format("part '{}' is named twice", name));
  parts.files.emplace_back(name);
  CUTICLE_ASSIGN(parts.follow_hairs.emplace_back(), read_follow_hairs(line, where, number));
  return {};
}

Result<Groom> read_part_file(const std::string& path, Damage damage) {
  CUTICLE_ASSIGN(const FileBytes bytes, map_file(path));
  return parse_tfx(bytes.span(), path, damage);
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

Result<ParsedGroom> read_project(const std::string& path, Damage damage) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  CUTICLE_ASSIGN(const ProjectParts parts, parse_project(text, path));
  ParsedGroom file;
  std::size_t followers = 0;
  for (std::size_t k = 0; k < parts.files.size(); ++k) {
    const std::string& name = parts.files[k];
    CUTICLE_ASSIGN(Groom part, read_part_file((fs::path(path).parent_path() / name).string(), damage));
    CUTICLE_TRY(check_room(file.groom, part, path));
    file.notes.push_back(fmt::format("{}: {} strands", name, part.strand_count()));
    FollowHairs hairs = parts.follow_hairs[k];
    hairs.first = file.groom.strand_count();
    hairs.guides = part.strand_count();
    followers += hairs.guides * hairs.per_guide;
    if (hairs.per_guide > 0) file.follow_hairs.push_back(hairs);
    if (name == parts.files.front())
      file.groom = std::move(part);
    else
      append(file.groom, part);
  }
  if (followers > 0)
    file.notes.push_back(fmt::format("{} follow hairs are made beside them where they are drawn", followers));
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

namespace tfxproj {
const Format& entry() {
  static constexpr std::string_view extensions[] = {"tfxproj"};
  static const Format format{.name = "tfxproj",
                             .extensions = extensions,
                             .summary = "a TressFX project: its .tfx parts as one groom",
                             .holds = {},
                             .read = read_project};
  return format;
}
}  // namespace tfxproj

}  // namespace cuticle::strands
