#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/formats/vtp/vtp.h"

namespace cuticle::strands::vtp_format_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A strand of three vertices, one of a single vertex, one of two.
struct Sample {
  Groom groom;
  std::vector<glm::vec3> positions, velocities;
  std::vector<float> stretch;

  Sample() {
    groom.offsets = {0, 3, 4, 6};
    for (int i = 0; i < 6; ++i) {
      positions.emplace_back(0.1f * float(i), 1.f / 3.f, -1e-7f);
      velocities.emplace_back(float(i), 0.f, 1e20f);
      stretch.push_back(1 + 0.01f * float(i));
    }
  }
  std::string text() const { return format_vtp({&groom, positions, velocities, stretch}); }
};

/// The numbers of the named array.
std::vector<double> array_of(const std::string& text, const std::string& name) {
  const std::size_t at = text.find('>', text.find("Name=\"" + name + "\"")) + 1;
  std::istringstream stream(text.substr(at, text.find("</DataArray>", at) - at));
  std::vector<double> values;
  for (double value; stream >> value;) values.push_back(value);
  return values;
}

TEST(VtpFormat, Positions_ReadBackBitByBit) {
  const Sample sample;
  const std::vector<double> values = array_of(sample.text(), "position");
  ASSERT_EQ(values.size(), 18u);
  for (int i = 0; i < 18; ++i)
    EXPECT_EQ(float(values[std::size_t(i)]), sample.positions[std::size_t(i / 3)][i % 3]) << i;
}

TEST(VtpFormat, PointArrays_AreThoseNamed) {
  const std::string text = Sample().text();
  EXPECT_EQ(array_of(text, "velocity").size(), 18u);
  EXPECT_EQ(array_of(text, "stretch").size(), 6u);
  EXPECT_THAT(array_of(text, "strand_id"), ElementsAre(0, 0, 0, 1, 2, 2));
}

TEST(VtpFormat, TensionAndCurvature_AreThereWhenGiven) {
  const Sample sample;
  EXPECT_THAT(sample.text(), ::testing::Not(HasSubstr("tension")));
  const std::vector<float> numbers{0, 1, 2, 3, 4, 5};
  const std::string text = format_vtp({&sample.groom, sample.positions, sample.velocities, numbers, numbers, numbers});
  EXPECT_THAT(array_of(text, "tension"), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(array_of(text, "curvature").size(), 6u);
}

TEST(VtpFormat, ContactAndGuards_AreOfPointsAndOfLines) {
  const Sample sample;
  EXPECT_THAT(sample.text(), ::testing::Not(HasSubstr("CellData")));
  const std::vector<float> contact{0, 1, 2, 3, 4, -5};
  const std::vector<std::uint32_t> fired{1, 1, 0};
  StrandState state{&sample.groom, sample.positions, sample.velocities, sample.stretch};
  state.contact = contact;
  state.guard_fired = fired;
  const std::string text = format_vtp(state);
  EXPECT_THAT(array_of(text, "contact"), ElementsAre(0, 1, 2, 3, 4, -5));
  EXPECT_THAT(array_of(text, "guard_fired"), ElementsAre(1, 0)) << "the single vertex is no line";
}

TEST(VtpFormat, SingleVertexStrand_HasNoLine) {
  const std::string text = Sample().text();
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"6\" NumberOfLines=\"2\""));
  EXPECT_THAT(array_of(text, "connectivity"), ElementsAre(0, 1, 2, 4, 5));
  EXPECT_THAT(array_of(text, "offsets"), ElementsAre(3, 5));
}

TEST(VtpFormat, Size_IsWithinTheAnnouncedBound) {
  Sample sample;
  for (glm::vec3& v : sample.velocities) v = glm::vec3(-1.23456789e-30f);
  EXPECT_LE(sample.text().size(), vtp_bytes_at_most(sample.groom));
}

TEST(VtpFormat, EmptyGroom_IsAnEmptyPiece) {
  const Groom none;
  EXPECT_THAT(format_vtp({&none, {}, {}, {}}), HasSubstr("NumberOfPoints=\"0\" NumberOfLines=\"0\""));
}

TEST(PvdFormat, Series_ListsTimesAndFiles) {
  const std::vector<SeriesMember> members = {{0, "state_0000.vtp"}, {1.0 / 30, "state_0001.vtp"}};
  const std::string text = format_pvd(members);
  EXPECT_THAT(text, HasSubstr("timestep=\"0\" part=\"0\" file=\"state_0000.vtp\""));
  EXPECT_THAT(text, HasSubstr("timestep=\"0.0333333333\" part=\"0\" file=\"state_0001.vtp\""));
}

}  // namespace
}  // namespace cuticle::strands::vtp_format_test
