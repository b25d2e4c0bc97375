#include "editor/window/views/image_plane.h"

#include <algorithm>
#include <cstring>

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "editor/window/base/theme.h"

namespace focalstage {

ImagePlacement fitted(glm::ivec2 image_px, glm::dvec2 pane_px) {
  if (image_px.x < 1 || image_px.y < 1) return {};
  const double zoom = std::min(pane_px.x / image_px.x, pane_px.y / image_px.y);
  return {std::max(zoom, 1e-3), 0.5 * glm::dvec2(image_px)};
}

glm::dvec2 image_from_pane(const ImagePlacement& placement, glm::dvec2 pane_px, glm::dvec2 at) {
  return placement.centre_px + (at - 0.5 * pane_px) / placement.zoom;
}

glm::dvec2 pane_from_image(const ImagePlacement& placement, glm::dvec2 pane_px, glm::dvec2 at) {
  return 0.5 * pane_px + (at - placement.centre_px) * placement.zoom;
}

struct ImagePlane::State {
  VtkTarget target;
  vtkNew<vtkImageData> image;
  vtkNew<vtkImageSliceMapper> mapper;
  vtkNew<vtkImageSlice> slice;
  glm::ivec2 size_px{0};
};

ImagePlane::ImagePlane(bool smooth) : state_(std::make_unique<State>()) {
  state_->mapper->SetInputData(state_->image);
  state_->mapper->BorderOn();  // a pixel covers [i, i + 1), the outermost ones too
  state_->slice->SetMapper(state_->mapper);
  vtkImageProperty* property = state_->slice->GetProperty();
  if (smooth) {
    property->SetInterpolationTypeToLinear();
  } else {
    property->SetInterpolationTypeToNearest();
  }
  property->SetColorWindow(255.0);
  property->SetColorLevel(127.5);
  vtkRenderer* renderer = state_->target.renderer();
  const glm::dvec3 back = theme::rgb(theme::view);
  renderer->SetBackground(back.x, back.y, back.z);
  renderer->GetActiveCamera()->ParallelProjectionOn();
}

ImagePlane::~ImagePlane() = default;

glm::ivec2 ImagePlane::size_px() const { return state_->size_px; }

void ImagePlane::clear() {
  state_->size_px = {0, 0};
  state_->target.renderer()->RemoveViewProp(state_->slice);
}

void ImagePlane::set(glm::ivec2 size_px, int channels, std::span<const std::uint8_t> codes) {
  const auto row = static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(channels);
  if (size_px.x < 1 || size_px.y < 1 || codes.size() < row * static_cast<std::size_t>(size_px.y)) {
    clear();
    return;
  }
  vtkImageData& image = *state_->image;
  if (state_->size_px != size_px || image.GetNumberOfScalarComponents() != channels) {
    image.SetDimensions(size_px.x, size_px.y, 1);
    image.SetOrigin(0.5, 0.5, 0.0);  // of the first pixel's centre
    image.AllocateScalars(VTK_UNSIGNED_CHAR, channels);
    state_->target.renderer()->AddViewProp(state_->slice);
    state_->size_px = size_px;
  }
  auto* rows = static_cast<std::uint8_t*>(image.GetScalarPointer());
  for (int y = 0; y < size_px.y; ++y) {
    std::memcpy(rows + row * static_cast<std::size_t>(size_px.y - 1 - y),
                codes.data() + row * static_cast<std::size_t>(y), row);
  }
  image.Modified();
}

void ImagePlane::render(glm::ivec2 pane_px, const ImagePlacement& placement, double scale) {
  vtkCamera& camera = *state_->target.renderer()->GetActiveCamera();
  const double x = placement.centre_px.x, y = state_->size_px.y - placement.centre_px.y;
  camera.SetFocalPoint(x, y, 0.0);
  camera.SetPosition(x, y, 10.0);
  camera.SetViewUp(0.0, 1.0, 0.0);
  camera.SetClippingRange(1.0, 20.0);
  camera.SetParallelScale(std::max(0.5 * pane_px.y / placement.zoom, 1e-3));
  state_->target.render(pane_px, 1, scale);
}

Picture ImagePlane::picture() const { return state_->target.picture(); }
void ImagePlane::finalize() { state_->target.finalize(); }

}  // namespace focalstage
