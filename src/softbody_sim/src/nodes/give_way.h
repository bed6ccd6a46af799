#pragma once

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace softbody {

/// To be called by a thread with long work: the graph's threads then go first, also where it uses all
/// processors. On Linux a thread has a priority of its own. Without the permission to change it, it stays.
inline void giveWay() {
  constexpr int kNiceness = 10;  // a tenth of the time of a thread of the graph
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
}

}  // namespace softbody
