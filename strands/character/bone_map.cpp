#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#include <fmt/core.h>

#include "strands/character/convention.h"

namespace cuticle::strands {

namespace {

/// Lower-case words, cut at separators, at a capital after a small letter, and between letters and digits.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words{""};
  char last = 0;
  for (char c : name) {
    const auto is = [](int (*test)(int), char x) { return test(static_cast<unsigned char>(x)) != 0; };
    const bool joins = is(std::isalnum, c) && is(std::isalnum, last) && is(std::isdigit, c) == is(std::isdigit, last) &&
                       !(is(std::isupper, c) && is(std::islower, last));
    if (!joins) words.emplace_back();
    if (is(std::isalnum, c)) words.back() += char(std::tolower(static_cast<unsigned char>(c)));
    last = c;
  }
  std::erase(words, "");
  return words;
}

bool is_number(const std::string& word) {
  return std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "left" or "right" where the word is a side, else nothing.
std::string side_of(const std::string& word) {
  if (word == "l" || word == "left") return "left";
  return word == "r" || word == "right" ? "right" : "";
}

std::string synonym_of(const std::string& name) {
  static constexpr std::pair<std::string_view, std::string_view> synonyms[] = {
      {"pelvis", "hips"}, {"hip", "hips"},   {"clavicle", "shoulder"}, {"collar", "shoulder"}, {"upleg", "thigh"},
      {"shin", "calf"},   {"wrist", "hand"}, {"ankle", "foot"},        {"skull", "head"}};
  for (const auto& [from, to] : synonyms)
    if (name == from) return std::string(to);
  return name;
}

/// The name without an exporter's number: at the end, after an underscore, of two digits or more ("Head_05", not
/// "Spine1").
std::string_view without_exporter_number(std::string_view name) {
  const std::size_t cut = name.find_last_not_of("0123456789");
  const bool has = cut != std::string_view::npos && name[cut] == '_' && name.size() - cut > 2;
  return has ? name.substr(0, cut) : name;
}

/// Index of the only bone for which `matches` holds; -1: none; -2: several.
template <class Test>
int only_one(std::span<const std::string> bones, const Test& matches) {
  int found = -1;
  for (std::size_t i = 0; i < bones.size(); ++i)
    if (matches(bones[i])) found = found == -1 ? int(i) : -2;
  return found;
}

Result<void> check_overrides(std::span<const std::string> ours, std::span<const std::string> theirs,
                             const std::map<std::string, std::string>& overrides) {
  for (const auto& [from, to] : overrides) {
    if (std::ranges::find(ours, from) == ours.end())
      return bad_input(fmt::format("bones: no bone of ours is called '{}'", from));
    if (std::ranges::find(theirs, to) == theirs.end())
      return bad_input(fmt::format("bones.{}: no bone of theirs is called '{}'", from, to));
  }
  return {};
}

}  // namespace

std::string plain_bone_name(std::string_view name) {
  if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
  std::string side, plain;
  std::vector<std::string> words = words_of(without_exporter_number(name));
  static constexpr std::string_view prefixes[] = {"b", "bip", "bone", "def", "org", "jnt", "joint"};
  while (words.size() > 1 && (std::ranges::find(prefixes, words[0]) != std::end(prefixes) || is_number(words[0])))
    words.erase(words.begin());
  for (const std::string& word : words) {
    const std::string found = words.size() > 1 ? side_of(word) : "";
    if (side.empty() && !found.empty())
      side = found;
    else
      plain += is_number(word) ? std::to_string(std::atoi(word.substr(0, 6).c_str())) : word;
  }
  return side + synonym_of(plain);
}

Result<BoneMap> map_bones(std::span<const std::string> ours, std::span<const std::string> theirs,
                          const std::map<std::string, std::string>& overrides) {
  CUTICLE_TRY(check_overrides(ours, theirs, overrides));
  BoneMap map;
  for (const std::string& bone : ours) {
    if (const auto given = overrides.find(bone); given != overrides.end()) {
      map.pairs.push_back({bone, given->second, "override"});
      continue;
    }
    const int same = only_one(theirs, [&](const std::string& other) { return other == bone; });
    const std::string plain = plain_bone_name(bone);
    const int found =
        same >= 0 ? same : only_one(theirs, [&](const std::string& other) { return plain_bone_name(other) == plain; });
    if (found >= 0)
      map.pairs.push_back({bone, theirs[std::size_t(found)], same >= 0 ? "name" : "plain name"});
    else
      (found == -2 ? map.ambiguous : map.unmapped).push_back(bone);
  }
  return map;
}

}  // namespace cuticle::strands
