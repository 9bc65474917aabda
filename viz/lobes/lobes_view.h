#pragma once
// The view of lobes. Private to viz.
#include <memory>
#include <optional>

#include "viz/draw/detail/plot.h"
#include "viz/lobes/detail/lobes_scene.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

class LobesPicture : public ViewOf<LobesView> {
 public:
  explicit LobesPicture(LobesView view) : ViewOf("lobes", std::move(view)) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double degrees) override;
  bool grab(const glm::ivec2& pixel) override;
  Result<void> drag(const glm::ivec2& pixel, bool resting) override;
  Result<void> write_files(const std::string& folder) override;

  const LobesView& shown() const { return view_; }
  const LobesScene& scene(std::size_t model) const { return *scenes_[model]; }
  double peak() const { return peak_; }

 private:
  void lay_out(const WindowArea& area);
  Result<void> update(bool resting);
  Result<void> update_surfaces(const std::vector<LobeValues>& values);
  Result<void> update_plots();
  Result<void> set_parameter(std::size_t model, const registry::Parameter& parameter, int component, double value,
                             bool resting);
  void add_parameter(std::vector<Control>& list, std::size_t model, const registry::Parameter& parameter);
  bool shows_difference() const { return view_.difference && view_.models.size() == 2; }
  std::string words_of(const LobeValues& values) const;

  std::vector<std::unique_ptr<LobesScene>> scenes_;
  std::optional<Plot> longitudinal_, azimuthal_;
  std::optional<ColorBar> bar_;
  std::size_t held_ = 0;
  double peak_ = 1;
};

}  // namespace cuticle::viz
