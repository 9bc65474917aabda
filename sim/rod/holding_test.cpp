// Grooms that gravity would tip over are stiffened as little as holds them.
#include "sim/classic/test_strands.h"
#include "sim/rod/hold.h"

namespace cuticle::sim::holding_test {
namespace {

using namespace testing;

constexpr double k_g = 9.80665, k_bending = 3.9e9 * 3.5e-5 * 3.5e-5 / (4 * 1300), k_critical = 7.8373, k_reserve = 1.25;

strands::Groom upright(std::initializer_list<double> gammas, const glm::dvec3& direction = {0, 1, 0}) {
  strands::Groom groom;
  for (const double gamma : gammas)
    add_straight(groom, {0, 0, 0}, direction, uniform_segments(64, std::cbrt(gamma * k_bending / k_g)));
  return groom;
}
std::vector<rod::Hold> holds(const strands::Groom& groom, const std::string& settings = {}) {
  return rod::find_holds(groom, settings_of("rod", settings), gravity()).value();
}

TEST(Holding, UprightStrand_GetsWhatItsCriticalWeightAsks) {
  const std::vector<double> gammas = {6, 10, 100, 1000};
  const std::vector<rod::Hold> found = holds(upright({6, 10, 100, 1000}));
  EXPECT_EQ(found[0].stiffening, 1);
  for (std::size_t s = 1; s < gammas.size(); ++s) {
    const double truth = k_reserve * gammas[s] / k_critical;
    std::printf("upright, Gamma %.0f: stiffened by %.3f, %.3f by theory\n", gammas[s], double(found[s].stiffening),
                truth);
    EXPECT_NEAR(double(found[s].stiffening) / truth, 1, 0.015);
    EXPECT_TRUE(found[s].is_stable);
  }
}

TEST(Holding, HangingStrand_StaysAsItIs) {
  for (const rod::Hold& hold : holds(upright({10, 1000, 1e5}, {0, -1, 0}))) EXPECT_EQ(hold.stiffening, 1);
}

TEST(Holding, Cap_IsKeptAndSaid) {
  const std::vector<rod::Hold> found = holds(upright({10, 1000}), "stiffen_at_most=20");
  EXPECT_TRUE(found[0].is_stable);
  EXPECT_EQ(found[1].stiffening, 20);
  EXPECT_FALSE(found[1].is_stable);
}

/// Three styles: standing, hanging and curled strands of up to 0.29 m on a ball.
strands::Groom style(const std::string& name) {
  strands::Groom groom;
  for (int s = 0; s < 24; ++s) {
    const double around = 2.4 * s, up = name == "stands" ? 0.6 + 0.016 * s : 0.3 + 0.02 * s;
    const glm::dvec3 out(std::sqrt(1 - up * up) * std::cos(around), up, std::sqrt(1 - up * up) * std::sin(around));
    const double length = 0.1 + 0.19 * s / 23;
    const int links = 32;
    glm::dvec3 place = 0.09 * out;
    groom.positions.emplace_back(place);
    for (int i = 0; i < links; ++i) {
      const double t = (i + 0.5) / links;
      glm::dvec3 direction = out;
      if (name == "hangs") direction = glm::normalize(glm::mix(out, glm::dvec3(0, -1, 0), std::min(1.0, 3 * t)));
      if (name == "curls")
        direction =
            glm::normalize(out * 0.5 + glm::dvec3(0, -t, 0) + 0.8 * glm::dvec3(std::cos(18 * t), 0, std::sin(18 * t)));
      groom.positions.emplace_back(place += direction * (length / links));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

double largest_angle(std::span<const glm::vec3> strand, std::size_t i) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(strand[i]) - glm::dvec3(strand[i - 1])),
                   b = glm::normalize(glm::dvec3(strand[i + 1]) - glm::dvec3(strand[i]));
  return glm::degrees(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
}
/// How far any vertex is off the groom over its strand's length, and by how much the sharpest bend of any strand is
/// sharper than the groom's own, degrees.
struct Kept {
  double moved = 0, kink = 0;
};
Kept kept(const strands::Groom& groom, std::span<const glm::vec3> positions) {
  Kept kept;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> rest = groom.strand(s), now = positions.subspan(groom.offsets[s], rest.size());
    double length = 0, own = 0, sharpest = 0;
    for (std::size_t i = 1; i < rest.size(); ++i) length += double(glm::distance(rest[i - 1], rest[i]));
    for (std::size_t i = 1; i + 1 < rest.size(); ++i) {
      own = std::max(own, largest_angle(rest, i));
      sharpest = std::max(sharpest, largest_angle(now, i));
    }
    for (std::size_t i = 0; i < rest.size(); ++i)
      kept.moved = std::max(kept.moved, double(glm::distance(rest[i], now[i])) / length);
    kept.kink = std::max(kept.kink, sharpest - own);
  }
  return kept;
}

TEST(Holding, ThreeStyles_HoldAndTakeATurnOfTheHead) {
  for (const std::string name : {"stands", "hangs", "curls"}) {
    const strands::Groom groom = style(name);
    float most = 1;
    int stiffened = 0;
    for (const rod::Hold& hold : holds(groom)) {
      most = std::max(most, hold.stiffening);
      stiffened += hold.stiffening > 1;
      EXPECT_TRUE(hold.is_stable) << name;
    }
    auto solver = make_solver("rod", groom, "", gravity());
    const Kept still = kept(groom, run_still(*solver, 90, 1.0 / 30).positions);
    double kink = 0;
    for (int k = 0; k < 60; ++k) {
      const auto head = [](int at) {
        return glm::rotate(glm::dmat4(1), 0.8 * std::sin(0.21 * std::min(at, 30)), glm::dvec3(0, 1, 0));
      };
      ASSERT_TRUE(solver->advance({.duration = 1.0 / 30, .head_begin = head(k), .head_end = head(k + 1)}).ok());
      kink = std::max(kink, kept(groom, solver->state()->positions).kink);
    }
    std::printf(
        "%s: %d of %zu stiffened, by %.1f at most; moved by %.1e of a length in 3 s; sharpest bend %.1f degrees more "
        "in a turn\n",
        name.c_str(), stiffened, groom.strand_count(), double(most), still.moved, kink);
    EXPECT_LT(still.moved, 0.01) << name;
    EXPECT_LT(kink, 20) << name;
  }
}

}  // namespace
}  // namespace cuticle::sim::holding_test
