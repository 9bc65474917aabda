#include "study/oracle/rough_fibre.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/oracle/dielectric_cylinder.h"

namespace cuticle::study::oracle::rough_fibre_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

RoughFibre clear_fibre() {
  RoughFibre fibre;
  fibre.sigma_a = glm::dvec3(0);
  return fibre;
}
RoughFibre smooth_fibre() {
  RoughFibre fibre;
  fibre.surface.roughness = 0;
  return fibre;
}

TEST(RoughFibre, FollowedLight_KeepsItsEnergyWithoutAbsorption) {
  RoughFibre fibre = clear_fibre();
  fibre.blocked = Blocked::followed;
  fibre.tilt = 5 * degree;
  fibre.medulla = {0.5, 2, glm::dvec3(0), 0.4};
  for (Facets facets : {Facets::ggx, Facets::beckmann})
    for (double aspect : {1.0, 0.6}) {
      fibre.surface = {facets, 0.5};
      fibre.aspect = aspect;
      for (int n = 0; n < 2000; ++n) {
        RandomStream random(5, std::uint64_t(n));
        EXPECT_EQ(walk(fibre, {60 * degree, 0.3, {}}, 10000, random).energy.x, 1) << n;
      }
    }
}

TEST(RoughFibre, LostLight_LeavesLessThanAll) {
  RoughFibre fibre = clear_fibre();
  fibre.surface.roughness = 0.5;
  double sum = 0;
  for (const OrderScattering& order : scattering_of(fibre, {30 * degree, 0, {}}, {9, 9}, 20, 20000, 1))
    sum += order.energy.mean.x;
  EXPECT_GT(sum, 0.4);
  EXPECT_LT(sum, 0.99);
}

TEST(RoughFibre, ZeroRoughness_EveryWalkIsTheSmoothRay) {
  const double theta = 40 * degree, h = 0.6;
  const std::array<double, 4> truth = [&] {
    std::array<double, 4> phis{};
    for (int order = 0; order < 4; ++order)
      phis[std::size_t(order)] = follow({1.55, glm::dvec3(0.2)}, theta, h, order).phi;
    return phis;
  }();
  for (int n = 0; n < 20000; ++n) {
    RandomStream random(2, std::uint64_t(n));
    const Departure end = walk(smooth_fibre(), {theta, 0.9, h}, 10, random);
    EXPECT_NEAR(end.theta_i, -theta, 1e-12);
    if (end.order >= 4) continue;
    EXPECT_NEAR(std::remainder(end.phi + truth[std::size_t(end.order)], 2 * pi), 0, 1e-12);
  }
}

TEST(RoughFibre, VanishingRoughness_OrdersCarryTheSmoothEnergies) {
  for (double roughness : {0.0, 1e-3}) {
    RoughFibre fibre = smooth_fibre();
    fibre.surface.roughness = roughness;
    const auto orders = scattering_of(fibre, {50 * degree, 0, {}}, {9, 9}, 4, 200000, 3);
    for (int order = 0; order < 4; ++order) {
      const Estimate energy = orders[std::size_t(order)].energy;
      const double truth = lobe_energy({1.55, glm::dvec3(0.2)}, 50 * degree, order, 4096).x;
      EXPECT_NEAR(energy.mean.x, truth, 4 * energy.standard_error.x) << order;
    }
  }
}

TEST(RoughFibre, VanishingRoughness_BinsAreThoseOfTheSmoothWalk) {
  RoughFibre fibre = smooth_fibre();
  fibre.surface.roughness = 1e-4;
  const int phis = 36;
  const auto orders = scattering_of(fibre, {0, 0, {}}, {1, phis}, 3, 200000, 4);
  for (int order = 0; order < 3; ++order) {
    const auto truth = azimuthal_bins({1.55, glm::dvec3(0.2)}, 0, order, phis, 1 << 14);
    for (int bin = 0; bin < phis; ++bin) {
      const Estimate density = orders[std::size_t(order)].density[std::size_t(bin)];
      EXPECT_NEAR(2 * density.mean.x, truth[std::size_t(bin)].x, 2 * 5 * density.standard_error.x + 1e-4)
          << order << " " << bin;
    }
  }
}

