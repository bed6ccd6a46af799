#include "injection/fault_options.h"

namespace softbody::injection {

std::vector<FaultOption> faultOptions(DeliveryFaults* deliveries, ImageFaults* images) {
  return {
      {"drop", "", &deliveries->drop_share, 0.0, 1.0, "share of the images that never arrive"},
      {"duplicate", "", &deliveries->duplicate_share, 0.0, 1.0, "share of the images that arrive twice"},
      {"reorder", "", &deliveries->reorder_share, 0.0, 0.5,
       "share of the images that arrive after the next image"},
      {"delay", "", &deliveries->delay_share, 0.0, 1.0, "share of the images that arrive late"},
      {"delay_by", "s", &deliveries->delay_s, 0.0, 60.0, "their delay"},
      {"wrong_stamp", "", &deliveries->stamp_share, 0.0, 1.0, "share of the images with a wrong stamp"},
      {"stamp_by", "s", &deliveries->stamp_s, -3600.0, 3600.0, "error of the stamp; negative: too early"},
      {"occluder", "", &images->occluder_share, 0.0, 1.0,
       "share of the image behind a flat, skin-coloured occluder"},
      {"occluder_u", "", &images->occluder_u, 0.0, 1.0, "centre of the occluder, in widths of the image"},
      {"occluder_v", "", &images->occluder_v, 0.0, 1.0, "centre of the occluder, in heights of the image"},
      {"occluder_depth", "m", &images->occluder_m, 0.001, 65.0, "distance of the occluder"},
      {"occluder_from", "s", &images->occluder_from_s, 0.0, 1e9,
       "begin of the occlusion, after the first image"},
      {"occluder_for", "s", &images->occluder_for_s, 0.0, 1e9, "duration of the occlusion"},
      {"holes", "", &images->hole_share, 0.0, 1.0,
       "share of the depth image without a measurement, in blocks of 8 x 8 px"},
      {"misplaced", "", &images->misplaced_share, 0.0, 1.0,
       "share of the colour image that is displaced by 4 to 12 px, in blocks of 24 x 24 px; features are "
       "then "
       "found at wrong places"},
  };
}

}  // namespace softbody::injection
