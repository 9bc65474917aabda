#include "render/passes/surface_shadow/surface_shadow_gpu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gpu/groups.h"
#include "shadows/light_frame.h"
#include "strands/spline/drawn_gpu.h"

#include <hair_shadow_comp.spv.h>
#include <surface_shadow_comp.spv.h>
#include <surface_shadow_frag.spv.h>
#include <surface_shadow_vert.spv.h>

namespace cuticle::render::surface_shadow {

namespace {

constexpr double k_margin = 2;               // texels between what casts and the border of a map
constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f: the depth where nothing is

/// As the shaders read them.
struct HairPush {
  std::uint32_t vertices_per_strand;
  float width;
  std::uint32_t segment_count, light_count, parts, first_row, row_count;
  float alpha[3];
};
struct LookupPush {
  std::uint32_t vertex_count, light;
  float half_side;
};

struct Kernels {
  gpu::GraphicsPipeline surfaces;
  gpu::Kernel hair, lookup;
};
/// Rows of the hair's maps that one dispatch draws.
struct Band {
  std::uint32_t first_row, row_count;
  gpu::Buffer depths;
};
struct Surface {
  gpu::Buffer positions, indices;
  strands::Bounds bounds;  ///< at rest
  std::uint32_t index_count = 0;
};
struct Settings {
  int resolution, lights;
  double bias;          ///< metres
  float strand_filter;  ///< texels
  double hair_share;
  glm::ivec2 size() const { return texture_size(resolution, lights); }
  int columns() const { return size().x / resolution; }
};

std::array<glm::dvec3, 8> corners(const strands::Bounds& bounds) {
  std::array<glm::dvec3, 8> all;
  for (std::size_t k = 0; k < 8; ++k)
    all[k] = {(k & 1 ? bounds.upper : bounds.lower).x, (k & 2 ? bounds.upper : bounds.lower).y,
              (k & 4 ? bounds.upper : bounds.lower).z};
  return all;
}

/// What casts or receives: the boxes of the hair and of the surface.
std::vector<glm::dvec3> points_in_view(const Resources& resources, const Surface& surface) {
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& corner : corners(resources.get<DrawnHair>().strands.bounds)) points.push_back(corner);
  for (const glm::dvec3& corner : corners(surface.bounds))
    if (surface.index_count > 0) points.emplace_back(resources.get<Surfaces>().head_transform * glm::dvec4(corner, 1));
  return points;
}

/// What a light's view shows: right, up and away from the light from `origin`, and what lies in it.
struct View {
  std::array<glm::dvec3, 3> axes;
  glm::dvec3 origin{0}, lower{std::numeric_limits<double>::max()}, upper{-lower};

