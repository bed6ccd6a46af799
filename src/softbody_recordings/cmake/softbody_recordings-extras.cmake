# softbody::recordings and softbody::replay for packages that find this one.
find_package(nlohmann_json REQUIRED)
if(NOT TARGET softbody::recordings)
  include(${softbody_recordings_DIR}/softbody_recordings-targets.cmake)
endif()
