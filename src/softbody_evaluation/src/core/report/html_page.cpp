#include "report/html_page.h"

#include <fmt/format.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "report/metric_meaning.h"

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

/// The class of a cell or a box, which gives its colour.
std::string classOf(Level level) { return level == Level::kGood ? "" : " class=" + toText(level); }

std::string cell(const std::string& metric, const std::optional<double>& value) {
  if (!value || std::isnan(*value)) return "<td>-</td>";
  return fmt::format("<td{}>{:.4g}</td>", classOf(levelOf(metric, *value)), *value);
}

std::string table(const std::vector<ComparedMetric>& rows) {
  bool compared = false;
  for (const ComparedMetric& row : rows) compared = compared || row.second;
  std::string html = "<table><tr><th>metric</th><th>unit</th><th>result</th>";
  html += compared ? "<th>other</th>" : "";
  html += "<th>limits</th><th>meaning</th></tr>\n";
  for (const ComparedMetric& row : rows) {
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td>{}{}<td>{}</td><td>{}</td></tr>\n", escaped(row.name),
                    escaped(row.unit), cell(row.name, row.first), compared ? cell(row.name, row.second) : "",
                    limitsOf(row.name), escaped(meaningOf(row.name)));
  }
  return html + "</table>\n";
}

std::string verdictBox(const JudgedResult& result) {
  std::string html = fmt::format("<section class={0}><h2>{1}: {0}</h2>\n", toText(result.verdict.level),
                                 escaped(result.name));
  if (!result.verdict.premise.empty()) html += "<p>" + escaped(result.verdict.premise) + "</p>\n";
  if (result.verdict.findings.empty()) html += "<p>No metric is beyond its limits.</p>\n";
  html += "<ul>";
  for (const Finding& finding : result.verdict.findings)
    html += "<li>" + escaped(finding.sentence) + "</li>\n";
  for (const std::string& limit : result.verdict.limits) html += "<li>" + escaped(limit) + "</li>\n";
  return html + "</ul></section>\n";
}

std::string frameImage(const char* what, const cv::Mat3b& picture) {
  if (picture.empty()) return {};
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  return fmt::format("<img alt=\"{}\" src=\"data:image/jpeg;base64,{}\">", what, base64(jpeg));
}

/// All frames, of which the slider shows one.
std::string filmBox(const JudgedResult& result) {
  if (result.film.empty()) return {};
  std::string html = fmt::format(
      "<h2>Film of {}</h2>\n<p>Left: the camera image with the outline of the mesh (green) and lines that "
      "are "
      "fixed to the body. The lines must stay on the same texture. Right: the mesh from four sides; the "
      "colour "
      "is the error, grey is not measured.</p>\n<section class=film><p><button>play</button> <input "
      "type=range min=0 max={} value=0 aria-label=frame></p>\n",
      escaped(result.name), result.film.size() - 1);
  bool first = true;
  for (const FilmFrame& frame : result.film) {
    html += fmt::format("<article{}><p>{}</p><div>{}{}</div></article>\n", first ? "" : " hidden",
                        escaped(frame.caption), frameImage("overlay", frame.overlay),
                        frameImage("error from four sides", frame.sides));
    first = false;
  }
  return html + "</section>\n";
}

constexpr char kHead[] = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy"
 content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<style>
body{font-family:sans-serif;margin:2em;max-width:80em}
td,th{padding:.15em .8em;text-align:left;border-bottom:1px solid #ddd}
img{max-width:100%;align-self:flex-start}div{display:flex;gap:1em}
figure{margin:1em 0;min-width:0}pre{overflow-x:auto}
section{padding:.2em 1em;border-left:.6em solid #bbb}
section.good{border-color:#2a8a2a;background:#eef8ee}
.suspect{border-color:#d08a00;background:#fff4dc}
.wrong{border-color:#c02020;background:#fde6e6}
input{width:60%;vertical-align:middle}
</style>
)html";

constexpr char kScript[] = R"html(<script>
for (const film of document.querySelectorAll(".film")) {
  const slider = film.querySelector("input"), button = film.querySelector("button");
  const frames = film.querySelectorAll("article");
  let timer = 0;
  const show = () => frames.forEach((frame, i) => { frame.hidden = i != slider.value; });
  slider.oninput = show;
  button.onclick = () => {
    button.textContent = timer ? "play" : "stop";
    if (timer) { clearInterval(timer); timer = 0; return; }
    timer = setInterval(() => { slider.value = (+slider.value + 1) % frames.length; show(); }, 150);
  };
}
</script>
)html";

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

std::string htmlPage(const std::vector<JudgedResult>& results, const std::vector<ComparedMetric>& rows,
                     const std::string& text, const Pictures& pictures) {
  std::string title, verdicts, films;
  for (const JudgedResult& result : results) {
    title += (title.empty() ? "Evaluation of " : " beside ") + escaped(result.name);
    verdicts += verdictBox(result);
    films += filmBox(result);
  }
  return kHead + fmt::format("<title>{0}</title></head>\n<body><h1>{0}</h1>\n", title) + verdicts + films +
         "<h2>Metrics</h2>\n" + table(rows) + "<h2>Plots</h2>\n" + inPairs(pictures) +
         "<h2>Details</h2>\n<pre>" + escaped(text) + "</pre>\n" + kScript + "</body></html>\n";
}

}  // namespace softbody::evaluation
