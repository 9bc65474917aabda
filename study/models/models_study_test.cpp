// All models against light walked through a rough fibre, in a small form.
#include "study/models/models_study.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "study/engine/run.h"

namespace cuticle::study::models_study_test {
namespace {

TEST(ModelsStudy, TheModelOfFacets_IsNearestToTheWalkThroughFacets) {
  ModelsRequest request;
  request.walks = 40000;
  request.thetas = 6;
  request.phis = 8;
  request.inner = 2;
  Study study{.name = "models"};
  study.timing = {.rounds = 1, .sample_seconds = 1e-5, .slow_seconds = 0};
  study.groups.push_back(*models_against_walks(request, study.notes, silent_progress()));
  const StudyResult result = *run_study(study, silent_progress());
  const auto error = [](const PointResult& point) { return point.metrics[0].all.mean.value; };
  const auto& points = result.groups[0].points;
  const auto best = std::ranges::min_element(points, {}, error);
  EXPECT_EQ(best->method, "huang");
  EXPECT_LT(error(*best), 0.3);
  EXPECT_GE(std::ranges::count(points, "marschner", &PointResult::method), 2);  // direct, and tables
}

}  // namespace
}  // namespace cuticle::study::models_study_test
