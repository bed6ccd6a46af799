#pragma once

#include <softbody_msgs/Cut.h>

#include "softbody_common/cut.h"

/// Cuts as messages; headers are the caller's.
namespace softbody {

softbody_msgs::Cut toMessage(const Cut& cut);

/// @throw std::invalid_argument, with the field and the index, where indices or numbers do not make sense.
Cut fromMessage(const softbody_msgs::Cut& message);

}  // namespace softbody
