#include "softbody_recordings/injection/fault_options.h"

namespace softbody::injection {

std::vector<FaultOption> faultOptions(DeliveryFaults* deliveries, ImageFaults* images) {
  return {
      {"drop", "", &deliveries->drop_share, 0.0, 1.0, "share of the images that never arrive"},
      {"duplicate", "", &deliveries->duplicate_share, 0.0, 1.0, "share that arrive twice"},
      {"reorder", "", &deliveries->reorder_share, 0.0, 0.5, "share that arrive only after the next one"},
      {"delay", "", &deliveries->delay_share, 0.0, 1.0, "share that arrive late"},
      {"delay_by", "s", &deliveries->delay_s, 0.0, 60.0, "how late"},
      {"wrong_stamp", "", &deliveries->stamp_share, 0.0, 1.0, "share whose stamp is off"},
      {"stamp_by", "s", &deliveries->stamp_s, -3600.0, 3600.0, "by how much; negative: too early"},
      {"occluder", "", &images->occluder_share, 0.0, 1.0,
       "share of the image that a flat, skin-coloured thing covers"},
      {"occluder_u", "", &images->occluder_u, 0.0, 1.0, "its centre, in widths of the image"},
      {"occluder_v", "", &images->occluder_v, 0.0, 1.0, "its centre, in heights of the image"},
      {"occluder_depth", "m", &images->occluder_m, 0.001, 65.0, "its distance"},
      {"occluder_from", "s", &images->occluder_from_s, 0.0, 1e9, "when it comes, from the first image on"},
      {"occluder_for", "s", &images->occluder_for_s, 0.0, 1e9, "how long it stays"},
      {"holes", "", &images->hole_share, 0.0, 1.0,
       "share of the depth image that is not measured, in blocks of 8 x 8 px"},
      {"misplaced", "", &images->misplaced_share, 0.0, 1.0,
       "share of the colour image that shows what is 4 to 12 px beside it, in blocks of 24 x 24 px: features "
       "are found in wrong places"},
  };
}

}  // namespace softbody::injection
