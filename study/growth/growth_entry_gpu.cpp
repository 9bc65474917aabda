#include <algorithm>
#include <charconv>

#include <fmt/core.h>

#include "study/engine/split.h"
#include "study/growth/growth.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

/// Sizes up to `most`, each four times the one before.
std::vector<int> sizes_up_to(int most, int first) {
  std::vector<int> sizes;
  for (int size = first; size < most; size *= 4) sizes.push_back(size);
  sizes.push_back(most);
  return sizes;
}

Result<int> parse_most(const std::string& text) {
  int most = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), most);
  if (code != std::errc() || end != text.data() + text.size() || most < 1000 || most > 10000000)
    return usage_error(fmt::format("--most {}: a whole number in 1000 .. 10000000", text));
  return most;
}

Result<Group> grow(const std::string& part, const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request,
                   Progress& progress) {
  if (part == "frame") return frame_growth(device, request, progress);
  if (part == "solvers") return solver_growth(request, progress);
  if (part == "shadows") return shadow_growth(device, request, progress);
  if (part == "files") return file_growth(request, progress);
  return usage_error(fmt::format("--parts: unknown part '{}'", part), "known are: frame, solvers, shadows, files");
}

Result<Study> declare_growth(const StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const int most, parse_most(request.options.at("most")));
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  Study study{.name = "growth",
              .title = "From a few strands to a million",
              .question = "How do times grow with the number of strands?",
              .cost_label = "time",
              .wall_clock = !device->info().is_software,
              .device = device->info().name,
              .driver = device->info().driver};
  GrowthRequest growth{.strands = request.quick ? std::vector{250, 1000, 4000} : sizes_up_to(most, 5000),
                       .share = request.share,
                       .notes = &study.notes};
  if (request.quick) growth.width = 320, growth.height = 180, growth.frames = 1;
  for (const std::string& part : split_commas(request.options.at("parts"))) {
    CUTICLE_ASSIGN(study.groups.emplace_back(), grow(part, device, growth, progress));
  }
  return study;
}

}  // namespace

const StudyEntry& growth_entry() {
  static const StudyEntry entry{
      .name = "growth",
      .summary = "times of a frame's passes, solvers, shadow methods and strand files by the number of strands",
      .options = {{"most", "1000000", "strands of the largest size"},
                  {"parts", "frame,solvers,shadows,files", "measure these"}},
      .declare = declare_growth,
      .quick_seconds = 16,
      .seconds = 600};
  return entry;
}

}  // namespace cuticle::study
