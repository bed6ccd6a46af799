#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "softbody_common/images/rasterizer.h"

namespace softbody {

/// Images to render into. An image that no surface holds any more is used again: a new one costs a twentieth
/// of a frame's time.
class RasterMemory {
 public:
  /// An image that nobody else holds.
  std::shared_ptr<RasterImage> freeImage() {
    const auto is_free = [](const std::shared_ptr<RasterImage>& image) { return image.use_count() == 1; };
    const auto found = std::find_if(images_.begin(), images_.end(), is_free);
    if (found != images_.end()) return *found;
    images_.push_back(std::make_shared<RasterImage>());
    return images_.back();
  }

 private:
  std::vector<std::shared_ptr<RasterImage>> images_;
};

}  // namespace softbody
