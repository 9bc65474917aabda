#include <algorithm>
#include <cctype>
#include <numeric>

#include "core/registry/parameter.h"

namespace cuticle::registry {
namespace {

/// Levenshtein's edit distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

bool is_same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Edits from what was typed to a name. Another case costs nothing, and a unit left off ("fov" for "fov_deg") one edit.
std::size_t typing_distance(std::string_view typed, std::string_view name) {
  if (std::ranges::equal(typed, name, is_same_letter)) return 0;
  if (name.size() > typed.size() && name.starts_with(typed) && name[typed.size()] == '_') return 1;
  return edit_distance(typed, name);
}

/// Letters that a unit may have, "_m2_per_s2".
constexpr std::size_t longest_unit = 16;

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string_view> known) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (std::string_view candidate : known) {
    // As many changes are needed at least; a name of megabytes is compared with none.
    const bool may_lack_unit = candidate.size() > name.size() && candidate.size() <= name.size() + longest_unit;
    const std::size_t changes = std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size());
    if (changes >= best_distance && !may_lack_unit) continue;
    const std::size_t distance = typing_distance(name, candidate);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = candidate;
  }
  return std::string(best);
}

}  // namespace cuticle::registry
