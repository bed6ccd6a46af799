#include "softbody_recordings/tools/inject.h"

int main(int argc, char** argv) { return softbody::injection::runInject(argc, argv); }