  View(const glm::dvec3& forward, const glm::dvec3& from) : origin(from) {
    const shadows::PlaneAxes plane = shadows::plane_axes(forward);
    axes = {plane.first, plane.second, forward};
  }
  glm::dvec3 seen(const glm::dvec3& point) const {
    const glm::dvec3 away = point - origin;
    return {glm::dot(axes[0], away), glm::dot(axes[1], away), glm::dot(axes[2], away)};
  }
  void hold(const glm::dvec3& seen) {
    lower = glm::min(lower, seen);
    upper = glm::max(upper, seen);
  }
  /// A point's coordinate along an axis, as a row of a matrix.
  glm::dvec4 row(int axis) const { return {axes[std::size_t(axis)], -glm::dot(axes[std::size_t(axis)], origin)}; }
};

/// From what a view shows across to the texels of a light's map: factor and offset.
struct Texels {
  glm::dvec2 scale, first;
  Texels(const View& view, const Settings& settings, int index) {
    const glm::dvec2 extent = glm::max(glm::dvec2(view.upper - view.lower), glm::dvec2(1e-6));
    scale = (settings.resolution - 2 * k_margin) / extent;
    first = double(settings.resolution) * glm::dvec2(index % settings.columns(), index / settings.columns()) +
            k_margin - scale * glm::dvec2(view.lower);
  }
};

/// A light's view: world to the texels of the texture, depth and w.
struct LightMap {
  glm::dmat4 world_to_map;
  glm::dvec4 sight;
  double depth_of_metre;  ///< over w^2
};

LightMap distant_map(const glm::dvec3& to_light, std::span<const glm::dvec3> points, const Settings& settings,
                     int index) {
  View view(-to_light, glm::dvec3(0));
  for (const glm::dvec3& point : points) view.hold(view.seen(point));
  const Texels texels(view, settings, index);
  const double per_metre = 1 / std::max(view.upper.z - view.lower.z, 1e-6);
  const glm::dvec4 one(0, 0, 0, 1);
  const glm::dmat4 rows(texels.scale.x * view.row(0) + texels.first.x * one,
                        texels.scale.y * view.row(1) + texels.first.y * one,
                        per_metre * (view.row(2) - view.lower.z * one), one);
  return {glm::transpose(rows), glm::dvec4(-to_light, 0), per_metre};
}

/// A perspective view towards the middle of the points, up to 75 degrees to each side; what lies beyond is beside the
/// map.
LightMap point_light_map(const glm::dvec3& point_light, std::span<const glm::dvec3> points, const Settings& settings,
                         int index) {
  constexpr double k_widest = 3.7, k_least_near = 1e-3;
  glm::dvec3 middle(0);
  for (const glm::dvec3& point : points) middle += point / double(points.size());
  const double distance = glm::length(middle - point_light);
  View view(distance > 1e-9 ? (middle - point_light) / distance : glm::dvec3(0, -1, 0), point_light);
  double nearest = std::numeric_limits<double>::max(), far = 1e-3;
  for (const glm::dvec3& point : points) {
    nearest = std::min(nearest, view.seen(point).z);
    far = std::max(far, 1.001 * view.seen(point).z);
  }
  const double near = std::max(0.999 * nearest, k_least_near * far), depth = far / (far - near);
  for (const glm::dvec3& point : points)
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 seen = view.seen(point), slope = seen.z > near ? seen / seen.z : glm::dvec3(side * k_widest);
      view.hold(glm::clamp(slope, -k_widest, k_widest));
    }
  const Texels texels(view, settings, index);
  const glm::dmat4 rows(texels.scale.x * view.row(0) + texels.first.x * view.row(2),
                        texels.scale.y * view.row(1) + texels.first.y * view.row(2),
                        depth * (view.row(2) - glm::dvec4(0, 0, 0, near)), view.row(2));
  return {glm::transpose(rows), glm::dvec4(-point_light, 1), depth * near};
}

Result<LightMap> light_map(const Light& light, std::span<const glm::dvec3> points, const Settings& settings,
                           int index) {
  if (light.point_light) return point_light_map(light.point_light->position, points, settings, index);
  CUTICLE_ASSIGN(const glm::dvec3 to_light, shadows::unit_to_light(light.to_light));
  return distant_map(to_light, points, settings, index);
}

/// Of what hair casts on surfaces, whatever shadows hair itself.
shadows::Channels hair_channels(const Resources& resources) {
  return shadows::different_channels(resources.get<FibreOpacity>().alpha);
}

class SurfaceShadow : public GpuPass {
 public:
  SurfaceShadow(std::shared_ptr<gpu::Device> device, const Settings& settings, Kernels kernels, Surface surface)
      : device_(std::move(device)), settings_(settings), kernels_(std::move(kernels)), surface_(std::move(surface)) {}

  Result<void> make_maps(const Resources& resources, float surface_filter) {
    const gpu::TextureDescription map{settings_.size(), gpu::TextureFormat::depth32f, gpu::Filter::nearest, 1, true};
    CUTICLE_ASSIGN(maps_.surfaces, device_->make_texture(map));
    CUTICLE_TRY(make_bands({map.size.x, map.size.y * int(hair_channels(resources).count)}));
    CUTICLE_ASSIGN(maps_.visibility,
                   device_->make_buffer(std::size_t(settings_.lights) *
                                        resources.get<DrawnHair>().strands.vertex_count * sizeof(float)));
    CUTICLE_ASSIGN(frame_, device_->make_buffer(sizeof(MapsFrame)));
    maps_.surface_filter = surface_filter;
    return {};
  }

  /// The last may repeat rows of the one before, which changes nothing.
  Result<void> make_bands(const glm::ivec2& size) {
    const std::size_t row_bytes = std::size_t(size.x) * sizeof(float);
    auto hair = device_->make_texel_buffer(std::size_t(size.y) * row_bytes, gpu::TextureFormat::r32u);
    if (!hair)
      return Error{hair.error().kind, fmt::format("surface_shadow: hair's maps: {}", hair.error().message),
                   "lower passes.surface_shadow.resolution"};
    maps_.hair = std::move(*hair);
    const auto rows = std::uint32_t(size.y), parts = (rows + k_rows_of_a_part - 1) / k_rows_of_a_part;
    const std::uint32_t bands =
        hair_bands(settings_.resolution, settings_.lights, device_->info().max_storage_buffer_bytes);
    const std::uint32_t each = (parts + bands - 1) / bands;
    for (std::uint32_t band = 0; band < bands; ++band) {
      const std::uint32_t first = k_rows_of_a_part * std::min(band * each, parts - 1);
      const std::uint32_t count = std::min(k_rows_of_a_part * each, rows - first);
      bands_.push_back({first, count, gpu::part_of(maps_.hair, first * row_bytes, count * row_bytes)});
    }
    return {};
  }

