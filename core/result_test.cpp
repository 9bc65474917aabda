#include <memory>

#include <gtest/gtest.h>

#include "core/result.h"

namespace cuticle::result_test {
namespace {

Result<int> half_of(int number) {
  if (number % 2 != 0) return usage_error("odd", "even numbers");
  return number / 2;
}
Result<int> quarter_of(int number) {
  CUTICLE_ASSIGN(const int half, half_of(number));
  CUTICLE_ASSIGN(const int quarter, half_of(half));
  return quarter;
}
Result<void> must_be_even(int number) {
  CUTICLE_TRY(half_of(number));
  return {};
}

TEST(Result, AValue_IsOkAndHeld) {
  const Result<int> result = half_of(8);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(*result, 4);
}

TEST(Result, AnError_KeepsKindMessageAndHint) {
  const Result<int> result = half_of(3);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::usage);
  EXPECT_EQ(result.error().message, "odd");
  EXPECT_EQ(result.error().hint, "even numbers");
}

TEST(Result, AssignOfAnError_LeavesTheFunction) {
  EXPECT_EQ(quarter_of(8).value(), 2);
  EXPECT_FALSE(quarter_of(6));
}

TEST(Result, TryOfAnError_LeavesTheFunction) {
  EXPECT_TRUE(must_be_even(2));
  EXPECT_FALSE(must_be_even(1));
}

TEST(Result, MoveOnlyValue_MovesOut) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(5));
  const std::unique_ptr<int> held = std::move(result).value();
  EXPECT_EQ(*held, 5);
}

}  // namespace
}  // namespace cuticle::result_test
