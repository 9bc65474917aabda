// Solvers with any effects, settings, strands and motion of the head: whatever comes, every speed is finite.
#include "sim/solver.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr std::size_t k_moving_strands = 3, k_moving_vertices = 5, k_frames = 2;
constexpr double k_moving_metres = 0.2;
constexpr std::size_t k_frame = 2 + k_point + 2, k_collider = k_point + 1;

bool acts_on_hair(const sim::Effect& effect) { return effect.create == nullptr && !effect.acts_on_fins; }

Json frame_of(Coordinates& at) {
  Json frame{{"duration", at.by_factors(1e-4, 1)}, {"turn_deg", at.around_zero(180)}};
  Json move = Json::list();
  for (std::size_t k = 0; k < k_point; ++k) move.push_back(at.around_zero(100));
  frame["move"] = std::move(move);
  frame["teleport"] = at.flag();
  frame["repeat"] = 1 + at.below(3);
  return frame;
}

Json effects_of(Coordinates& at) {
  Json effects = Json::object();
  for (const sim::Effect* effect : sim::effects()) {
    if (!acts_on_hair(*effect)) continue;
    const bool is_there = at.flag();
    const std::string settings = at.settings(effect->entry.parameters);
    if (is_there) effects[effect->entry.name] = settings;
  }
  return effects;
}

Json motion_case(const sim::Effect& solver, const Place& place) {
  Coordinates at(place);
  Json inputs{{"solvers", Json::list({solver.entry.name})},
              {"groom", at.groom(k_moving_strands, k_moving_vertices, k_moving_metres)}};
  inputs["solver"] = Json{{solver.entry.name, at.settings(solver.entry.parameters)}};
  inputs["effects"] = effects_of(at);
  Json frames = Json::list();
  for (std::size_t k = 0; k < k_frames; ++k) frames.push_back(frame_of(at));
  inputs["frames"] = std::move(frames);
  Json sphere = at.point(k_moving_metres);
  sphere.push_back(at.by_factors(1e-3, 1));
  inputs["colliders"] = Json::list({sphere});
  inputs["measure"] = "speed";
  return Json{
      {"subject", "motion"}, {"inputs", std::move(inputs)}, {"expect", Json{{"bounds", Json::list({0, 1e38})}}}};
}

std::size_t motion_size(const sim::Effect& solver) {
  std::size_t size = groom_size(k_moving_strands, k_moving_vertices) + solver.entry.parameters.size() +
                     k_frames * k_frame + k_collider;
  for (const sim::Effect* effect : sim::effects())
    if (acts_on_hair(*effect)) size += 1 + effect->entry.parameters.size();
  return size;
}

}  // namespace

std::vector<Space> motion_spaces() {
  std::vector<Space> all;
  for (const sim::Effect* solver : sim::effects())
    if (solver->create != nullptr && !solver->acts_on_fins)
      all.push_back({.name = "motion_" + std::string(solver->entry.name),
                     .size = motion_size(*solver),
                     .case_at = [solver](const Place& place) { return motion_case(*solver, place); },
                     .climbs = 1});
  return all;
}

}  // namespace cuticle::hard_cases::search
