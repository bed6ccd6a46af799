#pragma once

#include <vector>

#include "picture/color_patches.h"

namespace softbody {

/// How well the picture of the body, at a pose, explains the colours of an image. Texture is compared by
/// correlation, so neither light nor exposure matter; the mean colour by its hue alone.
struct PictureFit {
  double patches = 0.0;      ///< number of independent ones
  double correlation = 0.0;  ///< of the texture in picture and image, -1..1
  /// Of the texture: by how much the logarithm of the likelihood rises if the image has it, times two. The
  /// square of a number of standard deviations.
  double evidence = 0.0;
  /// By how many standard deviations the correlation is below that of the body's picture; may be negative.
  double shortfall = 0.0;
  double cast = 0.0;  ///< difference of the mean hue, in standard deviations of a camera's colour cast
};

PictureFit pictureFit(const std::vector<ColorPatch>& patches);

/// The square of the standard deviations that are no chance, if the best of `poses` is taken: the largest of
/// n squared normal deviations is about 2 ln n larger than one.
double doubtSquared(int poses);

/// Whether the picture is seen there. @param poses that were compared.
bool pictureFits(const PictureFit& fit, int poses);
/// Whether something else is seen there.
bool pictureDisagrees(const PictureFit& fit, int poses);

}  // namespace softbody
