#pragma once

#include <string>

#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// What an estimate found, in a sentence.
std::string sentenceOf(const MaterialEstimate& estimate);

}  // namespace softbody
