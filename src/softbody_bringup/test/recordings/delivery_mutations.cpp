#include "recordings/mutations.h"

namespace softbody::recordings {
namespace {

Change onFrames(const std::function<void(Frame*)>& change) {
  return [change](Recording* recording, Random*) {
    for (Frame& frame : recording->frames) change(&frame);
  };
}

/// Changes some frames after the first ones.
Change onSome(std::size_t every, const std::function<void(Frame*)>& change) {
  return [every, change](Recording* recording, Random* random) {
    const std::size_t first = 3 + (*random)() % every;
    for (std::size_t k = first; k < recording->frames.size(); k += every) change(&recording->frames[k]);
  };
}

std::vector<Mutation> stampMutations() {
  const int stamps = Mutation::kStamps;
  const ros::Time wild(4294967295u, 0);
  return {{"wild stamps of colour", true, stamps, onSome(7, [=](Frame* f) { f->color->header.stamp = wild; }),
           true},
          {"wild stamps of depth", true, stamps, onSome(7, [=](Frame* f) { f->depth->header.stamp = wild; }),
           true},
          {"zero stamps of some images", true, stamps,
           onSome(6, [](Frame* f) { f->color->header.stamp = ros::Time(); }), true},
          {"zero stamps of colour", false, stamps,
           onFrames([](Frame* f) { f->color->header.stamp = ros::Time(); })},
          {"zero stamps of depth", false, stamps,
           onFrames([](Frame* f) { f->depth->header.stamp = ros::Time(); })},
          {"stamps before 1970", true, stamps,
           onSome(6, [](Frame* f) { f->depth->header.stamp = ros::Time(1, 0); }), true},
          {"repeated stamps", true, stamps,
           onSome(6, [](Frame* f) { f->depth->header.stamp -= ros::Duration(1.0 / 30.0); }), true},
          {"depth 8 ms later", true, stamps,
           onFrames([](Frame* f) { f->depth->header.stamp += ros::Duration(0.008); })},
          {"depth half a frame later", false, stamps,
           onFrames([](Frame* f) { f->depth->header.stamp += ros::Duration(0.0165); })},
          {"depth an hour later", false, stamps,
           onFrames([](Frame* f) { f->depth->header.stamp += ros::Duration(3600.0); })},
          {"recorded by another clock", true, stamps,
           onFrames([](Frame* f) { f->received += ros::Duration(5000.0); })}};
}

std::vector<Mutation> lossMutations() {
  const int losses = Mutation::kStamps | Mutation::kColorPixels | Mutation::kDepthPixels | Mutation::kInfo |
                     Mutation::kFrames;
  const auto infoOnce = [](std::size_t number) {
    return [number](Recording* recording, Random*) {
      for (std::size_t k = 0; k < recording->frames.size(); ++k) {
        recording->frames[k].depth_info.reset();
        if (k != number) recording->frames[k].color_info.reset();
      }
    };
  };
  return {{"lost colour", true, losses, onSome(5, [](Frame* f) { f->color.reset(); }), true},
          {"lost depth", true, losses, onSome(4, [](Frame* f) { f->depth.reset(); }), true},
          {"depth at half the rate", true, losses, onSome(2, [](Frame* f) { f->depth.reset(); }), true},
          {"no colour", false, losses, onFrames([](Frame* f) { f->color.reset(); })},
          {"no depth", false, losses, onFrames([](Frame* f) { f->depth.reset(); })},
          {"no camera_info", false, losses, onFrames([](Frame* f) { f->color_info.reset(); })},
          {"no camera_info of depth", true, losses, onFrames([](Frame* f) { f->depth_info.reset(); })},
          {"camera_info once at the start", true, losses, infoOnce(0)},
          {"camera_info once and late", true, losses, infoOnce(15)},
          {"some damaged images", true, losses, onSome(6, [](Frame* f) { f->color->data.resize(99); }), true},
          {"some unknown encodings", true, losses, onSome(6, [](Frame* f) { f->depth->encoding = "12UC1"; }),
           true}};
}

std::vector<Mutation> nameMutations() {
  const int frames = Mutation::kFrames, topics = Mutation::kTopics, file = Mutation::kFile;
  return {{"leading slashes", true, frames, onFrames([](Frame* f) {
             f->color->header.frame_id = f->depth->header.frame_id = "/camera_color_optical_frame";
           })},
          {"leading slash of depth", true, frames,
           onFrames([](Frame* f) { f->depth->header.frame_id = "/camera_color_optical_frame"; })},
          {"leading slashes of some images", true, frames,
           onSome(2,
                  [](Frame* f) {
                    f->color->header.frame_id = f->depth->header.frame_id = "/camera_color_optical_frame";
                  })},
          {"no frames", true, frames,
           onFrames([](Frame* f) { f->color->header.frame_id = f->depth->header.frame_id = ""; })},
          {"depth without a frame", true, frames, onFrames([](Frame* f) { f->depth->header.frame_id = ""; })},
          {"two frames of colour", false, frames,
           onSome(2,
                  [](Frame* f) {
                    f->color->header.frame_id = f->depth->header.frame_id = "other_optical_frame";
                  })},
          {"other topics", true, topics,
           [](Recording* r, Random*) {
             const double depth_scale = r->options.depth_scale;
             r->topics = r->options = CameraTopics("/kinect2/hd");
             r->options.depth_scale = depth_scale;
           }},
          {"other topics, not named", false, topics,
           [](Recording* r, Random*) { r->topics = CameraTopics("/kinect2/hd"); }},
          {"another definition", false, file,
           [](Recording* r, Random*) { r->md5sum = "0123456789abcdef0123456789abcdef"; }},
          {"truncated", false, file,
           [](Recording* r, Random* random) { r->cut_bytes = 1000 + (*random)() % 2'000'000; }}};
}

}  // namespace

std::vector<Mutation> deliveryMutations() {
  std::vector<Mutation> all = stampMutations();
  for (const auto& more : {lossMutations(), nameMutations()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace softbody::recordings
