# softbody::common for packages that find this one.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
if(NOT TARGET opencv_core)
  find_package(OpenCV 4 REQUIRED)
endif()
find_package(yaml-cpp REQUIRED)
if(NOT TARGET softbody::common)
  include(${softbody_common_DIR}/softbody_common-targets.cmake)
endif()