TEST(RoughFibre, AspectOne_DoesNotDependOnTheViewersAzimuth) {
  RoughFibre fibre;
  fibre.surface.roughness = 0.3;
  fibre.tilt = 0.05;
  for (int n = 0; n < 200; ++n) {
    RandomStream one(6, std::uint64_t(n)), two(6, std::uint64_t(n));
    const Departure a = walk(fibre, {0.4, 0, {}}, 3, one), b = walk(fibre, {0.4, 1.1, {}}, 3, two);
    EXPECT_NEAR(a.energy.x, b.energy.x, 1e-9) << n;
    if (a.energy.x == 0) continue;
    EXPECT_NEAR(std::remainder(a.phi - b.phi, 2 * pi), 0, 1e-7) << n;
  }
}

// Along the minor axis through the middle, the way inside is two semi-axes, and light goes straight back or through.
TEST(RoughFibre, EllipseHeadOn_HasTheAbsorptionOfItsThickness) {
  RoughFibre fibre = smooth_fibre();
  fibre.aspect = 0.5;
  for (int n = 0; n < 100; ++n) {
    RandomStream random(7, std::uint64_t(n));
    const Departure end = walk(fibre, {0, pi / 2, 0.0}, 5, random);
    EXPECT_NEAR(end.energy.x, std::exp(-0.2 * end.order), 1e-12);
    EXPECT_NEAR(std::cos(end.phi), end.order % 2 == 1 ? -1 : 1, 1e-12);
  }
}

// At offset h the ellipse's normal is known in closed form from x^2 + y^2 / b^2 = 1.
TEST(RoughFibre, EllipseSeenAlongItsMajorAxis_MirrorsByItsOwnNormal) {
  RoughFibre fibre = smooth_fibre();
  fibre.aspect = 0.5;
  const double h = 0.6, normal = std::atan2(h / 0.5, std::sqrt(1 - h * h));
  int mirrored = 0;
  for (int n = 0; n < 200; ++n) {
    RandomStream random(8, std::uint64_t(n));
    const Departure end = walk(fibre, {0.2, 0, h}, 5, random);
    if (end.order > 0) continue;
    ++mirrored;
    EXPECT_NEAR(end.phi, -2 * normal, 1e-12);
  }
  EXPECT_GT(mirrored, 5);
}

TEST(RoughFibre, SymmetricFibre_ScattersEvenlyToBothSides) {
  RoughFibre fibre;
  fibre.surface.roughness = 0.4;
  fibre.aspect = 0.7;
  fibre.tilt = 0.05;
  const auto orders = scattering_of(fibre, {0.5, 0, {}}, {6, 8}, 3, 200000, 9);
  for (const OrderScattering& order : orders)
    for (std::size_t theta = 0; theta < 6; ++theta)
      for (std::size_t phi = 0; phi < 4; ++phi) {
        const Estimate a = order.density[theta * 8 + phi], b = order.density[theta * 8 + 7 - phi];
        EXPECT_NEAR(a.mean.x, b.mean.x, 4.5 * std::hypot(a.standard_error.x, b.standard_error.x) + 1e-6);
      }
}

TEST(RoughFibre, TiltedScales_MirrorTowardTheRoot) {
  RoughFibre fibre;
  fibre.surface.roughness = 0.01;
  fibre.tilt = 3 * degree;
  double sum = 0, energy = 0;
  for (int n = 0; n < 20000; ++n) {
    RandomStream random(10, std::uint64_t(n));
    const Departure end = walk(fibre, {20 * degree, 0, 0.0}, 0, random);
    if (end.order > 0) continue;
    sum += end.energy.x * end.theta_i;
    energy += end.energy.x;
  }
  EXPECT_NEAR(sum / energy, -26 * degree, 0.5 * degree);
}

