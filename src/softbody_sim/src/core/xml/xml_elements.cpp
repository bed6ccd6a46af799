#include "xml/xml_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace softbody {
namespace {

constexpr std::size_t kMostNested = 64;  ///< mesh files need less than ten
constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kAfterName = " \t\r\n/>=<";

class XmlReader {
 public:
  XmlReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  std::vector<XmlElement> read() {
    for (;;) {
      const std::size_t tag = text_.find('<', at_);
      if (tag == std::string_view::npos) break;
      addText(tag);
      at_ = tag;
      readMarkup();
    }
    if (elements_.empty()) fail("it has no element");
    if (!open_.empty())
      fail(fmt::format("the file ends before </{}>", elements_[static_cast<std::size_t>(open_.back())].name));
    return std::move(elements_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    throw std::invalid_argument(
        fmt::format("{}:{}: not XML: {}", path_, 1 + std::count(text_.begin(), end, '\n'), what));
  }

  bool startsWith(std::string_view word) const { return text_.substr(at_, word.size()) == word; }

  void skipPast(std::string_view word) {
    const std::size_t found = text_.find(word, at_);
    if (found == std::string_view::npos) fail(fmt::format("the file ends before '{}'", word));
    at_ = found + word.size();
  }

  void skipSpace() { at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size()); }

  void readMarkup() {
    if (startsWith("<!--")) {
      skipPast("-->");
    } else if (startsWith("<?")) {
      skipPast("?>");
    } else if (startsWith("<!")) {
      fail("document types and CDATA are not supported");
    } else if (startsWith("</")) {
      closeElement();
    } else {
      openElement();
    }
  }

  std::string_view name() {
    const std::size_t end = std::min(text_.find_first_of(kAfterName, at_), text_.size());
    if (end == at_) fail("a name is missing");
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  void openElement() {
    ++at_;
    if (open_.empty() && !elements_.empty()) fail("there is more than one root element");
    const int index = static_cast<int>(elements_.size());
    if (!open_.empty()) elements_[static_cast<std::size_t>(open_.back())].children.push_back(index);
    elements_.push_back({name(), {}, {}, {}});
    readAttributes(&elements_.back());
    const bool is_empty = startsWith("/");
    if (is_empty) ++at_;
    if (!startsWith(">")) fail(fmt::format("<{}> does not end", elements_.back().name));
    ++at_;
    if (!is_empty) open_.push_back(index);
    if (open_.size() > kMostNested) fail(fmt::format("more than {} elements lie in each other", kMostNested));
  }

  void readAttributes(XmlElement* element) {
    for (skipSpace(); at_ < text_.size() && text_[at_] != '/' && text_[at_] != '>'; skipSpace()) {
      const std::string_view key = name();
      skipSpace();
      if (!startsWith("=")) fail(fmt::format("the attribute {} has no value", key));
      ++at_;
      skipSpace();
      const std::string_view quote = text_.substr(at_, 1);
      if (quote != "\"" && quote != "'") fail(fmt::format("the value of {} is not in quotes", key));
      const std::size_t begin = ++at_;
      skipPast(quote);
      element->attributes.emplace(key, text_.substr(begin, at_ - 1 - begin));
    }
  }

  void closeElement() {
    at_ += 2;
    const std::string_view closed = name();
    if (open_.empty() || elements_[static_cast<std::size_t>(open_.back())].name != closed)
      fail(fmt::format("</{}> does not belong to the last open element", closed));
    skipSpace();
    if (!startsWith(">")) fail(fmt::format("</{}> does not end", closed));
    ++at_;
    open_.pop_back();
  }

  void addText(std::size_t end) {
    if (open_.empty()) return;
    elements_[static_cast<std::size_t>(open_.back())].text += text_.substr(at_, end - at_);
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
  std::vector<XmlElement> elements_;
  std::vector<int> open_;
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string_view() : found->second;
}

std::vector<XmlElement> xmlElements(std::string_view text, const std::string& path) {
  return XmlReader(text, path).read();
}

}  // namespace softbody
