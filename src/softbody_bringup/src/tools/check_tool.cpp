#include "softbody_recordings/tools/check_tool.h"

int main(int argc, char** argv) { return softbody::runCheckTool(argc, argv); }
