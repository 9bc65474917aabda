#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/json/json.h"
#include "core/trace.h"

namespace cuticle::trace_test {
namespace {

std::string temporary_path() {
  return (std::filesystem::temp_directory_path() / ("cuticle_trace_test_" + std::to_string(::getpid()) + ".json")).string();
}

Json written(const Trace& trace) {
  const std::string path = temporary_path();
  EXPECT_TRUE(trace.write(path));
  const Json document = Json::parse(read_text_file(path).value()).value();
  std::filesystem::remove(path);
  return document;
}

std::size_t count_phase(const Json& document, const char* phase) {
  std::size_t count = 0;
  for (const auto& event : document["traceEvents"]) count += event["ph"] == phase;
  return count;
}

TEST(Trace, SpansOfTwoTracks_AreWrittenAsCompleteEventsWithTrackNames) {
  Trace trace;
  trace.add({"bake \"M\"\n", "cpu", 1.5, 2.5});
  trace.add({"shadow", "gpu", 2.0, 1.0});
  const Json document = written(trace);
  EXPECT_EQ(count_phase(document, "X"), 2u);
  EXPECT_EQ(count_phase(document, "M"), 2u);
  EXPECT_EQ(document["traceEvents"][1]["name"], "bake \"M\"\n");
  EXPECT_EQ(document["traceEvents"][1]["dur"], 2.5);
}

TEST(Trace, WithoutSpans_IsStillValid) { EXPECT_TRUE(written(Trace())["traceEvents"].empty()); }

TEST(ScopedSpan, AroundWork_LastsAsLongAsTheWork) {
  Trace trace;
  {
    const ScopedSpan span(&trace, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  ASSERT_EQ(trace.spans().size(), 1u);
  EXPECT_GE(trace.spans()[0].duration_us, 3000);
  EXPECT_EQ(trace.spans()[0].track, "cpu");
}

TEST(ScopedSpan, WithoutATrace_DoesNothing) { const ScopedSpan span(nullptr, "nothing"); }

TEST(Trace, ManyThreads_LoseNoSpan) {
  Trace trace;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 20000; ++i) const ScopedSpan span(&trace, "work");
      });
  }
  EXPECT_EQ(trace.spans().size(), 80000u);
}

}  // namespace
}  // namespace cuticle::trace_test
