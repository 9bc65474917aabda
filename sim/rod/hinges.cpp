#include "sim/rod/hinges.h"

#include <array>

#include <glm/geometric.hpp>

#include "sim/rod/kernel.h"
#include "sim/rod/rod_step.glslh"

namespace cuticle::sim::rod {
namespace {

using chains::k_lanes;

constexpr double k_shortest = 1e-3;  // of the strand, for bending

/// A lane's rod at rest; index i: link i from vertex i - 1, and the hinge at that vertex. Index 0: the clamp.
struct RestRod {
  std::vector<glm::dvec3> directions, directors;
  std::vector<double> lengths, bending_lengths, masses;
  double mean = 0;
  std::size_t links() const { return lengths.size() - 1; }
};

glm::dvec3 any_across(const glm::dvec3& direction) {
  const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(direction, axis));
}

template <class Real>
RestRod rest_rod(const chains::Chains<Real>& chains, std::size_t block, std::size_t lane) {
  namespace rest_row = chains::rest_row;
  const std::size_t links = chains.blocks[block].links;
  const auto number = [&](std::size_t i, int row) { return double(chains.rest_at(block, i, std::size_t(row))[lane]); };
  RestRod rod{{glm::dvec3(0)}, {glm::dvec3(0)}, {0}, {0}, {0}};
  const double reach = number(links, rest_row::reach);
  rod.mean = reach / double(links);
  glm::dvec3 parent(0);
  for (std::size_t i = 1; i <= links; ++i) {
    const glm::dvec3 place = chains::vector_at(chains.rest_at(block, i, rest_row::target), lane);
    rod.directions.push_back(glm::normalize(place - parent));
    rod.lengths.push_back(number(i, rest_row::length));
    rod.bending_lengths.push_back(std::max(rod.lengths[i], k_shortest * reach));
    rod.masses.push_back(number(i, rest_row::mass));
    parent = place;
  }
  rod.directions[0] = rod.directions[1];
  rod.directors[0] = any_across(rod.directions[0]);
  for (std::size_t i = 1; i <= links; ++i)
    rod.directors.push_back(transported(rod.directors[i - 1], rod.directions[i - 1], rod.directions[i]));
  return rod;
}

/// What a hinge's chord must be pulled by, per unit of mass, so that gravity and the hinges below balance: solved for
/// A - C, the inverse of bending_pull.
glm::dvec3 deviation(const Hinge<double>& hinge, const glm::dvec3& chord, const glm::dvec3& pull, double stiffness) {
  if (!(stiffness > 0)) return glm::dvec3(0);
  const double squared = glm::dot(chord, chord);
  const glm::dvec3 along = squared > 1e-16 ? chord * (glm::dot(chord, pull) / squared) : glm::dvec3(0);
  return (along / hinge.along + (pull - along) / hinge.across) / stiffness;
}

double bending_at(const RestRod& rod, std::size_t i, const Stiffness& stiffness) {
  const double cell = i == 1 ? rod.bending_lengths[1] / 2 : (rod.bending_lengths[i - 1] + rod.bending_lengths[i]) / 2;
  return stiffness.bending / (rod.mean * cell);
}

/// A hinge of a rod from the tip: its numbers, its pull, and its twist's moment.
struct Balance {
  glm::dvec3 pull{0}, weight{0}, spin_pull{0};
  double spin = 0, twist = 0;
};

template <class Real>
void fill_hinge(const RestRod& rod, std::size_t i, const Stiffness& stiffness, const glm::dvec3& gravity,
                Balance& below, std::array<Real, hinge_row::count>& row) {
  const glm::dvec3 &above = rod.directions[i - 1], &here = rod.directions[i];
  const Hinge<double> axes = hinge_between(above, here, rod.directors[i - 1], 1.0, 0.0, 0.0);  // C: the first axis
  const glm::dvec3 middle = glm::cross(axes.natural, axes.natural_spin);
  const double bending = bending_at(rod, i, stiffness);
  const double twisting = stiffness.bending > 0 ? bending * stiffness.twisting / stiffness.bending : 0;
  Balance now;
  now.weight = below.weight + gravity * rod.masses[i];
  double x = 0, y = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {  // the twist's share in the pull is small
    const glm::dvec3 pull = below.pull + now.weight * rod.lengths[i] - now.spin_pull - below.spin_pull;
    now.pull = pull - here * (glm::dot(pull, middle) / std::max(glm::dot(here, middle), 1e-3));
    const glm::dvec3 natural = axes.bent - deviation(axes, here - above, now.pull, bending);
    x = glm::dot(natural, axes.natural);
    y = glm::dot(natural, axes.natural_spin);
    now.spin = -bending * glm::dot(axes.bent, axes.natural_spin * x - axes.natural * y);
    now.twist = twisting > 0 ? below.twist - (now.spin + below.spin) / 2 : 0;
    now.spin_pull = spin_by(above, here) * now.twist;
  }
  row[hinge_row::stiffness] = Real(bending);
  row[hinge_row::twist] = Real(twisting);
  row[hinge_row::bend_x] = Real(x);
  row[hinge_row::bend_y] = Real(y);
  row[hinge_row::natural_angle] = twisting > 0 ? Real(-now.twist / twisting) : Real(0);
  row[hinge_row::inverse_length] = Real(1 / rod.bending_lengths[i]);
  below = now;
}

template <class Real>
void fill_lane(chains::Rows<Real>& hinges, std::size_t first, std::size_t lane, const RestRod& rod,
               const Stiffness& stiffness, const glm::dvec3& gravity) {
  const auto at = [&](std::size_t i, std::size_t row) -> Real& {
    return hinges[((first + i) * hinge_row::count + row) * k_lanes + lane];
  };
  for (int c = 0; c < 3; ++c) {
    at(0, std::size_t(clamp_row::direction + c)) = Real(rod.directions[0][c]);
    at(0, std::size_t(clamp_row::director + c)) = Real(rod.directors[0][c]);
  }
  Balance below;
  for (std::size_t i = rod.links(); i >= 1; --i) {
    std::array<Real, hinge_row::count> row{};
    fill_hinge(rod, i, stiffness, gravity, below, row);
    for (std::size_t k = 0; k < row.size(); ++k) at(i, k) = row[k];
  }
}

}  // namespace

