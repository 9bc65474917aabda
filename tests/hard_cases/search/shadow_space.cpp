// Shadow methods: the transmittance of any strands by any settings lies in 0 .. 1, and a lone strand is lit.
#include <string_view>

#include "shadows/method.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr std::size_t k_casters = 3, k_caster_vertices = 3;
constexpr double k_caster_metres = 0.1;

Json shadow_case(const shadows::Method& method, const Place& place) {
  Coordinates at(place);
  Json inputs{{"method", method.entry.name}, {"groom", at.groom(k_casters, k_caster_vertices, k_caster_metres)}};
  inputs["alpha"] = at.next();
  inputs["to_light"] = at.direction();
  inputs["set"] = at.settings(method.entry.parameters);
  return Json{{"subject", "shadow"}, {"inputs", std::move(inputs)}, {"expect", Json{{"bounds", Json::list({0, 1})}}}};
}

/// What a deep shadow map may lose by its own settings: a curve of one piece, an error that is allowed.
constexpr std::string_view k_default_of_lone[] = {"pieces", "error_bound"};

/// A straight strand of eight segments in any direction to the light.
Json lone_case(const shadows::Method& method, const Place& place) {
  Coordinates at(place);
  const double radius = at.by_factors(1e-5, 1e-3), length = at.by_factors(0.02, 2);
  const Json direction = at.direction();
  Json end = Json::list();
  for (const Json& component : direction) end.push_back(component.number() * length);
  const Json line{{"from", Json::list({0, 0, 0})}, {"to", end}, {"vertices", 9}};
  Json inputs{{"method", method.entry.name}, {"groom", Json{{"radius", radius}, {"lines", Json::list({line})}}}};
  inputs["alpha"] = at.next();
  inputs["set"] = at.settings(method.entry.parameters, k_default_of_lone);
  return Json{
      {"subject", "shadow"}, {"inputs", std::move(inputs)}, {"expect", Json{{"value", 1}, {"absolute", 0.015}}}};
}

/// Methods that know a receiver's own fibre, and the share of .015 that a lone strand may lose: at the places of every
/// run, and with the sweeps, where four times the largest that was found is allowed.
struct Lone {
  std::string_view method;
  double usual = 1, hardest = 1;
  double at_most() const { return is_sweep() ? hardest : usual; }
};
constexpr Lone k_lone[] = {{"opacity_map"},        {"deep_opacity"}, {"moments"},    {"fourier"},
                           {"deep_shadow", 2, 22}, {"exact_list"},   {"shadow_map"}, {"voxel"}};

}  // namespace

std::vector<Space> shadow_spaces() {
  std::vector<Space> all;
  for (const shadows::Method* method : shadows::methods())
    all.push_back({.name = "shadow_" + std::string(method->entry.name),
                   .size = method->entry.parameters.size() + groom_size(k_casters, k_caster_vertices) + 1 + k_direction,
                   .case_at = [method](const Place& place) { return shadow_case(*method, place); },
                   .climbs = 2});
  for (const Lone& lone : k_lone) {
    const shadows::Method* method = *shadows::find_method(lone.method);
    all.push_back({.name = "lone_strand_" + std::string(lone.method),
                   .size = method->entry.parameters.size() + 2 + k_direction + 1,
                   .case_at = [method](const Place& place) { return lone_case(*method, place); },
                   .climbs = 2,
                   .at_most = lone.at_most()});
  }
  return all;
}

}  // namespace cuticle::hard_cases::search
