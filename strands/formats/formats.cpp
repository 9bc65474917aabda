#include "strands/formats/formats.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "core/file.h"
#include "core/mapped_file.h"

namespace cuticle::strands {

namespace {

// Radii beyond these are no animal's fibre: many files hold a thickness for pictures, not for physics.
// As floats, as files hold them: 5e-4 itself is allowed.
constexpr double k_least_radius = double(2e-6f), k_greatest_radius = double(5e-4f);

Result<ParsedGroom> parse_file(const std::string& path, Damage damage) {
  CUTICLE_ASSIGN(const Format* format, format_of(path));
  if (format->read) return format->read(path, damage);
  CUTICLE_ASSIGN(const FileBytes bytes, map_file(path));
  return format->parse(bytes.span(), path, damage);
}

Result<void> check_options(const ReadOptions& options) {
  if (!std::isfinite(options.metres_per_unit) || options.metres_per_unit < 0 || options.metres_per_unit > 1000)
    return usage_error(fmt::format("metres per unit {}, allowed 0 (guess) .. 1000", options.metres_per_unit));
  if (!std::isfinite(options.radius) || options.radius < 0 || options.radius > 0.01)
    return usage_error(fmt::format("radius {} m, allowed 0 (from the file) .. 0.01", options.radius));
  return {};
}

Result<void> mend(GroomFile& file, const std::string& path) {
  const std::size_t strands = file.groom.strand_count();
  file.repairs = repair(file.groom);
  if (file.groom.strand_count() != strands) file.follow_hairs.clear();
  const std::vector<std::string> said = sentences(*file.repairs);
  file.notes.insert(file.notes.end(), said.begin(), said.end());
  if (file.groom.strand_count() > 0) return {};
  return bad_input(fmt::format("{}: no strand of two points is left after repair", path));
}

void apply_units(GroomFile& file, const ReadOptions& options, double stated) {
  file.metres_per_unit = options.metres_per_unit;
  if (file.metres_per_unit == 0 && stated > 0) {
    file.metres_per_unit = stated;
    file.notes.push_back(fmt::format("the file states {} metres per unit", stated));
  } else if (file.metres_per_unit == 0) {
    const UnitGuess guess = guess_units(file.groom);
    file.metres_per_unit = guess.metres_per_unit;
    file.notes.push_back(guess.why);
  }
  scale(file.groom, file.metres_per_unit);
  for (FollowHairs& hairs : file.follow_hairs) hairs.reach *= file.metres_per_unit;
}

/// 0 of none. Eight at a time, which the compiler widens with vectors.
float greatest_of(std::span<const float> radii) {
  std::array<float, 8> greatest{};
  for (std::size_t i = 0; i + greatest.size() <= radii.size(); i += greatest.size())
    for (std::size_t k = 0; k < greatest.size(); ++k) greatest[k] = std::max(greatest[k], radii[i + k]);
  for (float radius : radii.last(radii.size() % greatest.size())) greatest[0] = std::max(greatest[0], radius);
  return *std::max_element(greatest.begin(), greatest.end());
}

void apply_radius(GroomFile& file, const ReadOptions& options) {
  std::vector<float>& radii = file.groom.radii;
  const auto greatest = double(greatest_of(radii));
  file.has_radii = options.radius > 0 || (greatest >= k_least_radius && greatest <= k_greatest_radius);
  if (options.radius > 0) std::fill(radii.begin(), radii.end(), float(options.radius));
  if (file.has_radii) return;
  std::fill(radii.begin(), radii.end(), k_default_radius);
  const std::string reason = greatest == 0
                                 ? "the file gives no thickness"
                                 : fmt::format("the file's thickness means a radius of {:.3g} m, not in {:.3g} .. {:.3g}",
                                               greatest, k_least_radius, k_greatest_radius);
  file.notes.push_back(fmt::format("{}: radius taken as {:.3g} m", reason, double(k_default_radius)));
}

}  // namespace

Result<GroomFile> read_groom(const std::string& path, const ReadOptions& options) {
  CUTICLE_TRY(check_options(options));
  CUTICLE_ASSIGN(ParsedGroom parsed, parse_file(path, options.repair ? Damage::keep : Damage::refuse));
  GroomFile file{.groom = std::move(parsed.groom), .notes = std::move(parsed.notes)};
  file.follow_hairs = std::move(parsed.follow_hairs);
  if (options.repair) CUTICLE_TRY(mend(file, path));
  apply_units(file, options, parsed.metres_per_unit);
  apply_radius(file, options);
  // What a parser accepts is valid; only a scale above 1 can still make a number too large.
  if (const Result<void> valid = file.metres_per_unit > 1 ? validate(file.groom) : Result<void>(); !valid)
    return bad_input(fmt::format("{}: after scaling by {}: {}", path, file.metres_per_unit, valid.error().message));
  return file;
}

Result<std::vector<std::string>> write_groom(const std::string& path, const Groom& groom, double metres_per_unit) {
  CUTICLE_ASSIGN(const Format* format, format_of(path, true));
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0)
    return usage_error(fmt::format("metres per unit {}, must be above 0", metres_per_unit));
  CUTICLE_TRY(validate(groom));
  CUTICLE_TRY(check_sizes(groom, *format));
  Groom held = groom;
  const std::vector<std::string> lost = drop_what_it_cannot_hold(held, *format);
  scale(held, 1 / metres_per_unit);
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, format->format(held, metres_per_unit));
  CUTICLE_TRY(write_file(path, bytes));
  return lost;
}

}  // namespace cuticle::strands
