#include "softbody_recordings/injection/injector_options.h"

#include "injection/fault_options.h"

namespace softbody::injection {
namespace {

ParameterTable<InjectorOptions> makeInjectorTable() {
  ParameterTable<InjectorOptions> table;
  table.group("injector");
  table.seed("seed", &InjectorOptions::seed, "selects the images and pixels with faults");
  table.choice("stream", &InjectorOptions::stream, {"color", "depth", "both"},
               "images with delivery faults (`drop` to `wrong_stamp`)");
  InjectorOptions usual;
  const std::vector<FaultOption> faults = faultOptions(&usual.deliveries, &usual.images);
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const FaultOption& fault = faults[k];
    const std::string name = fault.unit.empty() ? fault.name : fault.name + "_" + fault.unit;
    const auto place = [k](InjectorOptions* options) {
      return faultOptions(&options->deliveries, &options->images)[k].value;
    };
    table.number(name, place, {fault.least, fault.most}, fault.unit.empty() ? "share" : fault.unit,
                 fault.description);
  }
  return table;
}

}  // namespace

const ParameterTable<InjectorOptions>& injectorParameters() {
  static const ParameterTable<InjectorOptions> table = makeInjectorTable();
  return table;
}

}  // namespace softbody::injection
