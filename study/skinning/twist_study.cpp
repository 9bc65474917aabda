#include "study/skinning/twist_study.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace cuticle::study {

namespace {

using strands::Skinning;

constexpr std::uint32_t k_sectors = 96;
constexpr double k_length = 4;  // in radii

/// A tube along x with flat ends, and weights that go over from joint 0 to joint 1.
struct Tube {
  strands::Mesh mesh = {};
  std::vector<strands::Influences> influences = {};
  std::uint32_t rings = 0;
};

Tube make_tube(std::uint32_t rings) {
  Tube tube{.rings = rings};
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t k = 0; k < k_sectors; ++k) {
      const double place = double(i) / (rings - 1), azimuth = 2 * std::numbers::pi * k / k_sectors;
      const glm::vec3 outward(0, std::cos(azimuth), std::sin(azimuth));
      tube.mesh.positions.push_back(outward + glm::vec3(k_length * place, 0, 0));
      tube.mesh.normals.push_back(outward);
      tube.influences.push_back({{0, 1, 0, 0}, {float(1 - place), float(place), 0, 0}});
      if (i + 1 == rings) continue;
      const std::uint32_t a = i * k_sectors + k, b = i * k_sectors + (k + 1) % k_sectors;
      tube.mesh.triangles.push_back({a, b + k_sectors, b});
      tube.mesh.triangles.push_back({a, a + k_sectors, b + k_sectors});
    }
  for (std::uint32_t k = 1; k + 1 < k_sectors; ++k) {  // ends, as fans
    const std::uint32_t last = (rings - 1) * k_sectors;
    tube.mesh.triangles.push_back({0, k, k + 1});
    tube.mesh.triangles.push_back({last, last + k + 1, last + k});
  }
  return tube;
}

double volume(const strands::Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += glm::dot(glm::dvec3(mesh.positions[t[0]]),
                    glm::cross(glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])));
  return std::abs(sum) / 6;
}

strands::Mesh twisted(const Tube& tube, double angle, Skinning method) {
  const std::vector<glm::dmat4> matrices{glm::dmat4(1), glm::rotate(glm::dmat4(1), angle, glm::dvec3(1, 0, 0))};
  strands::Mesh moved = tube.mesh;
  strands::skin(tube.mesh, tube.influences, strands::joint_motions(matrices), method, moved);
  return moved;
}

/// Mean distance of a ring from the axis; at rest it is 1.
double ring_radius(const strands::Mesh& mesh, std::uint32_t ring) {
  double sum = 0;
  for (std::uint32_t k = 0; k < k_sectors; ++k) {
    const glm::vec3& p = mesh.positions[ring * k_sectors + k];
    sum += std::hypot(double(p.y), double(p.z)) / k_sectors;
  }
  return sum;
}

double linear_radius(double place, double angle) {
  return std::sqrt(std::max(0.0, 1 - 2 * place * (1 - place) * (1 - std::cos(angle))));
}

TwistRow measure(const Tube& tube, double degrees, Skinning method) {
  const double angle = degrees * std::numbers::pi / 180;
  const strands::Mesh moved = twisted(tube, angle, method);
  const bool linear = method == Skinning::linear_blend;
  return {degrees, method, volume(moved) / volume(tube.mesh), linear ? 1 - (1 - std::cos(angle)) / 3 : 1,
          ring_radius(moved, tube.rings / 2)};
}

std::string name_of(Skinning method) {
  return method == Skinning::linear_blend ? "linear_blend" : "dual_quaternion";
}

Plot volume_plot(const TwistStudy& study) {
  Plot plot{"volume", "Volume that a twist leaves", "twist, degrees", "volume, over that at rest"};
  plot.curves = {{"linear_blend", {}, {}}, {"dual_quaternion", {}, {}}, {"linear blend, analytic", {}, {}}};
  const auto add = [&](std::size_t curve, double x, double y) {
    plot.curves[curve].x.push_back(x);
    plot.curves[curve].y.push_back(y);
  };
  for (const TwistRow& row : study.rows) {
    const bool linear = row.method == Skinning::linear_blend;
    add(linear ? 0 : 1, row.angle_deg, row.volume_kept);
    if (linear) add(2, row.angle_deg, row.volume_analytic);
  }
  return plot;
}

Plot section_plot(const TwistStudy& study) {
  Plot plot{"sections", "Radius along the tube at half a turn", "place along the tube", "radius, over that at rest"};
  plot.curves = {{"linear_blend", {}, {}}, {"dual_quaternion", {}, {}}, {"linear blend, analytic", {}, {}}};
  for (const SectionRow& row : study.sections) {
    for (Curve& curve : plot.curves) curve.x.push_back(row.place);
    plot.curves[0].y.push_back(row.linear_blend);
    plot.curves[1].y.push_back(row.dual_quaternion);
    plot.curves[2].y.push_back(row.linear_analytic);
  }
  return plot;
}

Point point_of(const TwistStudy& study, std::shared_ptr<const Tube> tube, Skinning method) {
  std::vector<double> lost;
  for (const TwistRow& row : study.rows)
    if (row.method == method && row.angle_deg > 0) lost.push_back(1 - row.volume_kept);
  return {name_of(method),
          {},
          [lost]() -> Result<Measured> { return Measured{{lost}}; },
          {{},
           [tube, method]() -> Result<void> {
             twisted(*tube, std::numbers::pi / 2, method);
             return {};
           },
           double(tube->mesh.positions.size())}};
}

}  // namespace

TwistStudy run_twist_study(int rings) {
  CUTICLE_EXPECT(rings >= 3 && rings % 2 == 1, "an odd number of rings, at least 3");
  const Tube tube = make_tube(std::uint32_t(rings));
  TwistStudy study;
  for (int degrees = 0; degrees <= 180; degrees += 15)
    for (Skinning method : {Skinning::linear_blend, Skinning::dual_quaternion})
      study.rows.push_back(measure(tube, degrees, method));
  const strands::Mesh linear = twisted(tube, std::numbers::pi, Skinning::linear_blend);
  const strands::Mesh dual = twisted(tube, std::numbers::pi, Skinning::dual_quaternion);
  for (std::uint32_t i = 0; i < tube.rings; ++i) {
    const double place = double(i) / (tube.rings - 1);
    study.sections.push_back(
        {place, ring_radius(linear, i), ring_radius(dual, i), linear_radius(place, std::numbers::pi)});
  }
  return study;
}

Study twist_declaration(int rings) {
  const TwistStudy study = run_twist_study(rings);
  const auto tube = std::make_shared<const Tube>(make_tube(std::uint32_t(rings)));
  Study declared{.name = "skinning",
                 .title = "A twisted limb: linear blend and dual quaternions",
                 .question = "How much of a limb's volume, and of the hair's roots on it, does a twist take?",
                 .cost_label = "one vertex, moved"};
  declared.groups = {{.name = "twist",
                      .title = "Volume lost by twists of 15 to 180 degrees",
                      .truth = "a twist keeps the volume of a limb",
                      .metrics = {{"volume", "share of the volume that is lost"}},
                      .item = "angle",
                      .points = {point_of(study, tube, Skinning::linear_blend), point_of(study, tube, Skinning::dual_quaternion)}}};
  declared.plots = {volume_plot(study), section_plot(study)};
  return declared;
}

}  // namespace cuticle::study
