#include "bsdf/measured/measured.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::bsdf::measured_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double k_degree = std::numbers::pi / 180;

TEST(Gantry, CornersOfTheProjectsPage_AreOurAngles) {
  // theta 40 .. 80 is 50 .. 10 degrees, phi 70 .. 290 is -20 .. 200.
  const auto fibre = parse_gantry("70 40 1\n290 80 2\r\n", "f.txt", {-0.5});
  ASSERT_TRUE(fibre.ok());
  ASSERT_EQ(fibre->directions.size(), 2u);
  EXPECT_NEAR(fibre->directions[0].theta_i, 50 * k_degree, 1e-15);
  EXPECT_NEAR(fibre->directions[0].phi, -20 * k_degree, 1e-15);
  EXPECT_NEAR(fibre->directions[1].theta_i, 10 * k_degree, 1e-15);
  EXPECT_NEAR(fibre->directions[1].phi, 200 * k_degree, 1e-14);
  EXPECT_EQ(fibre->directions[1].theta_o, -0.5);
  EXPECT_EQ(fibre->directions[1].value.y, 2);
}

TEST(Gantry, QuestionMark_IsAPlaceWithoutAValue) {
  const auto fibre = parse_gantry("70 40 ?\n\n71 40 3e-2\n", "f.txt", {});
  ASSERT_TRUE(fibre.ok());
  EXPECT_EQ(fibre->directions.size(), 1u);
  EXPECT_EQ(fibre->unmeasured, 1u);
}

TEST(Gantry, TextThatIsWritten_ReadsBack) {
  const std::vector<MeasuredDirection> written = {{0.2, -0.5, 0.1, glm::dvec3(0.123456789012345678)},
                                                  {50 * k_degree, -0.5, -20 * k_degree, glm::dvec3(NAN)},
                                                  {10 * k_degree, -0.5, 200 * k_degree, glm::dvec3(1e-9)}};
  const auto read = parse_gantry(gantry_text(written), "f.txt", {-0.5});
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->directions.size(), 2u);
  EXPECT_EQ(read->unmeasured, 1u);
  for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 2)}) {
    EXPECT_NEAR(read->directions[std::size_t(a)].theta_i, written[std::size_t(b)].theta_i, 1e-14);
    EXPECT_NEAR(read->directions[std::size_t(a)].phi, written[std::size_t(b)].phi, 1e-14);
    EXPECT_EQ(read->directions[std::size_t(a)].value.x, written[std::size_t(b)].value.x);
  }
}

struct Damage {
  const char *text, *words;
};
class DamagedGantry : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(All, DamagedGantry,
                         testing::Values(Damage{"", "no measured value"}, Damage{"70 40 ?\n", "no measured value"},
                                         Damage{"70 40\n", "line 1: value '' is not a number"},
                                         Damage{"70 40 1\n70 x 1\n", "line 2: theta 'x'"},
                                         Damage{"70 40 1 9\n", "line 1: '9' after the value"},
                                         Damage{"70 181 1\n", "theta 181 is outside 0 .. 180"},
                                         Damage{"1e9 40 1\n", "phi"}, Damage{"70 40 nan\n", "line 1: value nan"},
                                         Damage{"70 40 inf\n", "line 1: value inf"}, Damage{"70 40 ?x\n", "'?x'"},
                                         Damage{"phi theta value\n", "line 1: phi 'phi'"}));
