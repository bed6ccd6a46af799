#include "softbody_evaluation/tools/evaluate.h"

int main(int argc, char** argv) { return softbody::evaluation::runEvaluate(argc, argv); }
