#include "softbody_virtual_camera/tools/virtual_camera.h"

int main(int argc, char** argv) { return softbody::virtual_camera::runVirtualCamera(argc, argv); }
