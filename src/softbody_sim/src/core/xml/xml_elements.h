#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace softbody {

/// An element of an XML file. The views refer to the file's text.
struct XmlElement {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;
  std::string text;           ///< without the children
  std::vector<int> children;  ///< indices of elements

  /// Empty if there is no such attribute.
  std::string_view attribute(std::string_view key) const;
};

/// All elements of an XML text in the order of the file; the first one is the root. Entities stay as they
/// are; comments and processing instructions are skipped. Elements may lie in each other 64 deep.
/// @param text must live as long as the elements. @throw std::invalid_argument with path, line and error.
std::vector<XmlElement> xmlElements(std::string_view text, const std::string& path);

}  // namespace softbody
