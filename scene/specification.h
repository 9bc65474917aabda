#pragma once
// The scene file's shape as data: one tree that the checker, the reader and the JSON Schema all walk.
#include <string>
#include <vector>

#include "core/json/json.h"
#include "scene/scene.h"

namespace cuticle::scene {

/// What a key holds. `block`: an object with one registered name as its only key; `blocks`: any number of them;
/// `parameters`: an object checked against a parameter table; `file`: the name of a file that must exist; `rgb`: a
/// number, or one each for red, green and blue.
enum class SpecKind { object, array, block, blocks, parameters, text, file, real, integer, boolean, numbers, rgb };

/// One key of the file (or one item of an array).
struct Spec {
  std::string key;
  SpecKind kind = SpecKind::object;
  std::string summary = {};
  double minimum = 0, maximum = 0;  ///< of numbers; of the item count of an array
  int count = 0;                    ///< of `numbers` and `rgb`: how many
  bool required = false;
  std::vector<std::string> choices = {};             ///< of a text; empty: any
  std::vector<Spec> children = {};                   ///< fields of an object; the item of an array
  std::vector<const registry::Entry*> entries = {};  ///< of block and blocks
  registry::ParameterTable table = {};               ///< of parameters
};

/// The whole file, for the entries that are registered.
Spec specification(const Catalogue& catalogue);

/// A scene that fits the tree, and what was done to read it (migrate.h).
struct CheckedJson {
  Json value;
  std::vector<std::string> notes;
};
/// The text as JSON with what it includes, brought up to this format and checked against the tree. `folder`: what it
/// includes is relative to. Error: bad_input naming source, key, value, allowed range or keys.
Result<CheckedJson> parse_checked(const Spec& spec, std::string_view json, const std::string& folder,
                                  const std::string& where);

/// All that parse_checked would complain about, one thing after the other, and no more than `most`.
std::vector<Error> complaints_about(const Spec& spec, std::string_view json, const std::string& folder,
                                    const std::string& where, std::size_t most);

}  // namespace cuticle::scene
