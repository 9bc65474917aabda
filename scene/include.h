#pragma once
// `$include` in scene files: an object takes the keys of other files that it does not have itself.
#include <map>
#include <string>
#include <vector>

#include "core/json/json.h"

namespace cuticle::scene {

inline constexpr std::string_view k_include = "$include";

/// A file that a scene is made of, without its comments.
struct SourceText {
  std::string name, folder, text;
};
/// A value's place: in which file, by which steps there.
struct Origin {
  std::size_t source = 0;
  std::vector<std::string> steps;
};
/// A scene file with all that it includes.
struct IncludedJson {
  Json value;
  std::vector<SourceText> sources;                     ///< the first: the scene file
  std::map<std::vector<std::string>, Origin> origins;  ///< of values that came from other files, by steps in the whole
  /// Where a value of the whole stands: its own place, or that of what it was included with.
  Origin origin_of(const std::vector<std::string>& steps) const;
};

/// Reads a scene file's text and what it includes: `"$include": "base.json"`, or a list of which an earlier file wins
/// over a later one; names are relative to the file that has them. Own keys win over included ones, key by key down
/// through objects; lists are taken whole. Errors: bad_input naming file, line and column: no JSON, no such file, an
/// include that is no object, or more than 16 within each other.
Result<IncludedJson> read_with_includes(std::string_view json, const std::string& folder, const std::string& where);

}  // namespace cuticle::scene
