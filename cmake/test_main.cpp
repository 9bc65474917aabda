// The main of a test program. A program of several test files runs the tests of the file by whose name it is called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

std::string stem_of(const char* path) { return std::filesystem::path(path).stem().string(); }

// A filter that names every test written in FILE.cpp; empty when there is none.
std::string tests_of_file(const std::string& file) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (stem_of(test.file()) == file) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string file = stem_of(argv[0]);
  testing::InitGoogleMock(&argc, argv);
  if (testing::GTEST_FLAG(filter) == "*" && file.ends_with("_test")) {
    testing::GTEST_FLAG(filter) = tests_of_file(file);
    if (testing::GTEST_FLAG(filter).empty()) {
      std::fprintf(stderr, "no test was written in %s.cpp\n", file.c_str());
      return 1;
    }
  }
  return RUN_ALL_TESTS();
}
