#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace softbody::fuzz {

/// Gives any bytes to one reader. A reader may refuse them with a sentence; anything else is a fault.
struct Feed {
  std::string name;
  /// @throw std::logic_error if the reader threw something that is not a refusal with a sentence.
  void (*give)(std::string_view bytes);
};

/// All readers of files.
const std::vector<Feed>& feeds();

/// @throw std::out_of_range if there is no such feed.
const Feed& feed(std::string_view name);

void giveSurface(const char* extension, std::string_view bytes);
void giveTets(const char* extension, std::string_view bytes);
void giveTetGen(std::string_view bytes);
void giveObjectYaml(std::string_view bytes);
void giveToolYaml(std::string_view bytes);
void giveCameraYaml(std::string_view bytes);
void giveParameters(std::string_view bytes);

}  // namespace softbody::fuzz