/// A region of directions: sin(theta) and azimuth within a half-width of a centre.
struct Region {
  double sine, azimuth;
  static constexpr double half = 0.25;
  bool holds(double theta, double phi) const {
    return std::abs(std::sin(theta) - sine) < half && std::abs(std::remainder(phi - azimuth, 2 * pi)) < half;
  }
};
/// Energy of one order that passes from a region to another, from evenly spread viewers with the weight of the fibre's
/// area that they see.
Estimate flux(const RoughFibre& fibre, const Region& from, const Region& to, int order, std::uint64_t seed) {
  const int walks = order == 0 ? 400000 : 100000;
  double sum = 0, squares = 0;
  for (int n = 0; n < walks; ++n) {
    RandomStream random(seed, std::uint64_t(n));
    const double theta = std::asin(from.sine + Region::half * (2 * random.next_unit() - 1));
    const double azimuth = from.azimuth + Region::half * (2 * random.next_unit() - 1);
    const double area = std::hypot(std::sin(azimuth), fibre.aspect * std::cos(azimuth)) * std::cos(theta);
    const Departure end = walk(fibre, {theta, azimuth, {}}, order, random);
    if (end.order != order || !to.holds(end.theta_i, azimuth - end.phi)) continue;
    sum += end.energy.x * area;
    squares += end.energy.x * end.energy.x * area * area;
  }
  return {glm::dvec3(sum / walks), glm::dvec3(std::sqrt(squares) / walks)};
}

TEST(RoughFibre, ScatteredFlux_IsReciprocalInEveryOrder) {
  RoughFibre fibre;
  fibre.surface.roughness = 0.4;
  fibre.aspect = 0.7;
  const Region a{0.2, 0.4}, back{-0.6, 0.9}, through{-0.6, 3.0};
  for (int order = 0; order < 3; ++order) {
    const Region b = order == 1 ? through : back;
    const Estimate there = flux(fibre, a, b, order, 11), home = flux(fibre, b, a, order, 12);
    const double error = std::hypot(there.standard_error.x, home.standard_error.x);
    EXPECT_NEAR(there.mean.x, home.mean.x, 4 * error) << order;
    EXPECT_LT(error, 0.1 * there.mean.x) << order;
  }
}

TEST(RoughFibre, MedullaThatDoesNotScatter_ChangesNothing) {
  RoughFibre plain;
  plain.surface.roughness = 0.3;
  RoughFibre filled = plain;
  filled.medulla = {0.6, 0, plain.sigma_a, 0.2};
  for (int n = 0; n < 500; ++n) {
    RandomStream one(13, std::uint64_t(n)), two(13, std::uint64_t(n));
    const Departure a = walk(plain, {0.4, 0, {}}, 5, one), b = walk(filled, {0.4, 0, {}}, 5, two);
    EXPECT_EQ(a.phi, b.phi);
    EXPECT_NEAR(a.energy.x, b.energy.x, 1e-14);
  }
}

// Head-on, a share exp(-2 ratio scattering) of TT passes the medulla without an event and leaves straight through.
TEST(RoughFibre, MedullaHeadOn_LetsTheUnscatteredShareThrough) {
  RoughFibre fibre = smooth_fibre();
  fibre.medulla = {0.4, 1.5, glm::dvec3(0.7), 0.3};
  const int walks = 100000;
  double straight = 0;
  for (int n = 0; n < walks; ++n) {
    RandomStream random(14, std::uint64_t(n));
    const Departure end = walk(fibre, {0, 0, 0.0}, 1, random);
    if (end.order == 1 && std::abs(std::abs(end.phi) - pi) < 1e-9 && std::abs(end.theta_i) < 1e-9)
      straight += end.energy.x;
  }
  const double reflected = std::pow(0.55 / 2.55, 2);
  const double truth = std::pow(1 - reflected, 2) * std::exp(-0.4 * 2 * 1.5 - 0.4 * 2 * 0.7 - 0.6 * 2 * 0.2);
  EXPECT_NEAR(straight / walks, truth, 4 * std::sqrt(truth / walks));
}

TEST(RoughFibre, SameSeed_GivesTheSameBits) {
  const RoughFibre fibre;
  const auto one = scattering_of(fibre, {0.3, 0, {}}, {9, 18}, 2, 2000, 15);
  const auto two = scattering_of(fibre, {0.3, 0, {}}, {9, 18}, 2, 2000, 15);
  EXPECT_EQ(one[1].energy.mean, two[1].energy.mean);
  EXPECT_NE(one[1].energy.mean, scattering_of(fibre, {0.3, 0, {}}, {9, 18}, 2, 2000, 16)[1].energy.mean);
}

}  // namespace
}  // namespace cuticle::study::oracle::rough_fibre_test
