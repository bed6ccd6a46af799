#include "softbody_evaluation/tools/simulate_truth.h"

int main(int argc, char** argv) { return softbody::evaluation::runSimulateTruth(argc, argv); }
