#include <softbody_msgs/Cut.h>

#include <cmath>

#include "fuzz/byte_source.h"
#include "fuzz/feeds.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_sim/cutting/binding/cuttable_surface.h"
#include "softbody_sim/object/object_model.h"

namespace softbody::fuzz {
namespace {

CuttableSurface sponge() {
  const ObjectModel model = buildObjectModel(loadObjectDescription(CONFIG_DIR "/sponge.yaml"));
  return {model.visual, model.volume};
}

/// Mostly places in and around the sponge, sometimes any number.
float coordinate(ByteSource* source) {
  const auto value = source->value<std::int16_t>();
  return value == 0x7fff ? source->value<float>() : 0.15f * static_cast<float>(value) / 32767.0f;
}

softbody_msgs::Cut cutMessage(ByteSource* source) {
  softbody_msgs::Cut cut;
  cut.revision = 1;
  cut.patch_vertices.resize(source->value<std::uint8_t>() % 12);
  cut.patch_triangles.resize(source->value<std::uint8_t>() % 12);
  for (auto& vertex : cut.patch_vertices) {
    vertex.x = coordinate(source);
    vertex.y = coordinate(source);
    vertex.z = coordinate(source);
  }
  for (auto& triangle : cut.patch_triangles) {
    for (auto& index : triangle.vertex_indices) {
      const auto value = source->value<std::uint8_t>();
      index = value == 255 ? source->value<std::uint32_t>() : value % 12;
    }
  }
  return cut;
}

}  // namespace

/// A patch that arrives as a message is tried on the sponge.
void giveCut(std::string_view bytes) {
  static const CuttableSurface body = sponge();
  ByteSource source(bytes);
  try {
    body.preview(fromMessage(cutMessage(&source)).patch);
  } catch (const std::invalid_argument&) {
  } catch (const std::exception& other) {
    throw std::logic_error(std::string("not a refusal: ") + other.what());
  }
}

}  // namespace softbody::fuzz