TEST_P(DamagedGantry, Text_IsRefusedWithItsLine) {
  const auto fibre = parse_gantry(GetParam().text, "f.txt", {});
  ASSERT_FALSE(fibre.ok());
  EXPECT_EQ(fibre.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(fibre.error().message, AllOf(HasSubstr("f.txt"), HasSubstr(GetParam().words)));
}

TEST(MeasuredCsv, Rows_AreReadInRadians) {
  const auto fibre = parse_measured_csv("theta_i,theta_o,phi,value,sigma\n30,-35,180,0.5,0.01\n", "f.csv");
  ASSERT_TRUE(fibre.ok());
  EXPECT_TRUE(fibre->one_number && fibre->sigma_known);
  EXPECT_NEAR(fibre->directions[0].theta_o, -35 * k_degree, 1e-15);
  EXPECT_EQ(fibre->directions[0].sigma, 0.01);
  const auto coloured = parse_measured_csv("theta_i,theta_o,phi,r,g,b\n30,-35,180,1,2,3\n", "f.csv");
  ASSERT_TRUE(coloured.ok());
  EXPECT_FALSE(coloured->one_number || coloured->sigma_known);
  EXPECT_EQ(coloured->directions[0].value, glm::dvec3(1, 2, 3));
}

class DamagedCsv : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(
    All, DamagedCsv,
    testing::Values(Damage{"theta_i,theta_o,phi\n1,2,3", "one column value, or r, g and b"},
                    Damage{"theta_i,theta_o,phi,value,r,g,b\n1,2,3,4,5,6,7", "one column value, or r, g and b"},
                    Damage{"theta_i,phi,value\n1,2,3", "no column theta_o"},
                    Damage{"theta_i,theta_o,phi,value,sigma\n1,2,3,4,0", "line 2, column sigma: 0"},
                    Damage{"theta_i,theta_o,phi,value\n1,2,3,4\n1,2,3", "line 3: 3 cells"}));
TEST_P(DamagedCsv, Text_IsRefusedWithItsPlace) {
  const auto fibre = parse_measured_csv(GetParam().text, "f.csv");
  ASSERT_FALSE(fibre.ok());
  EXPECT_THAT(fibre.error().message, AllOf(HasSubstr("f.csv"), HasSubstr(GetParam().words)));
}

std::vector<std::byte> table(std::vector<std::int32_t> counts, const std::vector<double>& values) {
  std::vector<std::byte> bytes(counts.size() * 4 + values.size() * 8);
  std::memcpy(bytes.data(), counts.data(), counts.size() * 4);
  if (!values.empty()) std::memcpy(bytes.data() + counts.size() * 4, values.data(), values.size() * 8);
  return bytes;
}

TEST(Slices, Cells_StandForTheirMiddles) {
  const auto fibre =
      parse_slices(table({2, 1, 3}, {1, 2, 3, 4, 5, 6, 10, 20, 30, 40, 50, 60, 7, 7, -1, 7, 7, 7}), "f.bin");
  ASSERT_TRUE(fibre.ok());
  ASSERT_EQ(fibre->directions.size(), 5u);
  EXPECT_EQ(fibre->unmeasured, 1u);
  EXPECT_NEAR(fibre->directions[0].theta_i, -45 * k_degree, 1e-15);
  EXPECT_NEAR(fibre->directions[0].theta_o, 0, 1e-15);
  EXPECT_NEAR(fibre->directions[1].phi, 90 * k_degree, 1e-15);
  EXPECT_EQ(fibre->directions[4].value, glm::dvec3(6, 60, 7));
}

TEST(Slices, DamagedTable_IsRefusedWithItsByte) {
  const auto words = [](const std::vector<std::byte>& bytes) { return parse_slices(bytes, "f.bin").error().message; };
  EXPECT_THAT(words({}), HasSubstr("f.bin: 0 bytes"));
  EXPECT_THAT(words(table({1, -1, 1}, {})), HasSubstr("byte 4: count -1"));
  EXPECT_THAT(words(table({1440, 1440, 1440}, {1})), HasSubstr("20 bytes"));
  EXPECT_THAT(words(table({1, 1, 1}, {1, NAN, 1})), HasSubstr("byte 20: nan"));
  EXPECT_THAT(words(table({1, 1, 1}, {-1, -1, -1})), HasSubstr("no measured value"));
}

TEST(ReadMeasured, MissingFileAndUnknownFormat_AreRefusedByName) {
  EXPECT_THAT(read_measured("/nowhere/f.csv", "", {}).error().message, HasSubstr("/nowhere/f.csv"));
  EXPECT_THAT(read_measured("f.txt", "merl", {}).error().message, HasSubstr("'merl'"));
}

}  // namespace
}  // namespace cuticle::bsdf::measured_test
