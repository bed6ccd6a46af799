#pragma once

#include <softbody_msgs/Cut.h>
#include <softbody_msgs/CutHistory.h>

#include <string>

#include "softbody_common/cutting/edit_history.h"

/// Cuts as messages. The caller sets and reads the headers.
namespace softbody {

softbody_msgs::Cut toMessage(const Cut& cut);

/// @throw std::invalid_argument, with field and index, if the cut is not usable by any body: a patch that is
/// empty, too large, not finite or too far away; a patch for another kind of edit; an index of no vertex.
Cut fromMessage(const softbody_msgs::Cut& message);

/// The edits of a body, and its tets before all of them.
struct EditedBody {
  EditHistory edits;
  TetTopology uncut;
};

softbody_msgs::CutHistory toMessage(const EditHistory& edits, const TetTopology& uncut);

/// The same, to publish. @param body_frame of the patches; @param stamp of the last edit.
softbody_msgs::CutHistoryPtr historyMessage(const EditHistory& edits, const TetTopology& uncut,
                                            const std::string& body_frame, const ros::Time& stamp);

/// @throw std::invalid_argument as for its cuts and its topology, or if the strokes do not fit the cuts.
EditedBody fromMessage(const softbody_msgs::CutHistory& message);

}  // namespace softbody
