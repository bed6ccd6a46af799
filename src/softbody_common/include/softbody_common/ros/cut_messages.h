#pragma once

#include <softbody_msgs/Cut.h>

#include "softbody_common/cut.h"

/// Cuts as messages. The caller sets and reads the headers.
namespace softbody {

softbody_msgs::Cut toMessage(const Cut& cut);

/// @throw std::invalid_argument, with field and index, if indices or numbers are not valid.
Cut fromMessage(const softbody_msgs::Cut& message);

}  // namespace softbody
