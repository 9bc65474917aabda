// Every model of the gallery is named by what is wrong with it, and the whole one passes.
#include "study/model_check/gallery/gallery.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace cuticle::study::model_check::gallery_test {
namespace {

class Gallery : public testing::TestWithParam<Cause> {};
INSTANTIATE_TEST_SUITE_P(Exhibits, Gallery, testing::ValuesIn(gallery().begin(), gallery().end()),
                         [](const auto& at) { return std::string(name_of(at.param)); });

std::string table(std::span<const Verdict> verdicts) {
  std::string text;
  for (const Verdict& v : verdicts)
    text += std::string(v.check) + (v.state == State::failed ? " FAILED: " : ": ") + v.words + "\n";
  return text;
}

TEST_P(Gallery, Exhibit_IsNamedByItsMistake) {
  const Options options{.quick = true};
  const Subject subject = exhibit(GetParam());
  const std::vector<Verdict> verdicts = run_checks(subject, options, silent_progress());
  const Diagnosis diagnosis = diagnose(subject, verdicts, options);
  EXPECT_EQ(name_of(diagnosis.cause), name_of(GetParam())) << diagnosis.words << "\n" << table(verdicts);
  const bool failed =
      std::any_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.state == State::failed; });
  EXPECT_EQ(failed, GetParam() != Cause::none) << table(verdicts);
}

}  // namespace
}  // namespace cuticle::study::model_check::gallery_test
