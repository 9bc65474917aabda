#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/file.h"
#include "core/output_file.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::output_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OutputFile : public tests::TemporaryFolder {
 protected:
  static mode_t mode_of(const std::string& path) {
    struct stat status {};
    ::stat(path.c_str(), &status);
    return status.st_mode & 07777;
  }
  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(path("")), fs::directory_iterator()));
  }
};

TEST_F(OutputFile, Replaced_KeepsItsMode) {
  ASSERT_TRUE(write_text_file(path("x"), "old"));
  for (const mode_t mode : {0600, 0640, 0755}) {
    ::chmod(path("x").c_str(), mode);
    ASSERT_TRUE(write_text_file(path("x"), "new"));
    EXPECT_EQ(mode_of(path("x")), mode);
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFile, New_HasTheModeOfTheUmask) {
  const mode_t before = ::umask(027);
  EXPECT_TRUE(write_text_file(path("x"), "new"));
  ::umask(before);
  EXPECT_EQ(mode_of(path("x")), mode_t(0640));
}

TEST_F(OutputFile, Link_IsFollowedAndStays) {
  fs::create_directory(path("there"));
  ASSERT_TRUE(write_text_file(path("there/x"), "old"));
  fs::create_symlink("there/x", path("link"));
  fs::create_symlink("there/new", path("dangling"));
  ASSERT_TRUE(write_text_file(path("link"), "new"));
  ASSERT_TRUE(write_text_file(path("dangling"), "made"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_text_file(path("there/x")).value(), "new");
  EXPECT_EQ(read_text_file(path("there/new")).value(), "made");
}

TEST_F(OutputFile, LinksInACircle_AreRefused) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  const Result<void> written = write_text_file(path("a"), "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFile, Device_IsWrittenTo) {
  ASSERT_TRUE(write_text_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(write_text_file("/dev/full", "x").error().message, HasSubstr("No space left"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFile, Pipe_IsWrittenTo) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = read_text_file(path("pipe")).value(); });
  EXPECT_TRUE(write_text_file(path("pipe"), "through the pipe"));
  reader.join();
  EXPECT_EQ(got, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(OutputFile, SocketAndFolder_AreRefusedAndStay) {
  const int number = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  path("s").copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_THAT(write_text_file(path("s"), "x").error().message, HasSubstr("neither a file"));
  EXPECT_TRUE(fs::is_socket(path("s")));
  ::close(number);
  EXPECT_THAT(write_text_file(path(""), "x").error().message, HasSubstr("folder"));
}

TEST_F(OutputFile, NameThatAnAttackerGuessed_IsNotUsed) {
  ASSERT_TRUE(write_text_file(path("victim"), "mine"));
  fs::create_symlink(path("victim"), path(".x." + std::to_string(::getpid()) + "-0.txt"));
  ASSERT_TRUE(write_text_file(path("x.txt"), "new"));
  const Result<Temporary> a = Temporary::file(path(""), ".txt"), b = Temporary::file(path(""), ".txt");
  ASSERT_TRUE(a && b);
  EXPECT_NE(a->path(), b->path());
  EXPECT_EQ(mode_of(a->path()), mode_t(0600));
  EXPECT_EQ(read_text_file(path("victim")).value(), "mine");
}

TEST_F(OutputFile, Temporary_GoesWithTheObjectAndWithTheProcess) {
  {
    const auto file = Temporary::file(path(""), ".txt");
    const auto folder = Temporary::folder(path(""));
    ASSERT_TRUE(file && folder);
    EXPECT_EQ(mode_of(folder->path()), mode_t(0700));
    ASSERT_TRUE(write_text_file(folder->path() + "/inside", "x"));
    EXPECT_EQ(files(), 2u);
  }
  EXPECT_EQ(files(), 0u);
  const auto file = Temporary::file(path(""), ".txt");
  remove_temporaries();
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFile, TemporaryFolderThatIsAbsent_IsAnError) {
  const std::string before = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "/tmp";
  ::setenv("TMPDIR", path("absent").c_str(), 1);
  const Result<std::string> folder = temporary_folder();
  ::setenv("TMPDIR", before.c_str(), 1);
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("TMPDIR"));
}

TEST_F(OutputFile, MovedIntoPlace_FollowsTheSameRules) {
  ASSERT_TRUE(write_text_file(path("target"), "old"));
  ::chmod(path("target").c_str(), 0600);
  fs::create_symlink("target", path("link"));
  fs::create_directory(path("staged"));
  ASSERT_TRUE(write_text_file(path("staged/x"), "new"));
  ASSERT_TRUE(move_into_place(path("staged/x"), path("link")));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read_text_file(path("target")).value(), "new");
  EXPECT_EQ(mode_of(path("target")), mode_t(0600));
}

}  // namespace
}  // namespace cuticle::output_file_test
