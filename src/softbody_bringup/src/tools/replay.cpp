#include "softbody_recordings/tools/replay.h"

int main(int argc, char** argv) { return softbody::runReplay(argc, argv); }
