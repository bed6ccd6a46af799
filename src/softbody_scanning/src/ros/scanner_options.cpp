#include "softbody_scanning/ros/scanner_options.h"

namespace softbody::scanning {
namespace {

ParameterTable<ScannerOptions> makeScannerTable() {
  using Options = ScannerOptions;
  ParameterTable<Options> table;
  table.group("scanner");
  table.requiredText("sheet", &Options::sheet, "YAML of the sheet of markers");
  table.flag("allow_outside", &Options::allow_outside,
             "the YAML may name [a file in another folder](reference.md#files-in-other-folders)");
  table.requiredText("output", &Options::output, "folder of the object that is written");
  return table;
}

}  // namespace

const ParameterTable<ScannerOptions>& scannerParameters() {
  static const ParameterTable<ScannerOptions> table = makeScannerTable();
  return table;
}

}  // namespace softbody::scanning
