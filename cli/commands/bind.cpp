#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "cli/groom_options.h"
#include "cli/usd_files.h"
#include "core/json/json.h"
#include "strands/binding/binding.h"
#include "strands/binding/placement.h"
#include "strands/binding/root_file.h"
#include "strands/character/convention.h"

namespace cuticle::cli {

namespace {

struct BindRequest {
  std::string input, mesh, output, settings;
  strands::ReadOptions read;
  double mesh_metres_per_unit = 1, far = 0.005;
  strands::Convention convention;
  bool fit = false;
};

/// What is bound, in metres and our axes; roots alone are strands of one vertex, with the normals of their file.
struct Input {
  strands::Groom groom = {};
  std::vector<glm::vec3> normals = {};
};

Result<Input> read_roots(const BindRequest& request) {
  CUTICLE_ASSIGN(const strands::RootPlaces roots, strands::read_root_places(request.input));
  Input input{.normals = roots.normals};
  for (const glm::vec3& position : roots.positions) {
    input.groom.positions.push_back(position);
    input.groom.offsets.push_back(std::uint32_t(input.groom.positions.size()));
  }
  input.groom.radii.assign(input.groom.vertex_count(), strands::k_default_radius);
  const double unit = request.read.metres_per_unit;
  for (glm::vec3& position : input.groom.positions) position *= float(unit > 0 ? unit : 1);
  return input;
}

Result<Input> read_input(const BindRequest& request, Progress& progress) {
  Input input;
  if (request.input.ends_with(".txt")) {
    CUTICLE_ASSIGN(input, read_roots(request));
  } else {
    CUTICLE_ASSIGN(input.groom, load_groom(request.input, request.read, progress));
  }
  CUTICLE_ASSIGN(const glm::dmat4 turn, strands::axes_to_ours(request.convention));
  for (glm::vec3& p : input.groom.positions) p = glm::vec3(turn * glm::dvec4(p, 1));
  for (glm::vec3& n : input.normals) n = glm::vec3(turn * glm::dvec4(n, 0));
  return input;
}

/// Angle between the mesh's normals at the roots and those of the file, radians, on average; 0 without any.
double mean_angle(const strands::Mesh& at_roots, std::span<const glm::vec3> normals) {
  double sum = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 given(strands::unit_or_up(glm::dvec3(normals[i])));
    sum += std::acos(std::clamp(glm::dot(glm::dvec3(at_roots.normals[i]), given), -1.0, 1.0));
  }
  return normals.empty() ? 0 : sum / double(normals.size());
}

struct Bound {
  strands::Groom groom;
  strands::Placement placement = {};
  strands::BindingReport report = {};
  double normal_angle = 0;
};

Result<Bound> bind(const BindRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const strands::Mesh mesh, strands::read_obj(request.mesh, request.mesh_metres_per_unit));
  CUTICLE_ASSIGN(Input input, read_input(request, progress));
  Bound bound{.groom = std::move(input.groom)};
  if (request.fit) {
    std::vector<glm::vec3> roots;
    for (std::size_t s = 0; s < bound.groom.strand_count(); ++s)
      if (bound.groom.strand_size(s) > 0) roots.push_back(bound.groom.strand(s)[0]);
    CUTICLE_ASSIGN(bound.placement, strands::fit_placement(roots, mesh, 1));
    strands::place(bound.groom, bound.placement);
  }
  CUTICLE_ASSIGN(const strands::Binding binding, strands::bind_roots(bound.groom, mesh, request.far));
  bound.report = binding.report;
  strands::move_roots_onto(bound.groom, mesh, binding.roots);
  const strands::Mesh at_roots = strands::mesh_at_roots(mesh, binding.roots);
  bound.normal_angle = mean_angle(at_roots, input.normals);
  if (input.normals.empty()) return bound;
  CUTICLE_ASSIGN(const strands::Style style, registry::parse<strands::Style>(request.settings));
  CUTICLE_ASSIGN(bound.groom, strands::plant_control_hairs({.mesh = mesh, .scalp = at_roots, .colliders = {}}, style));
  return bound;
}

void print(const Bound& bound, bool json) {
  const strands::Spread& distance = bound.report.distance;
  const glm::dvec3& shift = bound.placement.shift;
  const Json report = {
      {"strands", bound.groom.strand_count()},
      {"vertices", bound.groom.vertex_count()},
      {"scale", bound.placement.scale},
      {"shift_m", {shift.x, shift.y, shift.z}},
      {"distance_m", {{"median", distance.median}, {"mean", distance.mean}, {"max", distance.greatest}}},
      {"far_strands", bound.report.far_strands},
      {"empty_strands", bound.report.empty_strands},
      {"degenerate_triangles", bound.report.degenerate_triangles},
      {"normals_differ_by_deg", bound.normal_angle * 180 / std::numbers::pi}};
  if (json) return fmt::print("{}\n", report.dump(2));
  for (const auto& [key, value] : report.items()) fmt::print("{:<22}{}\n", key, value.dump());
}

int run(const BindRequest& request, Context& context) {
  const auto bound = bind(request, *context.progress);
  if (!bound) return report(bound.error());
  const auto lost = write_groom_file(request.output, bound->groom);
  if (!lost) return report(lost.error());
  for (const std::string& note : *lost) context.progress->message(request.output + ": " + note);
  print(*bound, context.json);
  return Exit::ok;
}

}  // namespace

void add_bind(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("bind", "bind roots to the nearest points of a mesh; reports how well they fit");
  auto request = std::make_shared<BindRequest>();
  command->add_option("input", request->input, "groom, or .txt: places of roots, on which hair is then grown")
      ->required();
  command->add_option("mesh", request->mesh, "growth mesh: .obj")->required();
  command->add_option("--out", request->output, groom_help(true) + "; in metres")->required();
  add_groom_options(*command, request->read.metres_per_unit, request->read.radius);
  command->add_option("--mesh-metres-per-unit", request->mesh_metres_per_unit, "unit of the mesh");
  command->add_option("--up", request->convention.up, "axis of the groom that points up")->capture_default_str();
  command->add_option("--forward", request->convention.forward, "axis of the groom that faces forward")
      ->capture_default_str();
  command->add_flag("--fit", request->fit, "scale and shift the roots onto the mesh first");
  command->add_option("--far", request->far, "metres from the mesh past which a root is counted as far")
      ->capture_default_str();
  command->add_option("--set", request->settings, "growing parameters of hair on bare roots, name=value,name=value");
  command->callback([&context, request] { context.action = [&context, request] { return run(*request, context); }; });
}

}  // namespace cuticle::cli
