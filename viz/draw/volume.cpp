#include <algorithm>

#include <vtkAutoInit.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkVolumeProperty.h>

#include "viz/draw/detail/volume.h"

VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace cuticle::viz {

vtkSmartPointer<vtkVolume> make_volume(const glm::ivec3& size, const glm::dvec3& origin, const glm::dvec3& spacing,
                                       std::span<const float> values, const ColorScale& scale,
                                       const std::function<double(double fraction)>& opacity) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(size.x, size.y, size.z);
  image->SetOrigin(origin.x, origin.y, origin.z);
  image->SetSpacing(spacing.x, spacing.y, spacing.z);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* at = static_cast<unsigned char*>(image->GetScalarPointer());
  for (const float value : values)
    *at++ = static_cast<unsigned char>(255 * std::clamp(scale.fraction(double(value)), 0.0, 1.0) + 0.5);
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  mapper->SetInputData(image);
  mapper->SetSampleDistance(float(spacing.x / 2));
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  for (int k = 0; k <= 16; ++k) {
    const glm::dvec3 c = ramp_color(scale.ramp, k / 16.0);
    colors->AddRGBPoint(255 * k / 16.0, c.x, c.y, c.z);
    opacities->AddPoint(255 * k / 16.0, opacity(k / 16.0));
  }
  auto actor = vtkSmartPointer<vtkVolume>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colors);
  actor->GetProperty()->SetScalarOpacity(opacities);
  actor->GetProperty()->SetScalarOpacityUnitDistance(2 * spacing.x);
  actor->GetProperty()->SetInterpolationTypeToLinear();
  return actor;
}

}  // namespace cuticle::viz
