#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {
namespace {

ParameterTable<PairingConfig> makePairingTable() {
  ParameterTable<PairingConfig> table;
  table.group("camera_ingest");
  table.choice<bool>("sync", &PairingConfig::exact, {{"approximate", false}, {"exact", true}},
                     "exact: stamps must be equal");
  table.seconds("sync_tolerance_s", &PairingConfig::tolerance, {0.0001, 1.0},
                "largest difference of stamps, if approximate");
  table.number("queue_size", &PairingConfig::queue_size, {1, 1000}, "images",
               "largest number of images of a stream that wait for their partner");
  return table;
}

}  // namespace

const ParameterTable<PairingConfig>& pairingParameters() {
  static const ParameterTable<PairingConfig> table = makePairingTable();
  return table;
}

}  // namespace softbody
