#pragma once

#include <string>

#include "softbody_common/parameters/parameter_table.h"

namespace softbody::scanning {

/// The parameters of the scanner as a node.
struct ScannerOptions {
  std::string sheet;           ///< path of the YAML of the sheet of markers
  bool allow_outside = false;  ///< a file that it names may be outside of its folder
  std::string output;          ///< folder of the model
};

const ParameterTable<ScannerOptions>& scannerParameters();

}  // namespace softbody::scanning
