#pragma once
// What the search for unknown hard cases varies: cubes whose places are cases of the catalogue, one for each public
// function or family of them.
#include <functional>
#include <string>
#include <vector>

#include "core/json/json.h"

namespace cuticle::hard_cases::search {

/// Coordinates from 0 to 1. In the middle of each stands a default, or what is simplest.
using Place = std::vector<double>;

/// Cases over a cube.
struct Space {
  std::string name;      ///< letters, digits and underscores
  std::size_t size = 0;  ///< coordinates of a place
  /// The case at a place: "subject", "inputs" and "expect".
  std::function<Json(const Place&)> case_at;
  int climbs = 10;     ///< in every run of the tests, 0: none; with the sweeps the clock ends them
  int steps = 120;     ///< of a climb, at most
  double at_most = 1;  ///< what error_at may be
  /// How far from what is expected; null: share_used of the case.
  std::function<double(const Place&)> error = {};
};

/// Whether everything is searched (CUTICLE_SWEEPS, scripts/test.sh --full).
bool is_sweep();

/// Share of its tolerance that a case uses on the CPU in double and float; infinite where a value is not finite or out
/// of its bounds, or an error of our own came. 0 where the inputs are refused (usage, bad_input): that is sound.
double share_used(const Json& item);
bool is_refused(const Json& item);
double error_at(const Space& space, const Place& place);
/// As an item of catalogue/*.json.
std::string catalogue_text(const Space& space, const Place& place, double error);

std::vector<Space> function_spaces();
/// S of every model but `huang` in float against double.
std::vector<Space> float_spaces();
/// Every quantity of every model: finite and not negative; albedos: no more light than came.
std::vector<Space> model_spaces();
std::vector<Space> table_spaces();
std::vector<Space> shadow_spaces();
std::vector<Space> motion_spaces();
std::vector<Space> strand_spaces();
std::vector<Space> drawing_spaces();
std::vector<Space> fit_spaces();
/// All of the above.
std::vector<Space> spaces();

}  // namespace cuticle::hard_cases::search
