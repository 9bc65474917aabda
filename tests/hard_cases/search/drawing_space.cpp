// Path-traced pictures of strands anywhere before any camera: no pixel is more than covered, and every colour is
// finite.
#include "bsdf/model.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr std::size_t k_drawn_strands = 3, k_drawn_vertices = 3;
constexpr double k_drawn_metres = 0.1;

Json camera_place(Coordinates& at) {
  return Json::list({at.between(-0.5, 0.5), at.between(-0.5, 0.5), at.between(0, 1.2)});
}

Json scene_of(Coordinates& at, std::string_view model) {
  const Json light{{"to_light", at.direction()}, {"irradiance", Json::list({3, 3, 3})}};
  const Json camera{{"position_m", camera_place(at)},
                    {"target_m", at.point(k_drawn_metres)},
                    {"fov_deg", at.between(1, 120)},
                    {"resolution_px", Json::list({16, 16})}};
  return Json{{"lights", Json::list({light})},
              {"camera", camera},
              {"material", Json{{"model", Json{{model, Json::object()}}}}},
              {"passes", Json{{"reference", Json{{"samples", 4}, {"bounces", 2}}}}}};
}

Json drawing_case(const bsdf::Model& model, bool alpha, const Place& place) {
  Coordinates at(place);
  Json inputs{{"groom", at.groom(k_drawn_strands, k_drawn_vertices, k_drawn_metres)},
              {"scene", scene_of(at, model.entry.name)}};
  inputs["measure"] = alpha ? "alpha" : "color";
  const double most = alpha ? 1.0001 : 1e6;
  return Json{
      {"subject", "drawing"}, {"inputs", std::move(inputs)}, {"expect", Json{{"bounds", Json::list({0, most})}}}};
}

}  // namespace

std::vector<Space> drawing_spaces() {
  const bsdf::Model* model = *bsdf::find_model("chiang");
  std::vector<Space> all;
  for (bool alpha : {false, true})
    all.push_back({.name = alpha ? "drawing_alpha" : "drawing_color",
                   .size = groom_size(k_drawn_strands, k_drawn_vertices) + k_direction + 2 * k_point + 1,
                   .case_at = [model, alpha](const Place& place) { return drawing_case(*model, alpha, place); },
                   .climbs = 1});
  return all;
}

}  // namespace cuticle::hard_cases::search
