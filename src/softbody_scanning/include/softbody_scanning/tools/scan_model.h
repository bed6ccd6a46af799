#pragma once

namespace softbody::scanning {

/// The program scan_model.
int runScanModel(int argc, char** argv);

}  // namespace softbody::scanning
