#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/file.h"
#include "core/memory_limit.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::memory_limit_test {
namespace {

using ::testing::HasSubstr;

TEST(ProductWithin, NoFactors_CountOne) {
  EXPECT_EQ(product_within(1, {}), 1u);
  EXPECT_FALSE(product_within(0, {}));
}

TEST(ProductWithin, Overflow_IsMoreThanTheMost) {
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max(), half = std::uint64_t(1) << 32;
  EXPECT_FALSE(product_within(most, {half, half}));
  EXPECT_EQ(product_within(most, {half, half - 1}), half * (half - 1));
  EXPECT_EQ(product_within(most, {7, 0, 3}), 0u);
}

TEST(ParseMemory, Units_ArePowersOf1024) {
  EXPECT_EQ(parse_memory("512M").value(), 512u << 20);
  EXPECT_EQ(parse_memory("8G").value(), std::uint64_t(8) << 30);
  for (const char* text : {"", "M", "-1G", "1M", "8GB", "99999999999999T", "1e9"})
    EXPECT_EQ(parse_memory(text).error().kind, ErrorKind::usage) << text;
}

class WithLimit : public tests::TemporaryFolder {
 protected:
  WithLimit() { set_memory_limit(64u << 20); }
  ~WithLimit() override { set_memory_limit(before_); }
  std::uint64_t before_ = memory_limit();
};

TEST_F(WithLimit, MoreThanAllowed_SaysBothSizes) {
  EXPECT_TRUE(require_memory("a picture", {1024, 1024, 64}));
  const Result<void> refused = require_memory("a picture", {1024, 1024, 65});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(refused.error().message, HasSubstr("a picture needs 65 MiB, allowed 64 MiB"));
}

TEST_F(WithLimit, FileThatIsLonger_IsRefusedBeforeItIsRead) {
  ASSERT_TRUE(write_text_file(path("long"), ""));
  ASSERT_EQ(::truncate(path("long").c_str(), off_t(1) << 40), 0);
  EXPECT_THAT(read_file(path("long")).error().message, HasSubstr("1048576 MiB"));
}

TEST_F(WithLimit, DeviceWithoutEnd_IsRefused) {
  EXPECT_THAT(read_file("/dev/zero").error().message, HasSubstr("allowed 64 MiB"));
}

TEST_F(WithLimit, FileOfNoStatedLength_IsReadWhole) {
  EXPECT_THAT(read_text_file("/proc/self/status").value(), HasSubstr("Umask"));
}

}  // namespace
}  // namespace cuticle::memory_limit_test
