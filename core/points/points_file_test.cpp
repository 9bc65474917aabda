#include "core/points/points_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::points_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr PointColumn k_columns[] = {{"theta_i", -90, 90, "deg"}, {"phi", -360, 360, "deg"}};

TEST(PointsFile, Rows_ComeInTheOrderOfTheFile) {
  const auto table = parse_points("phi, theta_i\r\n1, 2\n\n-3e1,4.5", "p.csv", k_columns);
  ASSERT_TRUE(table.ok());
  EXPECT_THAT(table->columns, ElementsAre(1u, 0u));
  EXPECT_THAT(table->rows, ElementsAre(ElementsAre(1, 2), ElementsAre(-30, 4.5)));
}

struct Damage {
  const char* text;
  const char* words;
};
class DamagedPoints : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(
    All, DamagedPoints,
    testing::Values(Damage{"", "no rows"}, Damage{"phi\n", "no rows"}, Damage{"phj\n1", "line 1: unknown column 'phj'"},
                    Damage{"phi,phi\n1,1", "'phi' is given twice"}, Damage{"phi\n1,2", "line 2: 2 cells"},
                    Damage{"phi\n1\nnan", "line 3, column phi: nan"}, Damage{"phi\ninf", "line 2, column phi: inf"},
                    Damage{"phi\n1x", "'1x' is not a number"}, Damage{"theta_i\n91", "91 is outside -90 .. 90 deg"},
                    Damage{"phi,theta_i\n1,", "line 2, column theta_i: ''"}));
TEST_P(DamagedPoints, Text_IsRefusedWithItsPlace) {
  const auto table = parse_points(GetParam().text, "p.csv", k_columns);
  ASSERT_FALSE(table.ok());
  EXPECT_EQ(table.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(table.error().message, AllOf(HasSubstr("p.csv"), HasSubstr(GetParam().words)));
}

TEST(PointsFile, UnknownColumn_OffersTheNearest) {
  EXPECT_THAT(parse_points("theta_j\n1", "p.csv", k_columns).error().hint, HasSubstr("theta_i"));
}

TEST(PointsFile, Missing_IsRefusedByName) {
  EXPECT_THAT(read_points("/nowhere/p.csv", k_columns).error().message, HasSubstr("/nowhere/p.csv"));
}

}  // namespace
}  // namespace cuticle::points_file_test
