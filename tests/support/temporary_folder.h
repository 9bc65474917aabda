#pragma once
// A folder of a test's own, gone when the test ends.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace cuticle::tests {

class TemporaryFolder : public testing::Test {
 protected:
  TemporaryFolder() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::string safe = name;
    for (char& c : safe)
      if (c == '/') c = '_';
    folder_ = std::filesystem::temp_directory_path() / ("cuticle_" + safe + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~TemporaryFolder() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::filesystem::path folder_;
};

}  // namespace cuticle::tests
