#pragma once

namespace softbody {

/// The tool `import_images`: makes a bag from a folder of images.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runImportImages(int argc, char** argv);

}  // namespace softbody
