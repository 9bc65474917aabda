#include "plan/traced_frame.h"

#include "render/passes/motion_blur/motion_blur.h"

#ifdef CUTICLE_HAS_EMBREE
#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/expect.h"
#include "render/passes/depth_of_field/depth_of_field.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/fins/fins.h"
#include "render/passes/head/head.h"
#include "render/passes/reference/reference_entry.h"
#include "render/passes/resolve/resolve.h"
#include "render/reference/reference.h"
#endif

namespace cuticle::plan {

namespace {

/// In frames.
double shutter_of(const scene::Scene& scene) {
  if (!scene.passes.contains("motion_blur")) return 0;
  return render::parameters_of<render::motion_blur::Parameters>(scene.passes).shutter;
}

}  // namespace

bool has_open_shutter(const scene::Scene& scene, const registry::Facts& facts) {
  return shutter_of(scene) > 0 && facts.at("movement").holds;
}

#ifdef CUTICLE_HAS_EMBREE
namespace {

using render::reference::Surface;

/// The head where a frame has it: turned, or as a character deforms it.
strands::Mesh head_mesh(const StrandSet& set, const glm::dmat4& head, const std::optional<strands::Mesh>& skin) {
  return skin ? *skin : strands::transformed(set.head, head);
}

/// A mesh on its way between two frames: `frames` on from `now`.
strands::Mesh moved_on(strands::Mesh now, const strands::Mesh& before, double frames) {
  CUTICLE_EXPECT(now.positions.size() == before.positions.size(), "both frames have the same vertices");
  for (std::size_t v = 0; v < now.positions.size(); ++v)
    now.positions[v] += float(frames) * (now.positions[v] - before.positions[v]);
  for (std::size_t v = 0; v < now.normals.size(); ++v)
    now.normals[v] += float(frames) * (now.normals[v] - before.normals[v]);
  return now;
}

void move(Surface& surface, const strands::Mesh& before, double frames) {
  if (surface.mesh.positions == before.positions) return;
  surface.at_end = moved_on(surface.mesh, before, frames / 2);
  surface.mesh = moved_on(surface.mesh, before, -frames / 2);
}

Surface traced_head(const scene::Scene& scene, const StrandSet& set, const TracedPlaces& places) {
  const auto parameters = render::parameters_of<render::head::Parameters>(scene.passes);
  const glm::vec3 skin(parameters.skin), scalp(parameters.scalp);
  Surface surface;
  surface.mesh = head_mesh(set, places.head, places.skin);
  const std::vector<float> shares =
      render::head::scalp_shares(set.head, set.scalp.triangles.empty() ? nullptr : &set.scalp);
  for (const float share : shares) surface.albedo.push_back(glm::mix(skin, scalp, share));
  return surface;
}

Surface traced_floor(const Floor& floor) {
  const auto half = float(floor.size / 2), height = float(floor.height);
  Surface surface;
  surface.mesh.positions = {{-half, height, -half}, {half, height, -half}, {-half, height, half}, {half, height, half}};
  surface.mesh.normals.assign(4, glm::vec3(0, 1, 0));
  surface.mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  surface.albedo.assign(4, glm::vec3(floor.albedo));
  return surface;
}

Surface traced_fins(const scene::Scene& scene, const StrandSet& set, const strands::Mesh& fins) {
  const auto parameters = render::parameters_of<render::fins::Parameters>(scene.passes);
  Surface surface{fins, {}};
  for (const float weight : set.fin_weights)
    surface.albedo.push_back(glm::mix(glm::vec3(parameters.root), glm::vec3(parameters.tip), weight));
  return surface;
}

/// Lights, and the picture that some of them were made of in their place.
Result<void> add_lights(const scene::Scene& scene, render::reference::TracedScene& traced) {
  traced.lights = scene.lights;
  if (!scene.environment) return {};
  traced.lights.resize(scene.lights.size() - scene.environment->lights);
  CUTICLE_ASSIGN(Image picture, scene::surroundings_of(scene.environment->file));
  const scene::Environment& settings = scene.environment->settings;
  traced.surroundings = {std::move(picture), settings.turn_degrees, settings.scale};
  return {};
}

render::reference::Lens lens_of(const scene::Scene& scene, const Camera& camera) {
  if (!scene.passes.contains("depth_of_field")) return {};
  const auto lens = render::parameters_of<render::depth_of_field::Parameters>(scene.passes);
  return {lens.lens_radius * 1e-3, lens.focus > 0 ? lens.focus : glm::distance(camera.target, camera.position)};
}

/// `frames` on from now, as it moved since the frame before.
Camera moved_on(Camera now, const Camera& before, double frames) {
  now.position += frames * (now.position - before.position);
  now.target += frames * (now.target - before.target);
  now.up += frames * (now.up - before.up);
  now.vertical_field_of_view += frames * (now.vertical_field_of_view - before.vertical_field_of_view);
  return now;
}

/// The scene as it is where the shutter opens, and where it closes.
void open_shutter(double frames, const PlacesBefore& before, render::reference::TracedScene& traced) {
  std::vector<glm::vec3>& positions = traced.hair.positions;
  CUTICLE_EXPECT(before.hair.size() == positions.size(), "both frames have the same vertices");
  traced.positions_at_end = positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::vec3 way = float(frames / 2) * (positions[v] - before.hair[v]);
    traced.positions_at_end[v] += way;
    positions[v] -= way;
  }
  traced.camera_at_end = moved_on(traced.camera, before.camera, frames / 2);
  traced.camera = moved_on(traced.camera, before.camera, -frames / 2);
}

/// The parameters of the pass, and what they take from the rest of the scene.
Result<render::reference::TraceOptions> options_of(const scene::Scene& scene, const Camera& camera,
                                                   const render::reference::Parameters& parameters) {
  render::reference::TraceOptions options{.scatterings = parameters.bounces,
                                          .seed = parameters.seed,
                                          .layers = scene.outputs.aovs,
                                          .strands = scene.outputs.tells_strands(),
                                          .far_field = parameters.far_field,
                                          .lens = lens_of(scene, camera),
                                          .curves = strands::curve_kind(parameters.curves),
                                          .point_light_radius = parameters.point_light_radius,
                                          .sun_angle = parameters.sun_angle,
                                          .clamp_indirect = parameters.clamp_indirect};
  options.turning = {parameters.twist, parameters.turn_seed};
  if (parameters.tables) options.tables = {scene.material.layout, scene.material.lut_size};
  if (parameters.dual_scattering) {
    const auto dual = render::parameters_of<render::dual_scattering::Parameters>(scene.passes);
    options.dual_scattering = {dual.forward_density, dual.backward_density, dual.direction_spread};
  }
  const std::string& shadow = parameters.shadow;
  if (shadow == "traced") return options;
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(shadow));
  const bool of_scene = scene.shadow && scene.shadow->name == shadow;
  options.shadows = {shadow, of_scene ? scene.shadow->values : registry::default_values(method->entry.parameters),
                     scene.fibre_alpha.value_or(glm::dvec3(1))};
  return options;
}

