#include "softbody_recordings/tools/identify_material.h"

int main(int argc, char** argv) { return softbody::runIdentifyMaterial(argc, argv); }
