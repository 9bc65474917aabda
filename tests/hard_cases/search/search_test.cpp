// Looks for cases that nobody has thought of, over every space of inputs (space.h): properties at places by chance, and
// climbs up the error from there. What it finds is made simple and printed as an item for catalogue/*.json.
// The same places in every run; with the sweeps (scripts/test.sh --full) other ones each time, half an hour long.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/hard_cases/search/climb.h"

namespace cuticle::hard_cases::search::search_test {
namespace {

constexpr double k_sweep_seconds = 1800;

const std::vector<Space>& all_spaces() {
  static const std::vector<Space> all = spaces();
  return all;
}

/// Ends the climbs of a space: by count, or by its share of the half hour.
class Budget {
 public:
  explicit Budget(const Space& space) : left_(space.climbs) {}
  bool allows_another() {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    return is_sweep() ? spent.count() < k_sweep_seconds / double(all_spaces().size()) : left_-- > 0;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  int left_;
};

class Search : public testing::TestWithParam<std::size_t> {
 protected:
  const Space& space() const { return all_spaces()[GetParam()]; }
};

TEST_P(Search, ClimbingTheError_StaysWithinWhatIsAllowed) {
  if (space().climbs == 0 && !is_sweep()) GTEST_SKIP() << "takes long: scripts/test.sh --full";
  const unsigned seed = is_sweep() ? std::random_device()() : 20261127;
  RandomStream chance(seed, GetParam());
  Found worst{Place(space().size, 0.5), 0};
  long climbs = 0;
  for (Budget budget(space()); budget.allows_another() && std::isfinite(worst.error); ++climbs) {
    const Found found = climb(space(), chance, space().steps);
    if (found.error > worst.error) worst = found;
  }
  std::printf("%s: %.3g of %.3g at most, %ld climbs, seed %u\n", space().name.c_str(), worst.error, space().at_most,
              climbs, seed);
  if (worst.error <= space().at_most) return;
  worst = simplest(space(), worst, space().at_most);
  ADD_FAILURE() << "a hard case that the catalogue does not have:\n"
                << catalogue_text(space(), worst.place, worst.error);
}

/// The middle and the ends more often than others; becomes simpler towards the middle.
rc::Gen<double> coordinate() {
  constexpr int k_end = 1 << 20;
  const auto distance =
      rc::gen::weightedOneOf<int>({{3, rc::gen::just(0)},
                                   {2, rc::gen::just(k_end)},
                                   {5, rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, k_end + 1))}});
  return rc::gen::apply([](int far, bool up) { return 0.5 + (up ? 0.5 : -0.5) * far / k_end; }, distance,
                        rc::gen::arbitrary<bool>());
}

TEST_P(Search, PlacesByChance_Hold) {
  if (space().climbs == 0 && !is_sweep()) GTEST_SKIP() << "takes long: scripts/test.sh --full";
  const auto places = rc::gen::container<Place>(space().size, coordinate());
  Budget budget(space());
  EXPECT_TRUE(rc::check(space().name, [&] {
    const Place place = *places;
    if (is_sweep() && !budget.allows_another()) return;
    const double error = error_at(space(), place);
    if (!(error <= space().at_most)) RC_FAIL(catalogue_text(space(), place, error));
  }));
}

TEST_P(Search, CaseOfTheDefaults_IsNotRefused) {
  const Place middle(space().size, 0.5);
  EXPECT_FALSE(is_refused(space().case_at(middle))) << catalogue_text(space(), middle, 0);
}

INSTANTIATE_TEST_SUITE_P(Spaces, Search, testing::Range(std::size_t(0), all_spaces().size()),
                         [](const auto& tested) { return all_spaces()[tested.param].name; });

/// A search that finds nothing may be one that cannot find anything.
Space with_a_needle() {
  return {.name = "needle",
          .size = 4,
          .case_at =
              [](const Place& place) {
                return Json{{"inputs", Json{{"at", place}}}};
              },
          .at_most = 0.9,
          .error = [](const Place& place) { return 1 - std::abs(place[1] - 0.7) - std::abs(place[3] - 0.2); }};
}

TEST(Climb, SmoothHill_IsClimbed) {
  RandomStream chance(1);
  double best = 0;
  for (int k = 0; k < 20; ++k) best = std::max(best, climb(with_a_needle(), chance, with_a_needle().steps).error);
  EXPECT_GT(best, 0.95);
}

TEST(Climb, CoordinatesThatDoNotMatter_AreMadeSimple) {
  const Space space = with_a_needle();
  const Found found = simplest(space, {.place = {0.1, 0.7, 0.9, 0.2}, .error = 1}, 0.9);
  EXPECT_EQ(found.place, (Place{0.5, 0.7, 0.5, 0.2}));
  EXPECT_EQ(found.error, error_at(space, found.place));
}

TEST(ShareUsed, ErrorOfOurOwn_HasNoEnd) {
  const Json item{{"subject", "function"}, {"inputs", Json{{"function", "unknown"}}}, {"expect", Json::object()}};
  EXPECT_EQ(share_used(item), std::numeric_limits<double>::infinity());
}

TEST(ShareUsed, RefusedInput_UsesNothing) {
  const Json item{{"subject", "model"},
                  {"inputs", Json{{"model", "chiang"}, {"set", "beta_m=-1"}, {"quantity", "S"}}},
                  {"expect", Json::object()}};
  EXPECT_EQ(share_used(item), 0);
}

TEST(ShareUsed, ValueOutOfBounds_HasNoEnd) {
  const Json item{{"subject", "function"},
                  {"inputs", Json{{"function", "exp"}, {"x", 1}}},
                  {"expect", Json{{"bounds", Json::list({0, 2})}}}};
  EXPECT_EQ(share_used(item), std::numeric_limits<double>::infinity());
}

TEST(ShareUsed, ValueHalfATolerance_UsesHalf) {
  const Json item{{"subject", "function"},
                  {"inputs", Json{{"function", "exp"}, {"x", 0}}},
                  {"expect", Json{{"value", 1.5}, {"absolute", 1}}}};
  EXPECT_EQ(share_used(item), 0.5);
}

}  // namespace
}  // namespace cuticle::hard_cases::search::search_test
