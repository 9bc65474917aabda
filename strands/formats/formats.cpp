#include <cuticle/strands/formats/formats.h>

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <cuticle/core/file.h>
#include <cuticle/strands/formats/project.h>

namespace cuticle::strands {

namespace {

// Radii beyond these are no animal's fibre: many files hold a thickness for pictures, not for physics.
constexpr double k_least_radius = 2e-6, k_greatest_radius = 5e-4;

std::string extension_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  std::string extension = dot == std::string::npos || path[dot] != '.' ? "" : path.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

Error unknown_extension(const std::string& path) {
  return bad_input(
      fmt::format("{}: extension '{}', allowed .hair, .tfx (and .tfxproj to read)", path, extension_of(path)),
      "give the file the ending of its format");
}

Result<Groom> parse_by_extension(std::span<const std::byte> bytes, const std::string& path) {
  if (extension_of(path) == "hair") return parse_hair(bytes, path);
  if (extension_of(path) == "tfx") return parse_tfx(bytes, path);
  return unknown_extension(path);
}

Result<GroomFile> read_in_file_units(const std::string& path) {
  if (extension_of(path) == "tfxproj") return read_project(path);
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  GroomFile file;
  CUTICLE_ASSIGN(file.groom, parse_by_extension(bytes, path));
  return file;
}

Result<void> check_options(const ReadOptions& options) {
  if (!std::isfinite(options.metres_per_unit) || options.metres_per_unit < 0 || options.metres_per_unit > 1000)
    return usage_error(fmt::format("metres per unit {}, allowed 0 (guess) .. 1000", options.metres_per_unit));
  if (!std::isfinite(options.radius) || options.radius < 0 || options.radius > 0.01)
    return usage_error(fmt::format("radius {} m, allowed 0 (from the file) .. 0.01", options.radius));
  return {};
}

void apply_units(GroomFile& file, const ReadOptions& options) {
  file.metres_per_unit = options.metres_per_unit;
  if (options.metres_per_unit == 0) {
    const UnitGuess guess = guess_units(file.groom);
    file.metres_per_unit = guess.metres_per_unit;
    file.notes.push_back(guess.why);
  }
  scale(file.groom, file.metres_per_unit);
}

void apply_radius(GroomFile& file, const ReadOptions& options) {
  std::vector<float>& radii = file.groom.radii;
  const double greatest = radii.empty() ? 0 : double(*std::max_element(radii.begin(), radii.end()));
  if (options.radius > 0) {
    std::fill(radii.begin(), radii.end(), float(options.radius));
    return;
  }
  if (greatest >= k_least_radius && greatest <= k_greatest_radius) return;
  std::fill(radii.begin(), radii.end(), k_default_radius);
  const std::string reason = greatest == 0
                                 ? "the file gives no thickness"
                                 : fmt::format("the file's thickness means a radius of {:.3g} m, not in {} .. {}",
                                               greatest, k_least_radius, k_greatest_radius);
  file.notes.push_back(fmt::format("{}: radius taken as {:.3g} m", reason, double(k_default_radius)));
}

std::vector<std::string> lost_in(const Groom& groom, const std::string& extension) {
  std::vector<std::string> notes;
  const bool is_hair = extension == "hair";
  for (const auto& [name, attribute] : groom.attributes)
    if (is_hair ? name != "color" && name != "transparency" : name != "movability")
      notes.push_back(fmt::format(".{} cannot hold the attribute '{}': dropped", extension, name));
  if (is_hair && !groom.root_uv.empty()) notes.push_back(".hair cannot hold root texture coordinates: dropped");
  if (!is_hair) notes.push_back(".tfx cannot hold radii: dropped");
  if (!groom.root_triangle.empty())
    notes.push_back(fmt::format(".{} cannot hold the triangles that the roots lie in: dropped", extension));
  return notes;
}

Result<void> check_hair_writable(const Groom& groom) {
  if (groom.strand_count() == 0) return bad_input(".hair: the groom has 0 strands, at least 1 is needed");
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) < 2 || groom.strand_size(s) > 65536)
      return bad_input(fmt::format(".hair: strand {} has {} points, allowed 2 .. 65536", s, groom.strand_size(s)));
  return {};
}

Result<std::vector<std::byte>> format_by_extension(const std::string& path, const Groom& groom) {
  if (extension_of(path) == "tfx") return format_tfx(groom, 4);
  CUTICLE_TRY(check_hair_writable(groom));
  return format_hair(groom);
}

}  // namespace

Result<GroomFile> read_groom(const std::string& path, const ReadOptions& options) {
  CUTICLE_TRY(check_options(options));
  CUTICLE_ASSIGN(GroomFile file, read_in_file_units(path));
  apply_units(file, options);
  apply_radius(file, options);
  if (const Result<void> valid = validate(file.groom); !valid)
    return bad_input(fmt::format("{}: after scaling by {}: {}", path, file.metres_per_unit, valid.error().message));
  return file;
}

Result<std::vector<std::string>> write_groom(const std::string& path, const Groom& groom, double metres_per_unit) {
  const std::string extension = extension_of(path);
  if (extension != "hair" && extension != "tfx") return unknown_extension(path);
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0)
    return usage_error(fmt::format("metres per unit {}, must be above 0", metres_per_unit));
  CUTICLE_TRY(validate(groom));
  Groom in_file_units = groom;
  scale(in_file_units, 1 / metres_per_unit);
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, format_by_extension(path, in_file_units));
  CUTICLE_TRY(write_file(path, bytes));
  return lost_in(groom, extension);
}

}  // namespace cuticle::strands
