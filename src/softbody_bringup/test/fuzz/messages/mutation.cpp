#include "fuzz/messages/mutation.h"

#include <cmath>

namespace softbody::fuzz {
namespace {

template <typename Float>
void changeFloat(Float* value, Choice* choice) {
  using Limits = std::numeric_limits<Float>;
  const Float old = *value, share = static_cast<Float>(choice->below(2001)) / Float{1000} - Float{1};
  const Float odd[] = {0,
                       -old,
                       Limits::quiet_NaN(),
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::max(),
                       Limits::lowest(),
                       Limits::denorm_min(),
                       static_cast<Float>(1e20),
                       static_cast<Float>(9e3),
                       old * static_cast<Float>(1.0 + 1e-4),
                       old * 1000,
                       old + 1,
                       old + share,
                       old * share,
                       share};
  *value = odd[choice->below(std::size(odd))];
}

const char* const kTexts[] = {"",
                              " ",
                              "/",
                              "world",
                              "camera_color_optical_frame",
                              "softbody",
                              "tool",
                              "a",
                              "a/b",
                              "\xff",
                              "mono8",
                              "rgb8",
                              "bgr8",
                              "rgba8",
                              "mono16",
                              "16UC1",
                              "32FC1",
                              "8UC3",
                              "64FC4",
                              "32SC1",
                              "8UC",
                              "99UC1",
                              "16UC99",
                              "bayer_rggb8",
                              "yuv422",
                              "plumb_bob",
                              "equidistant",
                              "rational_polynomial",
                              "none",
                              "body",
                              "grip",
                              "%s%n{}"};

}  // namespace

void change(float* value, Choice* choice) { changeFloat(value, choice); }
void change(double* value, Choice* choice) { changeFloat(value, choice); }

void change(std::string* value, Choice* choice) {
  switch (choice->below(5)) {
    case 0:
      *value = std::string(choice->below(2000), 'x');
      return;
    case 1:
      *value += '\0';
      return;
    case 2:
      *value = "/" + *value;
      return;
    default:
      *value = kTexts[choice->below(std::size(kTexts))];
  }
}

void change(ros::Time* value, Choice* choice) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const auto shift = [&](double seconds) {
    const double shifted = value->toSec() + seconds;
    if (shifted > 0.0 && shifted < kMost) value->fromSec(shifted);
  };
  switch (choice->below(12)) {
    case 0:
      return void(*value = ros::Time());
    case 1:
      return void(value->sec = kMost);
    case 2:
      value->sec = value->nsec = kMost;  // as on the wire: more than a second of nanoseconds
      return;
    case 3:
      return void(value->nsec = static_cast<std::uint32_t>(choice->bits()));
    case 4:
      return void(value->sec = static_cast<std::uint32_t>(choice->bits()));
    case 5:
      return void(value->sec = kMost / 2);
    case 6:
      return void(++value->nsec);
    case 7:
      return void(--value->nsec);
    case 8:
      return shift(-0.1);
    case 9:
      return shift(0.1);
    case 10:
      return shift(-3.0);
    default:
      return shift(3.0);
  }
}

void change(ros::Duration* value, Choice* choice) {
  change(&value->sec, choice);
  change(&value->nsec, choice);
}

}  // namespace softbody::fuzz
