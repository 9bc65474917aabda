// The elementary functions and the random words of core: the device against double on the CPU.
#include <gtest/gtest.h>

#include "core/shared/philox.glslh"
#include "gpu/device.h"
#include "gpu/tests/test_device.h"
#include "tests/hard_cases/elementary.glslh"
#include "tests/hard_cases/elementary_gpu.h"

namespace cuticle::hard_cases::functions_parity_test {
namespace {

gpu::Device& device() { return *tests::device(); }

/// Largest error over a grid; relative, except for sine and cosine (1 and 2), which cross 0.
double largest_error(std::uint32_t function, double from, double to) {
  std::vector<glm::vec2> arguments;
  for (int k = 0; k <= 20000; ++k) {
    const double t = k / 20000.0;
    arguments.emplace_back(from + (to - from) * t, std::cos(5 * t));
  }
  const std::vector<float> values = elementary_gpu(device(), function, arguments).value();
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double exact = elementary(function, double(arguments[i].x), double(arguments[i].y));
    const bool absolute = function == 1 || function == 2 || exact == 0;
    largest = std::max(largest, std::abs(double(values[i]) - exact) / (absolute ? 1 : std::abs(exact)));
  }
  ::testing::Test::RecordProperty("function_" + std::to_string(function), std::to_string(largest * 1e9));
  return largest;
}

TEST(FunctionsParity, BesselI0_OnTheDevice) { EXPECT_LT(largest_error(0, 0, 60), 4e-7); }
TEST(FunctionsParity, BesselI0FarOut_OnTheDevice) { EXPECT_LT(largest_error(0, 60, 1e6), 4e-7); }
TEST(FunctionsParity, SineAndCosine_OnTheDevice) {
  EXPECT_LT(largest_error(1, -100, 100), 1.5e-7);
  EXPECT_LT(largest_error(2, -100, 100), 1.5e-7);
  EXPECT_LT(largest_error(1, -8192, 8192), 1.5e-7);
}
TEST(FunctionsParity, ArcSineAndCosine_OnTheDevice) {
  EXPECT_LT(largest_error(3, -1, 1), 4e-7);
  EXPECT_LT(largest_error(4, -1, 0.9999), 4e-7);
}
TEST(FunctionsParity, ArcTangent_OnTheDevice) { EXPECT_LT(largest_error(5, -2, 2), 3e-7); }
TEST(FunctionsParity, Exponential_OnTheDevice) { EXPECT_LT(largest_error(6, -86, 88), 2.5e-7); }
TEST(FunctionsParity, OneMinusExponential_OnTheDevice) { EXPECT_LT(largest_error(7, 0, 20), 2.5e-7); }

TEST(PhiloxParity, Words_AreTheSameOnTheDevice) {
  constexpr uint count = 4096;
  const std::vector<std::uint32_t> words = random_words_gpu(device(), count).value();
  for (uint i = 0; i < count; ++i) {
    const PhiloxBlock block = philox(PhiloxBlock{i, 7 * i, 1, 2}, 3, i ^ 0x55);
    ASSERT_EQ(words[i], block.a ^ block.b ^ block.c ^ block.d) << i;
  }
}

}  // namespace
}  // namespace cuticle::hard_cases::functions_parity_test
