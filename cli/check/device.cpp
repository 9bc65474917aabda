#include <algorithm>

#include <fmt/core.h>

#include "cli/check/check.h"
#include "core/file.h"
#include "core/instruction_set.h"
#include "core/json/json.h"
#include "tests/hard_cases/hard_case_runner.h"
#ifdef CUTICLE_HAS_GPU
#include "gpu/device.h"
#endif

namespace cuticle::cli {
namespace {

using hard_cases::Precision;
using hard_cases::State;
using hard_cases::Verdict;
/// What was found and chosen, as it will be printed.
struct Found {
  std::shared_ptr<gpu::Device> device;
  Json devices = Json::list();
  Json chosen;
};

#ifdef CUTICLE_HAS_GPU
Json facts(const gpu::DeviceInfo& info) {
  return {{"index", info.index},
          {"name", info.name},
          {"driver", info.driver},
          {"api_version", info.api_version},
          {"software", info.is_software},
          {"subgroup_size", info.subgroup_size},
          {"max_storage_buffer_bytes", info.max_storage_buffer_bytes},
          {"heap_bytes", info.heap_bytes},
          {"max_workgroup_invocations", info.max_workgroup_invocations},
          {"max_image_size", info.max_image_size},
          {"sample_counts", info.sample_counts},
          {"timestamps", info.timestamps},
          {"wide_lines", info.wide_lines}};
}

Result<Found> find_device(const Context& context) {
  Found found;
  for (const gpu::DeviceInfo& info : gpu::list_devices()) found.devices.push_back(facts(info));
  CUTICLE_ASSIGN(found.device, gpu::Device::open({.choice = context.device}));
  found.chosen = facts(found.device->info());
  return found;
}
#else
Result<Found> find_device(const Context&) { return Found{}; }
#endif

std::size_t count(const std::vector<Verdict>& verdicts, State state) {
  return std::size_t(
      std::count_if(verdicts.begin(), verdicts.end(), [&](const Verdict& v) { return v.state == state; }));
}

/// What the cases of one family gave, over all precisions.
struct Family {
  std::string name;
  std::size_t passed = 0, failed = 0, not_finite = 0;
  const Verdict *worst = nullptr, *slowest = nullptr;
};

void add_to(Family& family, const Verdict& verdict) {
  ++(verdict.state == State::passed ? family.passed : family.failed);
  family.not_finite += verdict.not_finite;
  if (family.worst == nullptr || verdict.used > family.worst->used) family.worst = &verdict;
  if (family.slowest == nullptr || verdict.seconds > family.slowest->seconds) family.slowest = &verdict;
}

std::vector<Family> families_of(const std::vector<Verdict>& verdicts) {
  std::vector<Family> families;
  for (const Verdict& verdict : verdicts) {
    if (verdict.state == State::not_applicable) continue;
    auto found = std::ranges::find(families, verdict.family, &Family::name);
    if (found == families.end()) found = families.insert(found, Family{.name = verdict.family});
    add_to(*found, verdict);
  }
  return families;
}

void print_facts(const Found& found) {
  for (const auto& device : found.devices)
    fmt::print("device {}: {} ({})\n", device["index"].get<int>(), device["name"].text(), device["driver"].text());
  if (found.chosen.is_null()) return fmt::print("built without GPU: the catalogue runs in f32 and f64\n");
  fmt::print("chosen:\n");
  for (const auto& [name, value] : found.chosen.items()) fmt::print("  {:<26} {}\n", name, value.dump());
}

std::string named(const Verdict& verdict) { return fmt::format("{} ({})", verdict.id, name_of(verdict.precision)); }

void print_verdicts(const std::vector<Verdict>& verdicts) {
  fmt::print("{:<14} {:>6} {:>6} {:>4}  {:<56} {}\n", "family", "passed", "failed", "NaN",
             "largest share of an allowed error", "slowest");
  for (const Family& family : families_of(verdicts))
    fmt::print("{:<14} {:>6} {:>6} {:>4}  {:<56} {:.2f} s, {}\n", family.name, family.passed, family.failed,
               family.not_finite,
               family.worst->used > 0 ? fmt::format("{:.2f} of {}", family.worst->used, named(*family.worst)) : "-",
               family.slowest->seconds, named(*family.slowest));
  for (const Verdict& verdict : verdicts)
    if (verdict.state == State::failed) fmt::print("{}: {} ({})\n", named(verdict), verdict.detail, verdict.why);
  fmt::print("{} passed, {} failed\n", count(verdicts, State::passed), count(verdicts, State::failed));
}

Json to_json(const Family& family) {
  return {{"family", family.name},
          {"passed", family.passed},
          {"failed", family.failed},
          {"not_finite", family.not_finite},
          {"largest_used", family.worst->used},
          {"largest_used_by", named(*family.worst)},
          {"slowest_seconds", family.slowest->seconds},
          {"slowest", named(*family.slowest)}};
}

Json to_json(const Verdict& verdict) {
  return {{"id", verdict.id},
          {"family", verdict.family},
          {"subject", verdict.subject},
          {"why", verdict.why},
          {"source", verdict.source},
          {"precision", name_of(verdict.precision)},
          {"passed", verdict.state == State::passed},
          {"detail", verdict.detail},
          {"used", verdict.used},
          {"seconds", verdict.seconds}};
}

/// The certificate: which machine, driver and build, and what every case gave there.
Json to_json(const Found& found, const std::vector<Verdict>& verdicts) {
  Json families = Json::list(), cases = Json::list();
  for (const Family& family : families_of(verdicts)) families.push_back(to_json(family));
  for (const Verdict& verdict : verdicts)
    if (verdict.state != State::not_applicable) cases.push_back(to_json(verdict));
  const Json build = {
      {"version", CUTICLE_VERSION},
      {"compiler", __VERSION__},
      {"instruction_set", name_of(widest(InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512))}};
  return {{"build", build},
          {"devices", found.devices},
          {"chosen", found.chosen},
          {"passed", count(verdicts, State::passed)},
          {"failed", count(verdicts, State::failed)},
          {"families", families},
          {"cases", cases}};
}

struct DeviceOptions {
  hard_cases::Choice choice;
  std::string certificate;
};

int check_device(const DeviceOptions& options, Context& context) {
  const Result<Found> found = find_device(context);
  if (!found) return report(found.error());
  const auto verdicts = hard_cases::run_hard_cases(options.choice, found->device, *context.progress);
  if (!verdicts) return report(verdicts.error());
  const Json certificate = to_json(*found, *verdicts);
  if (!options.certificate.empty()) {
    const auto written = write_text_file(options.certificate, certificate.dump(1) + "\n");
    if (!written) return report(written.error());
  }
  if (context.json) {
    fmt::print("{}\n", certificate.dump(2));
  } else {
    print_facts(*found);
    print_verdicts(*verdicts);
  }
  return count(*verdicts, State::failed) == 0 ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_device(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand(
      "device", "show what Vulkan offers, and run the hard cases in float, double and on the device");
  auto options = std::make_shared<DeviceOptions>();
  command->add_option("--family", options->choice.family,
                      "only the cases of one family, such as functions, marschner or drawing");
  command->add_flag("--full", options->choice.full, "run the cases that take seconds too");
  command->add_option("--certificate", options->certificate,
                      "write machine, driver, build and every result to this JSON file");
  command->callback(
      [&context, options] { context.action = [&context, options] { return check_device(*options, context); }; });
}

}  // namespace cuticle::cli
