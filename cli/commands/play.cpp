#include "cli/command.h"

#ifdef CUTICLE_HAS_PLAY
#include <fmt/core.h>

#include "core/json/json.h"
#include "play/window.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_PLAY
namespace {

struct PlayOptions {
  std::string scene, method, frames = "0:239";
  play::WindowOptions window;
};

Json to_json(const glm::dvec3& place) { return Json{{"x", place.x}, {"y", place.y}, {"z", place.z}}; }

Json to_json(const std::vector<play::ControlPlace>& controls) {
  Json list = Json::list();
  for (const play::ControlPlace& control : controls)
    list.push_back({{"name", control.name},
                    {"x", control.x},
                    {"y", control.y},
                    {"width", control.width},
                    {"height", control.height}});
  return list;
}

void print(const play::Session& session, const play::WindowReport& report) {
  const Json json = {{"pictures", report.pictures},
                     {"frame", session.frame()},
                     {"paused", session.is_paused()},
                     {"method", session.scene().render_method},
                     {"camera_position_m", to_json(session.camera().position)},
                     {"camera_target_m", to_json(session.camera().target)},
                     {"material", Json::parse(registry::to_json(session.scene().material.model.values)).value()},
                     {"frame_ms", session.cost().frame_ms},
                     {"change_ms", session.cost().change_ms},
                     {"controls", to_json(report.controls)}};
  fmt::print("{}\n", json.dump(2));
}

Result<void> run_play(const PlayOptions& options, Context& context) {
  CUTICLE_ASSIGN(const auto frames, parse_frames(options.frames));
  CUTICLE_ASSIGN(scene::Scene scene, scene::load_scene(options.scene, plan::catalogue()));
  if (!options.method.empty()) scene.render_method = options.method;
  CUTICLE_ASSIGN(auto device, gpu::Device::open({.choice = context.device}));
  const play::FrameRange loop{frames.first, frames.second};
  CUTICLE_ASSIGN(const auto session, play::Session::create(std::move(device), scene, loop, *context.progress));
  play::WindowOptions window = options.window;
  if (!window.screenshot.empty() && window.pictures == 0) window.pictures = loop.count();
  CUTICLE_ASSIGN(const play::WindowReport report, play::show(*session, window));
  if (context.json) print(*session, report);
  return {};
}

}  // namespace

void add_play(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand(
      "play",
      "a live window on a scene: drag to orbit, right button to shift, wheel to come nearer; space pauses, full "
      "stop steps, R restarts, Escape closes; parameters and method at the right");
  auto options = std::make_shared<PlayOptions>();
  command->add_option("scene", options->scene, "scene file (JSON)")->required();
  const std::vector<std::string> methods(std::begin(scene::k_render_methods), std::end(scene::k_render_methods));
  command->add_option("--method", options->method, "how strands are drawn, in place of the scene's render.method")
      ->check(CLI::IsMember(methods));
  command->add_option("--frames", options->frames, "frames of the loop, first:last, or one frame")
      ->capture_default_str();
  command->add_option("--pictures", options->window.pictures, "close after so many pictures (default: when you do)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--screenshot", options->window.screenshot, "write a PNG of the window when it closes: after the last frame, unless --pictures says when");
  command->callback([&context, options] {
    context.action = [&context, options] {
      const Result<void> done = run_play(*options, context);
      return done ? int(Exit::ok) : report(done.error());
    };
  });
}
#else
void add_play(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
