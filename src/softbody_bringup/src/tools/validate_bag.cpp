#include "softbody_recordings/tools/validate_bag.h"

int main(int argc, char** argv) { return softbody::validation::runValidateBag(argc, argv); }
