#pragma once
// Engines: a folder of lut/targets each, found by CMake.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lut/manifest.h"

namespace cuticle::lut {

/// A text file beside the tables.
struct TextFile {
  std::string name, text;
};
/// What makes an engine import a folder of tables right by itself (linear, clamped, no mip maps, no compression), a hair
/// material that shades with them, the functions for a shader of one's own, a check, and a README of three steps.
struct Target {
  std::string_view name;     ///< as --target takes it, "unity"
  std::string_view summary;  ///< of what it writes
  /// Its files for a manifest, to stand beside the tables in a folder of the engine's own. Error: usage when the engine cannot read the manifest's format.
  Result<std::vector<TextFile>> (*files)(const Manifest& manifest);
};
std::span<const Target* const> targets();
/// The targets of a list "unity,godot". Error: usage, listing them.
Result<std::vector<const Target*>> find_targets(std::string_view names);

/// A snippet for an engine: the functions of a dialect after lines of the engine's own.
Result<std::string> engine_snippet(const Manifest& manifest, std::string_view dialect, const std::string& before);
/// Error: usage unless the manifest's format is one of these.
Result<void> check_readable(const Manifest& manifest, std::string_view target,
                            std::span<const std::string_view> formats);
/// The tables' files in words: "M.exr, N_TT_R.exr and N_TRT.exr".
std::string names_of_tables(const Manifest& manifest);
/// A text in which every @KEY@ is replaced.
std::string filled(std::string text, std::span<const std::pair<std::string_view, std::string>> values);

}  // namespace cuticle::lut
