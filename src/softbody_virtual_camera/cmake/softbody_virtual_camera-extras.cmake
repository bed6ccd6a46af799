# softbody::virtual_camera for packages that find this one.
if(NOT TARGET softbody::virtual_camera)
  include(${softbody_virtual_camera_DIR}/softbody_virtual_camera-targets.cmake)
endif()
