#include "ros/frame_change.h"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/bag_transforms.h"

namespace softbody::evaluation {
namespace {

/// The transforms of items into another frame, by stamp.
class Transforms {
 public:
  /// @param target, source frames of all items.
  Transforms(const std::vector<std::string>& bags, std::string target, std::string source)
      : bags_(bags), target_(std::move(target)), source_(std::move(source)) {}

  /// Applies `move(transform, item)` to every item. Removes items without a transform, and returns their
  /// number.
  template <typename Item, typename Move>
  std::size_t apply(std::map<Nanoseconds, Item>* items, Move move) {
    const std::size_t before = items->size();
    for (auto item = items->begin(); item != items->end();) {
      try {
        move(bags_.at(target_, source_, toTime(item->first)), &item->second);
        ++item;
      } catch (const tf2::TransformException& error) {
        reason_ = error.what();
        reason_.erase(reason_.find_last_not_of(". ") + 1);  // some messages of tf2 end with a period
        item = items->erase(item);
      }
    }
    return before - items->size();
  }

  const std::string& reason() const { return reason_; }
  std::vector<std::string> warnings() const { return bags_.warnings(target_, source_); }

 private:
  BagTransforms bags_;
  std::string target_, source_, reason_;
};

/// Notes for the report. @param items name of the items.
std::vector<std::string> notesOf(const Transforms& transforms, std::size_t left_out, std::size_t left,
                                 const std::string& items, const std::string& frame_id) {
  std::vector<std::string> notes = transforms.warnings();
  if (left_out > 0) {
    notes.push_back(fmt::format("{} of {} {} have no transform to '{}' at their stamp and were left out: {}",
                                left_out, left_out + left, items, frame_id, transforms.reason()));
  }
  return notes;
}

}  // namespace

void addNotes(const std::vector<std::string>& more, std::vector<std::string>* notes) {
  for (const std::string& note : more) {
    if (std::find(notes->begin(), notes->end(), note) == notes->end()) notes->push_back(note);
  }
}

void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, SurfaceRecord* surface,
               const std::string& states) {
  if (surface->frame_id == frame_id) return;
  if (surface->frame_id.empty() || frame_id.empty()) {
    addNotes({fmt::format("'{}' and '{}' are taken as one frame, because images without a frame_id have none",
                          surface->frame_id, frame_id)},
             &surface->notes);
    surface->frame_id = frame_id;
    return;
  }
  Transforms transforms(paths, frame_id, surface->frame_id);
  const std::size_t left_out =
      transforms.apply(&surface->states, [](const Eigen::Isometry3d& pose, MeshState* state) {
        state->vertices =
            ((state->vertices * pose.linear().transpose()).rowwise() + pose.translation().transpose()).eval();
      });
  if (surface->states.empty()) {
    std::vector<std::string> reasons = transforms.warnings();
    reasons.insert(reasons.begin(), transforms.reason());
    throw std::invalid_argument(
        fmt::format("the surface is in frame '{0}', and /tf of {1} has no transform to '{2}': {3}. If both "
                    "frames are the "
                    "same, record a /tf_static with the images (rosrun tf2_ros static_transform_publisher "
                    "0 0 0 0 0 0 {0} {2})",
                    surface->frame_id, fmt::join(paths, " and "), frame_id, fmt::join(reasons, ". ")));
  }
  addNotes(notesOf(transforms, left_out, surface->states.size(), states, frame_id), &surface->notes);
  surface->frame_id = frame_id;
}

void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, ToolRecord* tool) {
  const bool unknown = tool->frame_id.empty() || frame_id.empty();
  if (tool->poses.empty() || tool->frame_id == frame_id || unknown) return;
  Transforms transforms(paths, frame_id, tool->frame_id);
  const std::size_t left_out = transforms.apply(
      &tool->poses, [](const Eigen::Isometry3d& pose, Eigen::Isometry3d* item) { *item = pose * *item; });
  tool->notes = notesOf(transforms, left_out, tool->poses.size(), "poses of the tool", frame_id);
  tool->frame_id = frame_id;
}

}  // namespace softbody::evaluation
