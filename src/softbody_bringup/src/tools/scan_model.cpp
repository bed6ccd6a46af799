#include "softbody_scanning/tools/scan_model.h"

int main(int argc, char** argv) { return softbody::scanning::runScanModel(argc, argv); }
