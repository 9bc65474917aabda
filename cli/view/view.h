#pragma once
// A view's subcommand each in cli/view/NAME.cpp, and what they share.
#include <memory>
#include <numbers>

#include "cli/command.h"
#include "viz/views.h"

namespace cuticle::cli {

/// Where a view goes: the options of every view.
struct ViewOptions {
  viz::ViewTarget target;
  std::vector<int> size = {1400, 900};
  std::string files;  ///< --export DIR: files instead of a picture
};
void add_target_options(CLI::App& command, ViewOptions& options, bool has_frames = false);

/// "x,y,z". Error: usage, naming the option.
Result<glm::dvec3> parse_vector(const std::string& name, const std::string& text);

/// Writes the files where they were asked for, and shows the view where that was, or where neither was.
Result<void> show_or_write(const ViewOptions& options, const std::function<Result<void>(const std::string&)>& write,
                           const std::function<Result<void>(const viz::Views&, const viz::ViewTarget&)>& show);

/// The command's action: `act` with its options.
template <class Options>
void set_view_action(CLI::App& command, Context& context, const std::shared_ptr<Options>& options,
                     Result<void> (*act)(const Options&, Context&)) {
  command.callback([&context, options, act] {
    context.action = [&context, options, act] {
      const Result<void> done = act(*options, context);
      return done ? int(Exit::ok) : report(done.error());
    };
  });
}

void add_view_lobes(CLI::App& view, Context& context);
void add_view_lut(CLI::App& view, Context& context);
void add_view_paths(CLI::App& view, Context& context);
void add_view_plan(CLI::App& view, Context& context);
void add_view_shadow(CLI::App& view, Context& context);
void add_view_strands(CLI::App& view, Context& context);

}  // namespace cuticle::cli
