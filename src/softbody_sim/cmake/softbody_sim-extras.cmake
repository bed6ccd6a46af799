# softbody::sim, softbody::sim_model and the cutting libraries for packages that find this one.
if(NOT TARGET softbody::sim)
  include(${softbody_sim_DIR}/softbody_sim-targets.cmake)
endif()
