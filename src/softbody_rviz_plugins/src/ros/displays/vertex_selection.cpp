#include "ros/displays/vertex_selection.h"

#include <rviz/properties/property.h>

#include <set>

namespace softbody {
namespace {

constexpr int kMostShown = 20;      // a box around the whole body selects thousands
constexpr float kBoxHalf = 0.002f;  // around a selected vertex [m]

/// rviz reads the number back from the picture; 0 means that there is nothing.
Color numberColor(std::size_t number) {
  return {static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 8),
          static_cast<std::uint8_t>(number), 255};
}

}  // namespace

VertexSelection::VertexSelection(rviz::DisplayContext* context, Mesh mesh)
    : SelectionHandler(context), mesh_(std::move(mesh)) {}

void VertexSelection::preRenderPass(uint32_t pass) {
  SelectionHandler::preRenderPass(pass);
  if (pass != 1) return;
  std::vector<Color> numbers;
  numbers.reserve(mesh_.drawn->vertexCount());
  for (std::size_t i = 1; i <= mesh_.drawn->vertexCount(); ++i) numbers.push_back(numberColor(i));
  mesh_.drawn->paint(numbers);
}

void VertexSelection::postRenderPass(uint32_t pass) {
  SelectionHandler::postRenderPass(pass);
  if (pass == 1) mesh_.drawn->paint(mesh_.colors());
}

std::vector<int> VertexSelection::verticesOf(const rviz::Picked& picked) const {
  std::set<int> vertices;
  for (const uint64_t extra : picked.extra_handles) {
    const uint64_t number = extra & 0xffffffff;
    if (number >= 1 && number <= mesh_.drawn->vertexCount())
      vertices.insert(mesh_.vertex(static_cast<int>(number) - 1));
    if (static_cast<int>(vertices.size()) == kMostShown) break;
  }
  return {vertices.begin(), vertices.end()};
}

void VertexSelection::createProperties(const rviz::Picked& picked, rviz::Property* parent) {
  shown_.clear();
  for (const int vertex : verticesOf(picked)) {
    auto* group = new rviz::Property("Vertex " + QString::number(vertex), QVariant(), "", parent);
    properties_.push_back(group);
    shown_.emplace_back(vertex, group);
    for (const auto& [name, value] : mesh_.rows(vertex)) {
      auto* row = new rviz::Property(QString::fromStdString(name), QString::fromStdString(value), "", group);
      row->setReadOnly(true);
    }
    group->expand();
  }
}

void VertexSelection::updateProperties() {
  for (const auto& [vertex, group] : shown_) {
    const VertexRows rows = mesh_.rows(vertex);
    for (std::size_t i = 0; i < rows.size() && static_cast<int>(i) < group->numChildren(); ++i)
      group->childAt(static_cast<int>(i))->setValue(QString::fromStdString(rows[i].second));
  }
}

void VertexSelection::getAABBs(const rviz::Picked& picked, rviz::V_AABB& boxes) {
  for (const int vertex : verticesOf(picked)) {
    const Ogre::Vector3 place = mesh_.place(vertex), half(kBoxHalf);
    boxes.emplace_back(place - half, place + half);
  }
}

}  // namespace softbody
