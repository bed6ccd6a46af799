# softbody::tracking and softbody::marker_board for packages that find this one.
if(NOT TARGET softbody::tracking)
  include(${softbody_tracking_DIR}/softbody_tracking-targets.cmake)
endif()
