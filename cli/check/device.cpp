#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "cli/check/check.h"
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

const Verdict* find(const std::vector<Verdict>& verdicts, const std::string& id, Precision precision) {
  for (const Verdict& verdict : verdicts)
    if (verdict.id == id && verdict.precision == precision) return &verdict;
  return nullptr;
}

const char* word(State state) { return state == State::passed ? "pass" : state == State::failed ? "FAIL" : "-"; }

std::string cell(const std::vector<Verdict>& verdicts, const std::string& id, Precision precision) {
  const Verdict* verdict = find(verdicts, id, precision);
  return verdict != nullptr ? word(verdict->state) : "-";
}

std::size_t count(const std::vector<Verdict>& verdicts, State state) {
  return std::size_t(std::count_if(verdicts.begin(), verdicts.end(), [&](const Verdict& v) { return v.state == state; }));
}

void print_facts(const Found& found) {
  for (const auto& device : found.devices)
    fmt::print("device {}: {} ({})\n", device["index"].get<int>(), device["name"].text(), device["driver"].text());
  if (found.chosen.is_null()) return fmt::print("built without GPU: the catalogue runs in f32 and f64\n");
  fmt::print("chosen:\n");
  for (const auto& [name, value] : found.chosen.items()) fmt::print("  {:<26} {}\n", name, value.dump());
}

void print_verdicts(const std::vector<Verdict>& verdicts) {
  fmt::print("{:<34} {:<9} {:>5} {:>5} {:>5}\n", "case", "subject", "f32", "f64", "gpu");
  for (const Verdict& verdict : verdicts) {
    if (verdict.precision == Precision::f64)
      fmt::print("{:<34} {:<9} {:>5} {:>5} {:>5}\n", verdict.id, verdict.subject, cell(verdicts, verdict.id, Precision::f32),
                 word(verdict.state), cell(verdicts, verdict.id, Precision::gpu));
  }
  for (const Verdict& verdict : verdicts)
    if (verdict.state == State::failed)
      fmt::print("{} in {}: {} ({})\n", verdict.id, name_of(verdict.precision), verdict.detail, verdict.why);
  fmt::print("{} passed, {} failed\n", count(verdicts, State::passed), count(verdicts, State::failed));
}

Json to_json(const Found& found, const std::vector<Verdict>& verdicts) {
  Json cases = Json::list();
  for (const Verdict& verdict : verdicts) {
    if (verdict.state == State::not_applicable) continue;
    cases.push_back({{"id", verdict.id}, {"subject", verdict.subject}, {"why", verdict.why},
                     {"precision", name_of(verdict.precision)}, {"passed", verdict.state == State::passed}, {"detail", verdict.detail}});
  }
  return {{"devices", found.devices}, {"chosen", found.chosen}, {"passed", count(verdicts, State::passed)},
          {"failed", count(verdicts, State::failed)}, {"cases", cases}};
}

int check_device(const std::string& subject, Context& context) {
  const Result<Found> found = find_device(context);
  if (!found) return report(found.error());
  const auto verdicts = hard_cases::run_hard_cases(subject, found->device, *context.progress);
  if (!verdicts) return report(verdicts.error());
  if (context.json) {
    fmt::print("{}\n", to_json(*found, *verdicts).dump(2));
  } else {
    print_facts(*found);
    print_verdicts(*verdicts);
  }
  return count(*verdicts, State::failed) == 0 ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_device(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand("device", "show what Vulkan offers, and run the hard cases in float, double and on the device");
  auto subject = std::make_shared<std::string>();
  command->add_option("--subject", *subject, "only the cases about function, model, lut, strands, shadow or motion");
  command->callback([&context, subject] { context.action = [&context, subject] { return check_device(*subject, context); }; });
}

}  // namespace cuticle::cli