/// What `reference` is asked for.
struct Traced {
  render::reference::TracedScene scene;
  render::reference::TraceOptions options;
  render::reference::Quality quality;
};

Result<Traced> traced_of(const scene::Scene& scene, const StrandSet& set, TracedPlaces places, const Camera& camera) {
  Traced traced;
  traced.scene.hair = std::move(places.hair);
  CUTICLE_ASSIGN(traced.scene.model, bsdf::find_model(scene.material.model.name));
  traced.scene.values = scene.material.model.values;
  traced.scene.camera = camera;
  if (places.before) open_shutter(shutter_of(scene), *places.before, traced.scene);
  CUTICLE_TRY(add_lights(scene, traced.scene));
  auto& surfaces = traced.scene.surfaces;
  const double shutter = places.before ? shutter_of(scene) : 0;
  if (!set.head.triangles.empty()) {
    surfaces.push_back(traced_head(scene, set, places));
    if (places.before) move(surfaces.back(), head_mesh(set, places.before->head, places.before->skin), shutter);
  }
  if (scene.floor) surfaces.push_back(traced_floor(*scene.floor));
  if (places.fins) {
    surfaces.push_back(traced_fins(scene, set, *places.fins));
    if (places.before && places.before->fins) move(surfaces.back(), *places.before->fins, shutter);
  }
  const auto parameters = render::parameters_of<render::reference::Parameters>(scene.passes);
  CUTICLE_ASSIGN(traced.options, options_of(scene, camera, parameters));
  if (traced.options.shadows) traced.options.shadows->fibre_width = double(set.fibre_width);
  traced.quality = {.samples = parameters.samples, .max_error = parameters.max_error};
  return traced;
}

TracedFrame frame_of(const scene::Scene& scene, render::reference::Picture picture) {
  render::resolve::add_background(picture.color,
                                  render::parameters_of<render::resolve::Parameters>(scene.passes).background);
  if (!scene.outputs.aovs) picture.layers = {};
  if (scene.outputs.tells_strands())
    picture.shares = with_rest(std::move(picture.shares), picture.color, {}, scene.camera.camera.far_plane);
  return {std::move(picture.color),
          std::move(picture.layers),
          std::move(picture.shares),
          fmt::format("reference: {} samples a pixel, standard error of a pixel {:.2f} % of the lit tiles' "
                      "mean, {:.1f} s",
                      picture.samples, 100 * picture.error, picture.seconds),
          picture.seconds,
          picture.processor_seconds};
}

}  // namespace

Result<TracedFrame> trace_frame(const scene::Scene& scene, const StrandSet& set, TracedPlaces places,
                                const Camera& camera, const std::string& state, Progress& progress) {
  CUTICLE_ASSIGN(Traced traced, traced_of(scene, set, std::move(places), camera));
  traced.quality.state = state;
  CUTICLE_ASSIGN(render::reference::Picture picture,
                 render::reference::trace_picture(traced.scene, traced.options, traced.quality, progress));
  return frame_of(scene, std::move(picture));
}

Result<std::vector<TracedFrame>> trace_frames(const scene::Scene& scene, const StrandSet& set, TracedPlaces places,
                                              const Camera& camera, std::span<const std::uint64_t> seeds,
                                              Progress& progress) {
  CUTICLE_ASSIGN(const Traced traced, traced_of(scene, set, std::move(places), camera));
  CUTICLE_ASSIGN(auto pictures,
                 render::reference::trace_pictures(traced.scene, traced.options, traced.quality, seeds, progress));
  std::vector<TracedFrame> frames;
  for (render::reference::Picture& picture : pictures) frames.push_back(frame_of(scene, std::move(picture)));
  return frames;
}
#else
namespace {

Error without_embree() {
  return usage_error("the method 'reference' needs Embree, and this build has none",
                     "build with CUTICLE_EMBREE=ON, or choose another method");
}

}  // namespace

Result<TracedFrame> trace_frame(const scene::Scene&, const StrandSet&, TracedPlaces, const Camera&, const std::string&,
                                Progress&) {
  return without_embree();
}

Result<std::vector<TracedFrame>> trace_frames(const scene::Scene&, const StrandSet&, TracedPlaces, const Camera&,
                                              std::span<const std::uint64_t>, Progress&) {
  return without_embree();
}
#endif

}  // namespace cuticle::plan
