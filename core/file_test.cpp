#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "core/mapped_file.h"

namespace cuticle::file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cuticle_file_test_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator())); }

  fs::path folder_;
};

TEST_F(FileTest, WriteThenRead_GivesTheSameBytes) {
  const std::string text("a\0b\r\nc", 6);
  ASSERT_TRUE(write_text_file(path("x.txt"), text));
  EXPECT_EQ(read_text_file(path("x.txt")).value(), text);
  EXPECT_EQ(read_file(path("x.txt")).value().size(), 6u);
}

TEST_F(FileTest, MappedFile_HasTheBytesAlsoWhenItIsReplacedMeanwhile) {
  ASSERT_TRUE(write_text_file(path("x.txt"), "old"));
  const auto bytes = map_file(path("x.txt"));
  ASSERT_TRUE(write_text_file(path("x.txt"), "newer"));
  ASSERT_EQ(bytes->span().size(), 3u);
  EXPECT_EQ(bytes->span()[0], std::byte('o'));
  ASSERT_TRUE(write_text_file(path("empty"), ""));
  EXPECT_TRUE(map_file(path("empty"))->span().empty());
  EXPECT_THAT(map_file(path("nowhere")).error().message, HasSubstr("nowhere"));
}

TEST_F(FileTest, WriteOverAFile_LeavesOneFileWithTheNewText) {
  ASSERT_TRUE(write_text_file(path("x.txt"), "a long old text"));
  ASSERT_TRUE(write_text_file(path("x.txt"), "new"));
  EXPECT_EQ(read_text_file(path("x.txt")).value(), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, WriterThatFailsHalfWay_LeavesTheOldFileAlone) {
  ASSERT_TRUE(write_text_file(path("x.png"), "old"));
  const Result<void> written = write_through_temporary(path("x.png"), [](const std::string& name) -> Result<void> {
    std::ofstream(name) << "half";
    return bad_input("the disk is full");
  });
  EXPECT_FALSE(written);
  EXPECT_EQ(read_text_file(path("x.png")).value(), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, TemporaryName_KeepsTheExtensionAndTheFolder) {
  ASSERT_TRUE(write_through_temporary(path("x.exr"), [&](const std::string& name) -> Result<void> {
    EXPECT_EQ(fs::path(name).extension(), ".exr");
    EXPECT_EQ(fs::path(name).parent_path(), folder_);
    EXPECT_NE(name, path("x.exr"));
    return write_text_file(name, "x");
  }));
}

TEST_F(FileTest, WriteIntoAMissingFolder_NamesTheFolder) {
  const Result<void> written = write_text_file(path("missing/x.txt"), "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(written.error().message, HasSubstr(path("missing")));
}

TEST_F(FileTest, ReadAMissingFile_NamesItAndTheReason) {
  const Result<std::string> text = read_text_file(path("absent.txt"));
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(text.error().message, HasSubstr("absent.txt"));
  EXPECT_THAT(text.error().message, HasSubstr("No such file"));
}

TEST_F(FileTest, ReadAFolder_IsRefused) { EXPECT_FALSE(read_file(folder_.string())); }

TEST_F(FileTest, MakeFolder_MakesParentsAndIsRepeatable) {
  ASSERT_TRUE(make_folder(path("a/b/c")));
  ASSERT_TRUE(make_folder(path("a/b/c")));
  EXPECT_TRUE(fs::is_directory(path("a/b/c")));
}

TEST_F(FileTest, MakeFolder_WhereAFileStands_IsRefused) {
  ASSERT_TRUE(write_text_file(path("a"), "x"));
  EXPECT_FALSE(make_folder(path("a")));
}

}  // namespace
}  // namespace cuticle::file_test
