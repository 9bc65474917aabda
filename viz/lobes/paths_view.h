#pragma once
// The view of rays through a cross-section. Private to viz.
#include <optional>

#include "viz/draw/detail/plot.h"
#include "viz/lobes/paths.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

class PathsPicture : public ViewOf<PathsView> {
 public:
  explicit PathsPicture(PathsView view) : ViewOf("paths", view) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double degrees) override;
  Result<void> write_files(const std::string& folder) override { return write_paths(view_, folder); }

 private:
  void update();
  PlotContent section() const;
  PlotContent azimuths() const;
  Control control(const std::string& name, const std::string& unit, double lower, double upper, double& value,
                  double unit_value);

  std::optional<Plot> section_, azimuths_;
};

}  // namespace cuticle::viz
