#include "viz/window/picture.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include "core/file.h"

namespace cuticle::viz {
namespace {

/// Shows one frame after the other and hands each to `take`.
Result<void> run_through(View& view, vtkRenderWindow& window, const ViewTarget& target,
                         const std::function<Result<void>(int)>& take) {
  const bool turns = target.turntable || view.frame_count() < 2;
  const int frames = turns ? target.turn_frames : view.frame_count();
  for (int frame = 0; frame < frames; ++frame) {
    if (!turns) CUTICLE_TRY(view.show_frame(frame));
    if (turns && frame > 0) view.turn(360.0 / frames);
    window.Render();
    CUTICLE_TRY(take(frame));
  }
  if (turns) view.turn(360.0 / frames);
  return {};
}

Result<void> write_theora(View& view, vtkRenderWindow& window, const ViewTarget& target, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkOggTheoraWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->SetRate(target.frames_per_second);
  writer->SetQuality(2);
  writer->Start();
  const Result<void> done = run_through(view, window, target, [&](int) -> Result<void> {
    grab->Modified();
    writer->Write();
    if (writer->GetError() == 0) return {};
    return bad_input(fmt::format("{}: cannot be written", path));
  });
  writer->End();
  return done;
}

}  // namespace

Result<void> write_picture(vtkRenderWindow& window, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  return write_through_temporary(path, [&grab](const std::string& temporary) -> Result<void> {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grab->GetOutputPort());
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0) return bad_input(fmt::format("{}: cannot be written", temporary));
    return {};
  });
}

Result<void> write_movie(View& view, vtkRenderWindow& window, const ViewTarget& target) {
  if (target.movie.ends_with(".ogv"))
    return write_through_temporary(
        target.movie, [&](const std::string& temporary) { return write_theora(view, window, target, temporary); });
  CUTICLE_TRY(make_folder(target.movie));
  return run_through(view, window, target, [&](int frame) {
    return write_picture(window, fmt::format("{}/frame_{:04d}.png", target.movie, frame));
  });
}

}  // namespace cuticle::viz
