#pragma once

namespace softbody {

/// The tool `import_images`: a folder of images as a bag.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runImportImages(int argc, char** argv);

}  // namespace softbody
