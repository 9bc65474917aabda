// `cuticle study all`: every registered study, one after the other; what is complete is not run again.
#include <chrono>
#include <filesystem>

#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/run.h"
#include "cli/study/study.h"
#include "core/file.h"
#include "study/registry/entries.h"

namespace cuticle::cli {
namespace {

struct AllOptions {
  std::string out, only;
  bool quick = false;
};

/// Those of --only, else all that take part. Error: usage, for an unknown name.
Result<std::vector<const study::StudyEntry*>> chosen(const AllOptions& options) {
  if (options.only.empty()) return std::vector(study::studies().begin(), study::studies().end());
  std::vector<const study::StudyEntry*> entries;
  for (const std::string& name : split_list(options.only)) {
    CUTICLE_ASSIGN(entries.emplace_back(), study::find_study(study::studies(), name));
  }
  return entries;
}

double expected_seconds(const study::StudyEntry& entry, bool quick) {
  return quick ? entry.quick_seconds : entry.seconds;
}

/// What tells a complete result from one of another request or build.
std::string request_text(const study::StudyRequest& request) {
  Json options = Json::object();
  for (const auto& [name, value] : request.options) options[name] = value;
  return Json{{"version", CUTICLE_VERSION}, {"quick", request.quick}, {"options", options}}.dump(1) + "\n";
}

bool is_complete(const std::string& folder, const study::StudyRequest& request) {
  const auto known = read_text_file(folder + "/request.json");
  return known && *known == request_text(request) && std::filesystem::exists(folder + "/result.json");
}

/// Remaining time: what the rest takes on the machine where it was measured, times how much slower this one was so far.
class Clock {
 public:
  explicit Clock(double expected) : expected_(expected) {}
  double remaining() const {
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return expected_ * (done_ > 0 ? spent / done_ : 1);
  }
  void finish(double expected, bool was_run) {
    expected_ -= expected;
    if (was_run) done_ += expected;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double expected_, done_ = 0;
};

int study_all(const AllOptions& options, Context& context) {
  const auto entries = chosen(options);
  if (!entries) return report(entries.error());
  double expected = 0;
  for (const study::StudyEntry* entry : *entries) expected += expected_seconds(*entry, options.quick);
  Clock clock(expected);
  for (const study::StudyEntry* entry : *entries) {
    const std::string folder = options.out + "/" + entry->name;
    const study::StudyRequest request = default_request(*entry, options.quick, context.device);
    const bool is_known = is_complete(folder, request);
    context.progress->message(fmt::format("{}{}; about {:.0f} s remain", entry->name,
                                          is_known ? ": complete, not run again" : "", clock.remaining()));
    if (!is_known) {
      const auto done = run_registered(*entry, request, folder, *context.progress);
      if (!done) return report(done.error());
      const auto noted = write_text_file(folder + "/request.json", request_text(request));
      if (!noted) return report(noted.error());
    }
    clock.finish(expected_seconds(*entry, options.quick), !is_known);
  }
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study_all(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand("all", "every study, and one page for all; goes on where it was stopped");
  auto options = std::make_shared<AllOptions>();
  command->add_option("--out", options->out, "folder to write, one folder in it for each study")->required();
  command->add_option("--only", options->only, "studies, a,b,c; without it all");
  command->add_flag("--quick", options->quick, "each study in its quick form");
  command->callback([&context, options] {
    context.action = [&context, options] { return in_folder(options->out, [&] { return study_all(*options, context); }); };
  });
}

}  // namespace cuticle::cli
