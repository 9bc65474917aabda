#pragma once
// Numbers at the nodes of a grid as a volume. Private to viz, which shows VTK types.
#include <functional>
#include <span>

#include <vtkSmartPointer.h>
#include <vtkVolume.h>
#include <glm/vec3.hpp>

#include "viz/color/ramp.h"

namespace cuticle::viz {

/// `values`: x fastest. `opacity`: of a fraction of the scale (0 .. 1), over a length of two cells.
vtkSmartPointer<vtkVolume> make_volume(const glm::ivec3& size, const glm::dvec3& origin, const glm::dvec3& spacing,
                                       std::span<const float> values, const ColorScale& scale,
                                       const std::function<double(double fraction)>& opacity);

}  // namespace cuticle::viz
