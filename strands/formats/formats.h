#pragma once
// Strand files in and out, in the formats of format.h; OBJ meshes.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "strands/formats/format.h"
#include "strands/groom.h"
#include "strands/mesh.h"
#include "strands/repair.h"

namespace cuticle::strands {

/// How to take a file's numbers. metres_per_unit 0: as the file states, else guess_units; radius 0: the file's own
/// thickness, or k_default_radius. `repair`: damage is mended (see repair()), not refused.
struct ReadOptions {
  double metres_per_unit = 0;
  double radius = 0;
  bool repair = false;
};
/// A groom with what was guessed or dropped, one sentence each.
struct GroomFile {
  Groom groom;
  double metres_per_unit = 1;
  std::vector<std::string> notes;
  std::optional<Repairs> repairs = {};         ///< what was mended, where that was asked for
  bool has_radii = false;                      ///< radii are the file's, or were asked for; false: k_default_radius
  std::vector<FollowHairs> follow_hairs = {};  ///< in metres; none where repairs took strands out
};

/// By extension (format.h). Errors are bad_input and name file, field, offset and the allowed range.
Result<GroomFile> read_groom(const std::string& path, const ReadOptions& options = {});
/// By extension (format.h); gives what the format cannot hold, one sentence each.
Result<std::vector<std::string>> write_groom(const std::string& path, const Groom& groom, double metres_per_unit = 1);

/// Parsers over bytes (fuzzed). Positions in file units; nothing is scaled.
Result<Groom> parse_hair(std::span<const std::byte> bytes, const std::string& where, Damage damage = Damage::refuse);
Result<Groom> parse_tfx(std::span<const std::byte> bytes, const std::string& where, Damage damage = Damage::refuse);
Result<Mesh> parse_obj(std::string_view text, const std::string& where);
Result<Mesh> read_obj(const std::string& path, double metres_per_unit);

std::vector<std::byte> format_hair(const Groom& groom);
/// version 3 or 4. Error: bad_input when strands differ in vertex count.
Result<std::vector<std::byte>> format_tfx(const Groom& groom, int version);

}  // namespace cuticle::strands
