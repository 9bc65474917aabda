#include "study/skinning/twist_study.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/file.h"

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

std::string sections_csv(const TwistStudy& study) {
  std::string text = "place,linear_blend,dual_quaternion,linear_analytic\n";
  for (const SectionRow& row : study.sections)
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}\n", row.place, row.linear_blend, row.dual_quaternion,
                        row.linear_analytic);
  return text;
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

std::string twist_csv(const TwistStudy& study) {
  std::string text = "angle_deg,method,volume_kept,volume_analytic,middle_radius_kept\n";
  for (const TwistRow& row : study.rows)
    text += fmt::format("{:.6g},{},{:.6g},{:.6g},{:.6g}\n", row.angle_deg,
                        row.method == Skinning::linear_blend ? "linear_blend" : "dual_quaternion", row.volume_kept,
                        row.volume_analytic, row.middle_radius_kept);
  return text;
}

Result<void> write_twist_study(const TwistStudy& study, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", twist_csv(study)));
  return write_text_file(folder + "/sections.csv", sections_csv(study));
}

}  // namespace cuticle::study
