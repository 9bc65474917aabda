#pragma once
// Formats of strand files: a folder of strands/formats each, found by CMake.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

inline constexpr std::size_t k_max_follow_hairs = 255;  ///< per guide hair
/// Hairs that a format wants drawn beside each of its strands, which are guides (strands/spline/place.h makes them).
struct FollowHairs {
  std::size_t first = 0, guides = 0;  ///< strands of the groom that have them
  std::size_t per_guide = 0;
  double reach = 0;           ///< how far a root may lie from its guide's along each of two axes; the groom's unit
  double tip_separation = 0;  ///< at the tip a follow hair is 1 + this times as far from its guide as at the root
};

/// A groom as its file gives it: nothing scaled.
struct ParsedGroom {
  Groom groom;                          ///< in file units
  double metres_per_unit = 0;           ///< as the file states it; 0: it does not
  std::vector<std::string> notes = {};  ///< what was found out or left out, one sentence each
  std::vector<FollowHairs> follow_hairs = {};
};

/// What a parser does with numbers that are not finite and strands of fewer than two points.
enum class Damage {
  refuse,  ///< an error that names the first
  keep     ///< kept as they are, for repair()
};

/// An attribute of a name and form of its own.
struct NamedAttribute {
  std::string_view name;
  int components;
};

enum class Widths { none, ends, vertices };

/// What the files of a format hold beside points.
struct Holds {
  bool differing_sizes = true;           ///< strands of different numbers of points
  std::size_t most_points = 0xffffffff;  ///< per strand; the least is 2
  Widths widths = Widths::none;
  bool root_uv = false;
  bool roots = false;                          ///< root_triangle and root_barycentrics
  bool attributes = false;                     ///< every attribute whose name is a plain word: [A-Za-z_][A-Za-z0-9_]*
  std::span<const NamedAttribute> named = {};  ///< or these alone
};

struct Format {
  std::string_view name;
  std::span<const std::string_view> extensions;      ///< lower case, without the dot; the first is the usual one
  std::span<const std::string_view> read_only = {};  ///< more of them, under which nothing is written
  std::string_view summary;
  Holds holds;
  /// Of a whole file's bytes (fuzzed); `where` names it in messages. Error: bad_input with field and offset or line.
  Result<ParsedGroom> (*parse)(std::span<const std::byte> bytes, const std::string& where, Damage damage) = nullptr;
  /// The bytes of a file of a valid groom of which `holds` is true. Null: the format is read only.
  Result<std::vector<std::byte>> (*format)(const Groom& groom, double metres_per_unit) = nullptr;
  /// In place of reading the file and parsing it, where a groom is more than one file.
  Result<ParsedGroom> (*read)(const std::string& path, Damage damage) = nullptr;
};
std::span<const Format* const> formats();
/// The format of a file's ending. Error: bad_input, listing the endings that are read (or, `to_write`, written).
Result<const Format*> format_of(const std::string& path, bool to_write = false);
/// ".hair, .tfx, ..": the endings that are read, or written.
std::string list_of_extensions(bool to_write);

/// Takes out of the groom what the format cannot hold; one sentence for each.
std::vector<std::string> drop_what_it_cannot_hold(Groom& groom, const Format& format);
/// Error: bad_input naming the strand whose number of points the format does not hold.
Result<void> check_sizes(const Groom& groom, const Format& format);

}  // namespace cuticle::strands