  /// Where no method shadows hair: 1, which this pass alone takes light from.
  Result<void> make_unshadowed(const Resources& resources) {
    unshadowed_ = std::vector<gpu::Buffer>(resources.get<Lights>().all.size());
    for (gpu::Buffer& buffer : *unshadowed_) {
      CUTICLE_ASSIGN(buffer, device_->make_buffer(resources.get<DrawnHair>().strands.vertex_count * sizeof(float)));
    }
    return {};
  }

  void publish(Resources& resources) const override {
    resources.put_reference(maps_);
    if (!unshadowed_) return;
    HairTransmittance none{.of_surfaces_alone = true};
    for (const gpu::Buffer& buffer : *unshadowed_) none.reached.push_back(&buffer);
    resources.put(std::move(none));
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    if (unshadowed_)
      for (const gpu::Buffer& buffer : *unshadowed_) commands.fill(buffer, k_one);
    CUTICLE_TRY(set_frame(resources));
    CUTICLE_TRY(device_->upload(frame_, gpu::bytes_of(maps_.frame)));
    draw_surfaces(commands, resources);
    draw_hair(commands, resources);
    for (int light = 0; light < settings_.lights; ++light) look_up(commands, resources, light);
    return {};
  }

 private:
  Result<void> set_frame(const Resources& resources) {
    MapsFrame& frame = maps_.frame;
    frame.texture_size = glm::vec2(settings_.size());
    frame.resolution = std::uint32_t(settings_.resolution);
    frame.columns = std::uint32_t(settings_.columns());
    const std::vector<glm::dvec3> points = points_in_view(resources, surface_);
    for (int light = 0; light < settings_.lights; ++light) {
      const auto index = std::size_t(light);
      CUTICLE_ASSIGN(const LightMap map, light_map(resources.get<Lights>().all[index], points, settings_, light));
      frame.world_to_map[index] = glm::mat4(map.world_to_map);
      frame.sight[index] = glm::vec4(map.sight);
      frame.bias[index] = float(settings_.bias * map.depth_of_metre);
    }
    return {};
  }

  /// Without a head it draws nothing, in the one draw that a plan counts.
  void draw_surfaces(gpu::Commands& commands, const Resources& resources) const {
    const glm::mat4 rest_to_world(resources.get<Surfaces>().head_transform);
    const bool any = surface_.index_count > 0;
    const auto* const deformed = resources.find<HeadVertices>();
    const gpu::Buffer* const places = deformed ? deformed->positions : &surface_.positions;
    commands.begin_rendering({}, &maps_.surfaces);
    commands.draw(kernels_.surfaces, {&frame_, any ? places : &frame_, any ? &surface_.indices : &frame_}, {},
                  gpu::bytes_of(rest_to_world), surface_.index_count, std::uint32_t(settings_.lights));
    commands.end_rendering();
  }