template <class Real>
void put_hinges(const chains::Chains<Real>& chains, std::size_t block, std::size_t lane, const Stiffness& stiffness,
                const glm::dvec3& gravity, chains::Rows<Real>& hinges) {
  fill_lane(hinges, chains.blocks[block].first_vertex, lane, rest_rod(chains, block, lane), stiffness, gravity);
}
template void put_hinges<float>(const chains::Chains<float>&, std::size_t, std::size_t, const Stiffness&,
                                const glm::dvec3&, chains::Rows<float>&);
template void put_hinges<double>(const chains::Chains<double>&, std::size_t, std::size_t, const Stiffness&,
                                 const glm::dvec3&, chains::Rows<double>&);

template <class Real>
chains::Rows<Real> make_hinges(const chains::Chains<Real>& chains, const Stiffness& stiffness,
                               const glm::dvec3& gravity) {
  chains::Rows<Real> hinges(chains.rest.size() / chains::rest_row::count * hinge_row::count, Real(0));
  for (std::size_t b = 0; b < chains.blocks.size(); ++b)
    for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
      put_hinges(chains, b, lane, stiffness, gravity, hinges);
  return hinges;
}
template chains::Rows<float> make_hinges<float>(const chains::Chains<float>&, const Stiffness&, const glm::dvec3&);
template chains::Rows<double> make_hinges<double>(const chains::Chains<double>&, const Stiffness&, const glm::dvec3&);

}  // namespace cuticle::sim::rod
