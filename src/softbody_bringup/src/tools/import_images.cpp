#include "softbody_recordings/tools/import_images.h"

int main(int argc, char** argv) { return softbody::runImportImages(argc, argv); }
