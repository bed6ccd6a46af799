#include <ros/init.h>
#include <ros/param.h>
#include <signal.h>

#include <cstdio>
#include <string>

#include "softbody_common/tools/package_version.h"

/// Waits until roslaunch ends it. Then it sets use_sim_time to false, because roslaunch leaves it true on a
/// master that stays, and nodes that start there later would wait for /clock.
int main(int argc, char** argv) {
  if (argc == 2 && argv[1] == std::string("--version"))
    return std::puts(softbody::packageVersion().c_str()) < 0;
  sigset_t ends;
  sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // before ROS starts threads, which inherit it
  ros::init(argc, argv, "reset_clock", ros::init_options::NoSigintHandler);
  int signal = 0;
  sigwait(&ends, &signal);
  ros::param::set("/use_sim_time", false);
  return 0;
}
