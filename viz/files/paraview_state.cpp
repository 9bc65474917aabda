#include "viz/files/paraview_state.h"

#include <fmt/format.h>

namespace cuticle::viz {

std::string paraview_state(const std::string& file, const std::string& array, const ColorScale& colors) {
  std::string points;
  constexpr int steps = 16;
  for (int k = 0; k <= steps; ++k) {
    const glm::dvec3 c = ramp_color(colors.ramp, double(k) / steps);
    const double value = colors.lower + (colors.upper - colors.lower) * k / steps;
    points += fmt::format("    {:.9g}, {:.4f}, {:.4f}, {:.4f},\n", value, c.x, c.y, c.z);
  }
  return fmt::format(R"(# State of ParaView: File > Load State, or `pvpython --force-offscreen-rendering THIS_FILE`.
import os
from paraview.simple import *

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
data = OpenDataFile(os.path.join(folder, "{0}"))
view = GetActiveViewOrCreate("RenderView")
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
shown = Show(data, view)
shown.LineWidth = 1.5
ColorBy(shown, ("POINTS", "{1}"))
colors = GetColorTransferFunction("{1}")
colors.ColorSpace = "RGB"
colors.RGBPoints = [
{2}]
bar = GetScalarBar(colors, view)
bar.Title = "{3}"
bar.ComponentTitle = ""
bar.TitleColor = bar.LabelColor = [0, 0, 0]
shown.SetScalarBarVisibility(view, True)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
ResetCamera(view)
Render(view)
)",
                     file, array, points, colors.title);
}

}  // namespace cuticle::viz
