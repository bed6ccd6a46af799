# softbody::scanning for packages that find this one.
if(NOT TARGET softbody::scanning)
  include(${softbody_scanning_DIR}/softbody_scanning-targets.cmake)
endif()
