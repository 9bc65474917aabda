// How fast a view of many strands turns: bench_views [STRANDS] (100,000 of 16 vertices unless given), 1400 x 900, on a
// virtual display where there is none. Frames per second by wall clock and processor time, while the camera moves
// (fewer strands, at most k_moving_strands) and of a frame with all of them; once drawn before. With Mesa's software
// OpenGL these are the processor's figures.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <fmt/core.h>

#include "strands/formats/formats.h"
#include "strands/growing/grow.h"
#include "viz/strands/strands_view.h"
#include "viz/window/detail/open_window.h"

namespace {

using namespace cuticle;

strands::Groom grown(double strands) {
  strands::GroomingSpecification head;
  head.strands.vertices = 16;
  head.strands.density *= strands / double(strands::grow(head).value().drawn.strand_count());
  return strands::grow(head).value().drawn;
}

void turn(viz::StrandsPicture& picture, vtkRenderWindow& window, bool moving, int frames) {
  picture.set_moving(moving);
  window.SetMultiSamples(moving ? 0 : viz::k_samples);
  window.Render();
  const auto began = std::chrono::steady_clock::now();
  const std::clock_t used = std::clock();
  for (int k = 0; k < frames; ++k) {
    picture.turn(3);
    window.Render();
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  fmt::print("{}: {:.1f} frames per second, {:.1f} ms of processor time a frame\n", moving ? "moving" : "all strands",
             frames / wall.count(), 1e3 * double(std::clock() - used) / CLOCKS_PER_SEC / frames);
}

int failed(const Error& error) {
  std::fputs((error.message + "\n").c_str(), stderr);
  return 1;
}

int run(double strands) {
  const strands::Groom groom = grown(strands);
  const std::string file = fmt::format("{}/bench_views_{}.hair", P_tmpdir, std::clock());
  if (const auto saved = strands::write_groom(file, groom); !saved) return failed(saved.error());
  viz::StrandsView view;
  view.runs = {viz::find_run(file).value()};
  view.metres_per_unit = 1;
  viz::StrandsPicture picture(std::move(view));
  viz::ViewTarget target;
  target.size = {1400, 900};
  target.screenshot = "none";
  const auto opened = viz::open_window(picture, target);
  std::remove(file.c_str());
  if (!opened) return failed(opened.error());
  fmt::print("{} strands, {} vertices\n", groom.strand_count(), groom.vertex_count());
  for (int round = 0; round < 2; ++round) {
    turn(picture, *opened->window, true, 20);
    turn(picture, *opened->window, false, 2);
  }
  return 0;
}

}  // namespace

int main(int count, char** words) { return run(count > 1 ? std::atof(words[1]) : 100000); }
