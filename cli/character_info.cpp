#include "cli/character_info.h"

#include <fmt/core.h>
#include <glm/common.hpp>

#include "core/json/json.h"
#include "core/text.h"
#include "strands/character/character.h"
#include "strands/motion/bvh.h"

namespace cuticle::cli {

namespace {

Json clips_json(const strands::Character& character) {
  Json clips = Json::list();
  for (const strands::Clip& clip : character.clips)
    clips.push_back({{"name", clip.name}, {"seconds", clip.duration}, {"tracks", clip.tracks.size()}});
  return clips;
}

Json bounds_json(const strands::Mesh& mesh) {
  glm::vec3 lower = mesh.positions.front(), upper = lower;
  for (const glm::vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  return {{"lower", {lower.x, lower.y, lower.z}}, {"upper", {upper.x, upper.y, upper.z}}};
}

Json character_json(const std::string& file, const strands::Character& character) {
  const strands::CharacterReport& report = character.report;
  Json bones = Json::list();
  for (int node : character.joints) bones.push_back(character.nodes[std::size_t(node)].name);
  return {{"file", file},
          {"vertices", character.mesh.positions.size()},
          {"triangles", character.mesh.triangles.size()},
          {"joints", character.joints.size()},
          {"clips", clips_json(character)},
          {"bounds_m", bounds_json(character.mesh)},
          {"metres_per_unit", character.metres_per_unit},
          {"file_vertices", report.file_vertices},
          {"welded_conflicts", report.welded_conflicts},
          {"degenerate_triangles", report.degenerate_triangles},
          {"vertices_with_more_than_4_influences", report.reduced_vertices},
          {"largest_weight_dropped", report.largest_weight_dropped},
          {"vertices_without_weights", report.unweighted_vertices},
          {"influences_of_missing_joints", report.missing_joints},
          {"bad_weights", report.bad_weights},
          {"skipped_tracks", report.skipped_tracks},
          {"notes", report.notes},
          {"bones", bones}};
}

Result<Json> bone_map_json(const std::string& skeleton, const strands::Character& character,
                           const strands::Convention& convention) {
  CUTICLE_ASSIGN(const strands::Motion motion, strands::read_bvh(skeleton));
  std::vector<std::string> ours, theirs;
  for (int node : character.joints) ours.push_back(character.nodes[std::size_t(node)].name);
  for (const strands::Joint& joint : motion.joints) theirs.push_back(joint.name);
  CUTICLE_ASSIGN(const strands::BoneMap map, strands::map_bones(ours, theirs, convention.bones));
  Json pairs = Json::list();
  for (const auto& pair : map.pairs) pairs.push_back({{"bone", pair.ours}, {"is", pair.theirs}, {"by", pair.rule}});
  return Json{{"skeleton", skeleton}, {"mapped", pairs}, {"unmapped", map.unmapped}, {"ambiguous", map.ambiguous}};
}

Result<Json> describe(const CharacterInfoRequest& request) {
  strands::Convention convention;
  if (!request.convention.empty()) {
    CUTICLE_ASSIGN(convention, strands::read_convention(request.convention));
  }
  if (request.metres_per_unit > 0) convention.metres_per_unit = request.metres_per_unit;
  CUTICLE_ASSIGN(const strands::Character character, strands::read_character(request.file, convention));
  Json description = character_json(request.file, character);
  if (!request.skeleton.empty()) {
    CUTICLE_ASSIGN(description["bone_map"], bone_map_json(request.skeleton, character, convention));
  }
  return description;
}

}  // namespace

bool is_character_file(const std::string& file) { return file.ends_with(".glb") || file.ends_with(".gltf"); }

int show_character(const CharacterInfoRequest& request, bool json) {
  const auto description = describe(request);
  if (!description) return report(description.error());
  if (json) {
    fmt::print("{}\n", description->dump(2));
    return Exit::ok;
  }
  for (const auto& [key, value] : description->items())
    if (value.is_list() && !value.empty())
      for (const auto& item : value) fmt::print("{:<38}{}\n", key, printable(item.dump()));
    else
      fmt::print("{:<38}{}\n", key, printable(value.dump()));
  return Exit::ok;
}

}  // namespace cuticle::cli
