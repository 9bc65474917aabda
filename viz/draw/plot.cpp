#include "viz/draw/detail/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>

#include "viz/draw/detail/plot_item.h"

namespace cuticle::viz {

Plot::Plot(vtkRenderer& renderer, double scale) : item_(vtkSmartPointer<PlotItem>::New()), renderer_(&renderer) {
  item_->scale = scale;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item_);
  actor->GetScene()->SetRenderer(&renderer);
  renderer.AddActor(actor);
  renderer.InteractiveOff();
}

void Plot::set(PlotContent content) { item_->set(std::move(content)); }
const PlotContent& Plot::content() const { return item_->content(); }

std::optional<glm::dvec2> Plot::place_of(const glm::dvec2& pixel) const {
  const int* origin = renderer_->GetOrigin();
  return item_->place_of(pixel - glm::dvec2(origin[0], origin[1]));
}

void fit_y(PlotContent& content) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const Curve& curve : content.curves)
    for (const glm::dvec2& point : curve.points) {
      if (!std::isfinite(point.y) || (content.y.kind == PlotAxis::Kind::logarithmic && !(point.y > 0))) continue;
      lower = std::min(lower, point.y);
      upper = std::max(upper, point.y);
    }
  if (!(lower <= upper)) return;
  if (content.y.kind == PlotAxis::Kind::logarithmic) {
    content.y.upper = 1.3 * upper;
    content.y.lower = std::max(lower, 1e-6 * upper) / 1.3;
    return;
  }
  const double room = std::max(0.06 * (upper - lower), 1e-9 * std::max(1.0, std::abs(upper)));
  content.y.upper = upper + room;
  content.y.lower = lower >= 0 && lower < 0.5 * upper ? 0 : lower - room;
  if (!(content.y.upper > content.y.lower)) content.y.upper = content.y.lower + 1;
}

}  // namespace cuticle::viz
