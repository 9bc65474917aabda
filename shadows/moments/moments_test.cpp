// The bounds that moments give, against distributions whose shares are known; then the maps made of them.
#include <cmath>

#include <gtest/gtest.h>

#include "shadows/moments/moment_map.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"
#include "shadows/moments/moments.glslh"

namespace cuticle::shadows::moments::moments_test {

namespace {

/// Hair at a few depths 0 .. 1, with shares that sum to 1.
struct Atom {
  double depth, share;
};
using Atoms = std::vector<Atom>;

PowerMoments<float> power_moments(const Atoms& atoms) {
  PowerMoments<float> moments{};
  for (int k = 0; k < 7; ++k) {
    double sum = 0;
    for (const Atom& atom : atoms) sum += atom.share * std::pow(2 * atom.depth - 1, k);
    moments.b[k] = float(sum);
  }
  return moments;
}
glm::vec2 circle_moment(const Atoms& atoms, int turns) {
  glm::dvec2 sum(0);
  for (const Atom& atom : atoms) sum += atom.share * circle_point(double(turns) * atom.depth);
  return glm::vec2(sum);
}
double share_of(const Atoms& atoms, Basis basis, double depth, double overestimation, double bias) {
  if (basis == Basis::trigonometric_4)
    return double(circle_share(circle_moment(atoms, 1), circle_moment(atoms, 2), float(bias), float(depth),
                               float(overestimation)));
  const PowerMoments<float> moments = biased(power_moments(atoms), float(bias));
  return double(power_share(moments, float(2 * depth - 1), float(overestimation), basis == Basis::power_4 ? 3 : 4));
}
double before(const Atoms& atoms, double depth) {
  double sum = 0;
  for (const Atom& atom : atoms) sum += atom.depth < depth ? atom.share : 0;
  return sum;
}
Atoms random_atoms(std::mt19937_64& random, int count) {
  Atoms atoms;
  double total = 0;
  for (int i = 0; i < count; ++i) atoms.push_back({tests::uniform(random), 0.05 + tests::uniform(random)});
  for (const Atom& atom : atoms) total += atom.share;
  for (Atom& atom : atoms) atom.share /= total;
  return atoms;
}
constexpr Basis k_all[] = {Basis::power_4, Basis::power_6, Basis::trigonometric_4};

}  // namespace

// Two surfaces have the fewest nodes that 4 moments allow, three those of 6: between them the share is exact.
TEST(Moments, AsManySurfacesAsTheMomentsHold_AreExact) {
  const Atoms two{{0.2, 0.3}, {0.7, 0.7}}, three{{0.1, 0.2}, {0.45, 0.5}, {0.8, 0.3}};
  for (const double depth : {0.05, 0.45, 0.9}) {
    EXPECT_NEAR(share_of(two, Basis::power_4, depth, 0.5, 1e-6), before(two, depth), 2e-3) << depth;
    EXPECT_NEAR(share_of(two, Basis::trigonometric_4, depth, 0.5, 1e-6), before(two, depth), 2e-3) << depth;
  }
  for (const double depth : {0.03, 0.3, 0.6, 0.95})
    EXPECT_NEAR(share_of(three, Basis::power_6, depth, 0.5, 1e-6), before(three, depth), 1e-2) << depth;
}

// The inequality of Chebyshev and Markov: overestimation 0 and 1 enclose the true share of whatever is there; on the
// circle, where the start of the hair is no node, nearly.
TEST(Moments, AnyHair_BoundsEncloseTheShare) {
  std::mt19937_64 random(11);
  double worst[3] = {};
  for (int i = 0; i < 4000; ++i) {
    const Atoms atoms = random_atoms(random, 1 + int(8 * tests::uniform(random)));
    const double depth = tests::uniform(random), share = before(atoms, depth);
    for (int b = 0; b < 3; ++b) {
      const double bias = default_bias(k_all[b]);
      worst[b] = std::max(worst[b], share_of(atoms, k_all[b], depth, 0, bias) - share);
      worst[b] = std::max(worst[b], share - share_of(atoms, k_all[b], depth, 1, bias));
    }
  }
  std::printf("bounds miss the share by at most %.5f, %.5f, %.5f\n", worst[0], worst[1], worst[2]);
  EXPECT_LT(worst[0], 1.5e-4);
  EXPECT_LT(worst[1], 1.5e-3);
  EXPECT_LT(worst[2], 0.08);
}

TEST(Moments, NoisyMoments_StayWithinZeroAndOne) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 4000; ++i) {
    const Atoms atoms = random_atoms(random, 1 + i % 3);
    PowerMoments<float> noisy = power_moments(atoms);
    for (int k = 1; k < 7; ++k) noisy.b[k] += float(2e-3 * (tests::uniform(random) - 0.5));
    for (const float z : {-1.0f, -0.999f, float(2 * atoms[0].depth - 1), 0.0f, 0.3f, 1.0f})
      for (const int n : {3, 4}) {
        const float share = power_share(biased(noisy, 1e-4f), z, 0.25f, n);
        EXPECT_TRUE(share >= 0 && share <= 1) << share;
      }
  }
}

TEST(Moments, MoreMoments_CloserToRandomHair) {
  std::mt19937_64 random(13);
  double error[3] = {};
  for (int i = 0; i < 2000; ++i) {
    const Atoms atoms = random_atoms(random, 8);
    const double depth = tests::uniform(random);
    for (int b = 0; b < 3; ++b)
      error[b] += std::abs(share_of(atoms, k_all[b], depth, 0.5, default_bias(k_all[b])) - before(atoms, depth)) / 2000;
  }
  std::printf("mean error of the share: power_4 %.4f, power_6 %.4f, trigonometric_4 %.4f\n", error[0], error[1],
              error[2]);
  EXPECT_LT(error[1], 0.8 * error[0]);
}

TEST(MomentMap, RandomSlab_FollowsTheExponentialLaw) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const double area = 4e-5 * tests::length_per_area(groom, 0.02, -1);
  const double half = 4e-5 * tests::length_per_area(groom, 0.02, 0.025);
  for (const char* basis : {"basis=power_4", "basis=power_6", "basis=trigonometric_4"}) {
    const std::string set = std::string(basis) + ",accumulate=poisson,filter_texels=3";
    const auto behind = tests::run_shadow("moments", groom, tests::grid_below(-0.06), set);
    EXPECT_NEAR(tests::mean(behind->values) / std::exp(-0.4 * area), 1, 0.01) << basis;
    const auto within = tests::run_shadow("moments", groom, tests::grid_below(0.025), set);
    std::printf("%s half way: %.4f of %.4f\n", basis, tests::mean(within->values), std::exp(-0.4 * half));
    EXPECT_NEAR(tests::mean(within->values) / std::exp(-0.4 * half), 1, 0.05) << basis;
  }
}

}  // namespace cuticle::shadows::moments::moments_test
