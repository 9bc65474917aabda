#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json/json.h"
#include "core/progress.h"

namespace cuticle::progress_test {
namespace {

std::string printed(ProgressStyle style) {
  ::testing::internal::CaptureStderr();
  {
    const std::unique_ptr<Progress> progress = make_progress(style);
    progress->update("baking", 1, 4);
    progress->message("a \"message\"");
    progress->update("baking", 4, 4);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, Json_WritesOneObjectPerLine) {
  std::istringstream lines(printed(ProgressStyle::json));
  std::string first, second;
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(Json::parse(first).value()["done"], 1);
  EXPECT_EQ(Json::parse(second).value()["message"], "a \"message\"");
}

TEST(Progress, Bar_EndsWithAllStepsDone) { EXPECT_THAT(printed(ProgressStyle::bar), ::testing::HasSubstr("4/4\n")); }

TEST(Progress, AutomaticIntoAPipe_WritesMessagesOnly) { EXPECT_EQ(printed(ProgressStyle::automatic), "a \"message\"\n"); }

TEST(Progress, Silent_WritesNothing) { EXPECT_EQ(printed(ProgressStyle::silent), ""); }

}  // namespace
}  // namespace cuticle::progress_test
