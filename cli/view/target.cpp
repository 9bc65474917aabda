#include "cli/view/view.h"
#include "core/file.h"

namespace cuticle::cli {

void add_target_options(CLI::App& command, ViewOptions& options, bool has_frames) {
  command.add_option("--screenshot", options.target.screenshot, "write a PNG and exit instead of opening a window");
  command.add_option("--movie", options.target.movie,
                     has_frames ? "FILE.ogv, or a folder for numbered PNG files: the frames of the run, or a turn"
                                : "FILE.ogv, or a folder for numbered PNG files: a turn about the view");
  command.add_flag("--turntable", options.target.turntable, "the movie turns the view once");
  command.add_option("--turn-frames", options.target.turn_frames, "frames of a whole turn")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  command.add_option("--fps", options.target.frames_per_second, "frames per second of the movie")
      ->check(CLI::Range(1, 240))
      ->capture_default_str();
  command.add_option("--size", options.size, "width and height in pixels (1400 900)")
      ->expected(2)
      ->check(CLI::Range(64, 8192));
  command.add_option("--export", options.files,
                     "write what is shown into a folder, as VTK XML files and CSV (needs no VTK)");
}

Result<glm::dvec3> parse_vector(const std::string& name, const std::string& text) {
  CUTICLE_ASSIGN(const std::vector<double> numbers, parse_numbers(name, text));
  if (numbers.size() != 3) return usage_error(name + ": '" + text + "' is not x,y,z", name + " 0.5,1,0.6");
  return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

Result<void> show_or_write(const ViewOptions& options, const std::function<Result<void>(const std::string&)>& write,
                           const std::function<Result<void>(const viz::Views&, const viz::ViewTarget&)>& show) {
  viz::ViewTarget target = options.target;
  target.size = {options.size[0], options.size[1]};
  target.export_folder = options.files;
  if (target.turntable && target.movie.empty())
    return usage_error("--turntable needs a movie to go to", "--movie turn.ogv --turntable");
  if (!options.files.empty()) CUTICLE_TRY(write(options.files));
  if (!options.files.empty() && target.is_window()) return {};
  CUTICLE_ASSIGN(const viz::Views* views, viz::load_views());
  return show(*views, target);
}

}  // namespace cuticle::cli
