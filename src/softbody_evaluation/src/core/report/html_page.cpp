#include "softbody_evaluation/report/html_page.h"

#include <fmt/format.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

namespace softbody::evaluation {
namespace {

std::string base64(const std::vector<unsigned char>& bytes) {
  namespace iterators = boost::archive::iterators;
  using Encoder = iterators::base64_from_binary<
      iterators::transform_width<std::vector<unsigned char>::const_iterator, 6, 8>>;
  // The encoder reads whole groups of three bytes.
  std::vector<unsigned char> padded = bytes;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  padded.resize(bytes.size() + padding, 0);
  std::string text(Encoder(padded.begin()), Encoder(padded.end()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string cell(const std::optional<double>& value) {
  return value && !std::isnan(*value) ? fmt::format("<td>{:.4f}</td>", *value) : std::string("<td>-</td>");
}

std::string table(const std::vector<ComparedFigure>& rows) {
  bool compared = false;
  for (const ComparedFigure& row : rows) compared = compared || row.second;
  std::string html = "<table><tr><th>figure</th><th>unit</th><th>result</th>";
  html += compared ? "<th>other</th></tr>\n" : "</tr>\n";
  for (const ComparedFigure& row : rows) {
    html += fmt::format("<tr><td>{}</td><td>{}</td>{}{}</tr>\n", escaped(row.name), escaped(row.unit),
                        cell(row.first), compared ? cell(row.second) : "");
  }
  return html + "</table>\n";
}

std::string image(const std::string& name, const cv::Mat3b& picture) {
  // JPEG blurs lines, so it is used only if it is much smaller.
  std::vector<unsigned char> png, jpeg;
  cv::imencode(".png", picture, png);
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 90});
  const bool as_png = png.size() <= 2 * jpeg.size();
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/{1};base64,{2}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(name), as_png ? "png" : "jpeg", base64(as_png ? png : jpeg));
}

/// Each picture of the first result beside the same picture of the other result.
std::string inPairs(const Pictures& pictures) {
  const std::string other = "other_";
  std::string html;
  for (const auto& [name, picture] : pictures) {
    const bool is_second = name.compare(0, other.size(), other) == 0;
    if (is_second && pictures.count(name.substr(other.size())) > 0) continue;
    html += "<div>\n";
    if (!picture.empty()) html += image(name, picture);
    const auto second = pictures.find(other + name);
    if (second != pictures.end() && !second->second.empty()) html += image(second->first, second->second);
    html += "</div>\n";
  }
  return html;
}

}  // namespace

std::string htmlPage(const std::string& title, const std::vector<ComparedFigure>& rows,
                     const std::string& text, const Pictures& pictures) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
      "</title>\n<style>body{font-family:sans-serif;margin:2em;max-width:75em}td,th{padding:.15em "
      ".8em;text-align:"
      "left;border-bottom:1px solid "
      "#ddd}td:nth-child(n+3),th:nth-child(n+3){text-align:right}td:nth-child(n+3){font-family:monospace}img{"
      "max-width:100%}"
      "div{display:flex;gap:1em}figure{margin:1em "
      "0;min-width:0}pre{overflow-x:auto}</style></head>\n<body><h1>" +
      escaped(title) + "</h1>\n" + table(rows) + "<pre>" + escaped(text) + "</pre>\n";
  return page + inPairs(pictures) + "</body></html>\n";
}

}  // namespace softbody::evaluation
