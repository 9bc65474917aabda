#pragma once
// The view of strands. Private to viz.
#include <optional>

#include "viz/draw/detail/parts.h"
#include "viz/draw/detail/plot.h"
#include "viz/strands/states.h"
#include "viz/strands/surroundings.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

/// Strands drawn at most while the camera moves.
inline constexpr std::size_t k_moving_strands = 4000;

class StrandsPicture : public ViewOf<StrandsView> {
 public:
  explicit StrandsPicture(StrandsView view) : ViewOf("strands", std::move(view)) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double degrees) override;
  int frame_count() const override;
  Result<void> show_frame(int frame) override;
  Result<std::string> pick(const glm::ivec2& pixel) override;
  void set_moving(bool moving) override;
  Result<void> write_files(const std::string& folder) override;

 private:
  /// A run's state in a viewport.
  struct Part {
    Run run;
    vtkSmartPointer<vtkRenderer> renderer;
    strands::Groom groom;
    ColoredStrands colored;
    vtkSmartPointer<vtkActor> all, some, picked;
    std::vector<vtkSmartPointer<vtkProp>> around;
    vtkSmartPointer<vtkTextActor> title;
  };
  Result<void> load(Part& part);
  Result<void> fit_scale();
  void draw(Part& part);
  Result<void> draw_surroundings(Part& part);
  void draw_colliders(Part& part);
  Result<void> draw_density(Part& part);
  int shown_frame(const Part& part) const;
  void show_strand(Part& part);
  Result<void> update_curves();
  Result<std::vector<glm::dvec2>> over_time(const Part& part, std::size_t strand, std::size_t vertex) const;
  std::pair<std::size_t, std::size_t> largest() const;
  std::optional<std::size_t> nearest_vertex(Part& part, const glm::ivec2& pixel) const;
  void look();
  Result<void> set_color(std::size_t choice);

  std::vector<Part> parts_;
  std::vector<std::string> color_names_;
  ColorScale scale_;
  std::optional<ColorScale> density_scale_;
  std::optional<ColorBar> bar_;
  std::optional<Plot> along_, over_time_;
  std::size_t strand_ = 0, vertex_ = 0;  ///< picked
  double size_ = 1;
};

}  // namespace cuticle::viz
