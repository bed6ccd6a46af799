#pragma once

namespace softbody {

/// The tool `identify_material`: finds the stiffness of an object from a recording or a measured shape.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage, 3 a property is not
/// observable.
int runIdentifyMaterial(int argc, char** argv);

}  // namespace softbody
