#include "softbody_evaluation/tools/draw_cut.h"

int main(int argc, char** argv) { return softbody::evaluation::runDrawCut(argc, argv); }
