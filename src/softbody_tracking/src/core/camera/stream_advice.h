#pragma once

#include <map>
#include <string>
#include <vector>

#include "camera/stream_monitor.h"

namespace softbody {

/// What to do about a stream without messages: names the topics that could be meant, with their types, and
/// the launch argument to change.
/// @param topic the stream's topic, without the name of a transport. @param published types by topic.
std::string streamAdvice(Stream stream, const std::string& topic,
                         const std::map<std::string, std::string>& published);

/// What to do about all silent streams. If another namespace has a camera with the same names, it is named.
std::string adviceOn(const std::vector<StreamMonitor::Silent>& silent, const StreamTopics& topics,
                     const std::map<std::string, std::string>& published);

}  // namespace softbody
