#include <filesystem>

#include <fmt/core.h>

#include "core/output_file.h"
#include "sim/solver.h"
#include "strands/formats/formats.h"
#include "study/growth/measured.h"

namespace cuticle::study {
namespace {

constexpr int k_strand_vertices = 16;  ///< of a strand

Result<double> solver_seconds(const sim::Effect& solver, const strands::Groom& groom, int frames) {
  CUTICLE_ASSIGN(const sim::Effect* gravity, sim::find_effect("gravity"));
  const sim::EffectBlocks effects{{"gravity", registry::default_values(gravity->entry.parameters)}};
  CUTICLE_ASSIGN(const auto running, solver.create(groom, registry::default_values(solver.entry.parameters), effects));
  CUTICLE_TRY(running->advance({}));
  double best = 1e30;
  for (int k = 0; k < frames; ++k) {
    const double start = processor_seconds();
    CUTICLE_TRY(running->advance({}));
    best = std::min(best, processor_seconds() - start);
    if (best > k_slow) break;
  }
  return best;
}

struct FileSeconds {
  double write = 0, read = 0;
};
Result<FileSeconds> file_seconds(const std::string& path, const strands::Groom& groom) {
  FileSeconds seconds;
  const double start = processor_seconds();
  CUTICLE_TRY(strands::write_groom(path, groom));
  seconds.write = processor_seconds() - start;
  CUTICLE_TRY(strands::read_groom(path, {.metres_per_unit = 1}));
  seconds.read = processor_seconds() - start - seconds.write;
  return seconds;
}

}  // namespace

Result<Group> solver_growth(const GrowthRequest& request, Progress& progress) {
  Group group = group_of_times("solvers", "Solvers on the CPU: a frame of 1/60 s, processor time");
  for (const int strands : request.strands) {
    const strands::Groom groom = ball_of_hair(strands, k_strand_vertices);
    for (const sim::Effect* solver : sim::effects()) {
      if (!solver->create || solver->acts_on_fins) continue;
      progress.message(fmt::format("{} of {} strands", solver->entry.name, strands));
      const auto seconds = solver_seconds(*solver, groom, request.frames);
      seconds ? add_time(group, std::string(solver->entry.name), strands, *seconds)
              : note_refusal(request, solver->entry.name, strands, seconds.error());
    }
  }
  return group;
}

Result<Group> file_growth(const GrowthRequest& request, Progress& progress) {
  Group group = group_of_times("files", "Strand files: writing and reading, processor time");
  CUTICLE_ASSIGN(const std::string parent, temporary_folder());
  CUTICLE_ASSIGN(const Temporary folder, Temporary::folder(parent));
  for (const int strands : request.strands) {
    const strands::Groom groom = ball_of_hair(strands, k_strand_vertices);
    for (const strands::Format* format : strands::formats()) {
      if (!format->format) continue;
      progress.message(fmt::format(".{} of {} strands", format->extensions.front(), strands));
      const std::string path = fmt::format("{}/hair.{}", folder.path(), format->extensions.front());
      const auto seconds = file_seconds(path, groom);
      std::filesystem::remove(path);
      if (seconds) {
        add_time(group, fmt::format("write .{}", format->extensions.front()), strands, seconds->write);
        add_time(group, fmt::format("read .{}", format->extensions.front()), strands, seconds->read);
      } else {
        note_refusal(request, format->name, strands, seconds.error());
      }
    }
  }
  return group;
}

}  // namespace cuticle::study