  /// The first strands are spread over all, and stand for them.
  void draw_hair(gpu::Commands& commands, const Resources& resources) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const shadows::GpuStrands& casters = hair.casters;
    const shadows::Channels channels = hair_channels(resources);
    const std::uint32_t segments = (hair.vertices_per_strand - 1) / casters.segment_parts,
                        all = casters.segment_count / segments;
    const auto drawn = std::max(std::min(1u, all), std::uint32_t(std::lround(settings_.hair_share * all)));
    HairPush push{hair.vertices_per_strand,
                  casters.caster_width * float(all) / float(std::max(drawn, 1u)),
                  segments * drawn,
                  std::uint32_t(settings_.lights),
                  casters.segment_parts,
                  0,
                  0,
                  {float(channels.alpha[0]), float(channels.alpha[1]), float(channels.alpha[2])}};
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.segment_count) * push.light_count);
    commands.fill(maps_.hair, k_one);
    for (const Band& band : bands_) {
      push.first_row = band.first_row;
      push.row_count = band.row_count;
      commands.dispatch(kernels_.hair, {&frame_, casters.vertices, casters.segments, &band.depths}, {},
                        gpu::bytes_of(push), groups.x, groups.y);
    }
  }

  void look_up(gpu::Commands& commands, const Resources& resources, int light) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const std::uint32_t vertices = hair.strands.vertex_count;
    const LookupPush push{vertices, std::uint32_t(light), settings_.strand_filter};
    const gpu::Groups groups = gpu::groups_for(vertices);
    const std::uint32_t count = transmittance_of(resources).channels.count;
    const auto reached = [&](std::uint32_t k) {
      return transmittance_of(resources).reached[std::size_t(light) * count + std::min(k, count - 1)];
    };
    commands.dispatch(kernels_.lookup,
                      {&frame_, hair.strands.vertices, &maps_.visibility, reached(0), reached(1), reached(2)},
                      {&maps_.surfaces}, gpu::bytes_of(push), groups.x, groups.y);
  }

  std::shared_ptr<gpu::Device> device_;
  Settings settings_;
  Kernels kernels_;
  Surface surface_;
  Maps maps_;
  gpu::Buffer frame_;
  std::vector<Band> bands_;
  std::optional<std::vector<gpu::Buffer>> unshadowed_;  ///< a transmittance per light, where no method made them
};

Result<gpu::GraphicsPipeline> make_depth_pipeline(gpu::Device& device, std::span<const std::uint32_t> vertex,
                                                  std::span<const std::uint32_t> fragment,
                                                  const gpu::ShaderInterface& interface) {
  gpu::GraphicsDescription description;
  description.vertex_spirv = vertex;
  description.fragment_spirv = fragment;
  description.interface = interface;
  description.depth_test = description.depth_write = true;
  return device.make_graphics(description);
}

Result<Kernels> make_kernels(gpu::Device& device, const Resources& resources) {
  Kernels kernels;
  const gpu::ShaderInterface surfaces{3, 0, sizeof(glm::mat4)};
  const gpu::ShaderInterface hair{
      4, 0, sizeof(HairPush), with_channels({}, hair_channels(resources)), {strands::drawn_texels(1)}};
  const gpu::ShaderInterface lookup{
      6, 1, sizeof(LookupPush), with_channels({}, transmittance_of(resources).channels), {strands::drawn_texels(1)}};
  CUTICLE_ASSIGN(kernels.surfaces, make_depth_pipeline(device, surface_shadow_vert, surface_shadow_frag, surfaces));
  CUTICLE_ASSIGN(kernels.hair, device.make_kernel(hair_shadow_comp, hair));
  CUTICLE_ASSIGN(kernels.lookup, device.make_kernel(surface_shadow_comp, lookup));
  return kernels;
}

Result<Surface> upload(gpu::Device& device, const strands::Mesh& mesh) {
  std::vector<glm::vec4> positions;
  for (const glm::vec3& point : mesh.positions) positions.emplace_back(point, 1);
  Surface surface;
  surface.bounds = {mesh.positions.front(), mesh.positions.front()};
  for (const glm::vec3& point : mesh.positions) {
    surface.bounds.lower = glm::min(surface.bounds.lower, point);
    surface.bounds.upper = glm::max(surface.bounds.upper, point);
  }
  CUTICLE_ASSIGN(surface.positions, gpu::make_buffer_from<glm::vec4>(device, positions));
  const std::span<const std::uint32_t> indices(mesh.triangles.data()->data(), mesh.triangles.size() * 3);
  CUTICLE_ASSIGN(surface.indices, gpu::make_buffer_from<std::uint32_t>(device, indices));
  surface.index_count = std::uint32_t(indices.size());
  return surface;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const Lights& lights = resources.get<Lights>();
  const Surfaces& surfaces = resources.get<Surfaces>();
  const auto parameters = parameters_of<Parameters>(resources);
  const Settings settings{parameters.resolution, int(lights.all.size()), parameters.bias, parameters.strand_filter,
                          parameters.hair_share};
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device, resources));
  Surface surface;
  if (surfaces.head) {
    CUTICLE_ASSIGN(surface, upload(*device, *surfaces.head));
  }
  auto pass = std::make_unique<SurfaceShadow>(std::move(device), settings, std::move(kernels), std::move(surface));
  if (!resources.find<HairTransmittance>()) CUTICLE_TRY(pass->make_unshadowed(resources));
  CUTICLE_TRY(pass->make_maps(resources, parameters.surface_filter));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"surface_shadow", create};
  return table;
}

}  // namespace cuticle::render::surface_shadow
