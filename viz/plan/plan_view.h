#pragma once
// The view of what a picture cost. Private to viz.
#include <memory>

#include "viz/draw/detail/plot.h"
#include "viz/plan/plan.h"
#include "viz/window/detail/view.h"

namespace cuticle::viz {

class PlanPicture : public ViewOf<PlanView> {
 public:
  explicit PlanPicture(PlanView view) : ViewOf("plan", std::move(view)) {}
  Result<void> fill(const WindowArea& area) override;
  std::vector<Control> controls() override;
  void turn(double) override {}
  Result<std::string> pick(const glm::ivec2& pixel) override;
  Result<void> write_files(const std::string& folder) override;

 private:
  Result<void> update();
  void show(Plot& plot, const std::string& title, const std::string& bar, const CostMap& map);

  PlanMaps maps_;
  std::vector<std::unique_ptr<Plot>> plots_;
};

}  // namespace cuticle::viz
