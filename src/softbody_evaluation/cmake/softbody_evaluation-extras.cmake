# softbody::evaluation for packages that find this one.
if(NOT TARGET softbody::evaluation)
  include(${softbody_evaluation_DIR}/softbody_evaluation-targets.cmake)
endif()
