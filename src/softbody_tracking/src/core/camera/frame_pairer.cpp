#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {
namespace {

ParameterTable<PairingConfig> makePairingTable() {
  ParameterTable<PairingConfig> table;
  table.group("camera_ingest");
  table.seconds(
      "sync_tolerance_s", &PairingConfig::tolerance, {0.0, 1.0},
      "largest difference of the stamps of colour and depth; 0: the driver gives both the same stamp");
  return table;
}

}  // namespace

const ParameterTable<PairingConfig>& pairingParameters() {
  static const ParameterTable<PairingConfig> table = makePairingTable();
  return table;
}

}  // namespace softbody
