#pragma once

#include "labels/label_cells.h"
#include "labels/label_memory.h"

namespace softbody {

/// What is known before a frame is labelled.
struct LabelPrior {
  const LabelMemory& last;  ///< of the last frame; empty: nothing is known
  double focal_px;
  double error_m;  ///< how far predictions were off in the last frames
  int reach_px;    ///< the farthest that anything moves in a frame
};

/// Tells the body from what is before it. For each cell that shows no background it computes the probability
/// of the body by mean-field inference in a Markov random field (Koller and Friedman 2009, 11.5): each cell
/// has the evidence of its depth, its colour and the last frame; neighbours without a step in depth between
/// them are alike. How far the body may be from its prediction is measured in the frame itself.
void tellOccluders(const SurfaceSamples& samples, const LabelPrior& prior, LabelCells* cells);

}  // namespace softbody
