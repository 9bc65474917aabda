#pragma once
// The view of shadow methods. Private to viz.
#include <optional>

#include "viz/draw/detail/parts.h"
#include "viz/draw/detail/plot.h"
#include "viz/shadow/shadow.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

class ShadowPicture : public ViewOf<ShadowView> {
 public:
  explicit ShadowPicture(ShadowView view) : ViewOf("shadow", std::move(view)) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double degrees) override;
  Result<std::string> pick(const glm::ivec2& pixel) override;
  Result<void> write_files(const std::string& folder) override;

 private:
  /// A picture in space: sheets of a map, or the volume.
  struct Part {
    vtkSmartPointer<vtkRenderer> renderer;
    std::vector<vtkSmartPointer<vtkProp>> props;
    vtkSmartPointer<vtkTextActor> title;
  };
  Result<void> update();
  void draw_sheets(Part& part, const std::vector<Sheet>& sheets, bool cut_open);
  glm::dvec3 aside() const;
  void draw_volume(Part& part, const TransmittanceVolume& volume);
  void draw_surroundings(Part& part);
  Result<void> update_curves();
  void look();

  Part opacity_, deep_, volume_;
  ColorScale depths_{Ramp::sequential, 0, 4, false, "optical depth before the layer"};
  ColorScale transmittances_{Ramp::sequential, 0, 1, false, "transmittance (deep opacity map)"};
  std::optional<ColorBar> depth_bar_, deep_bar_, transmittance_bar_;
  std::optional<Plot> curves_;
  double scale_ = 1;
};

}  // namespace cuticle::viz
