#include "softbody_tracking/marker_board/marker_board_drawing.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "softbody_common/files/staged_output.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

constexpr double kPointsPerMetre = 72.0 / 0.0254;  // unit of PDF and SVG: 1/72 inch
constexpr double kRuler_m = 0.1;                   // [m] long enough to see a wrong scale, and fits on A5
constexpr double kRulerFromBottom_m = 0.020;       // [m] leaves room for the text below the ruler
constexpr double kLine_m = 0.0002;                 // [m] width of the ruler's lines
constexpr double kTextHeight_m = 0.0035;           // [m] about 10 points

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void drawText(cairo_t* page, double x, double y, const std::string& text) {
  cairo_set_font_size(page, kTextHeight_m);
  cairo_move_to(page, x, y);
  cairo_show_text(page, text.c_str());
}

/// Fills the square black, then all white cells as one path, so that no seams show between them.
void drawMarker(cairo_t* page, const std::string& dictionary, const ToolMarker& marker, double x, double y) {
  const cv::Mat1b cells = markerCells(dictionary, marker.id);
  const double cell = marker.size_m / cells.cols;
  cairo_set_source_rgb(page, 0, 0, 0);
  cairo_rectangle(page, x, y, marker.size_m, marker.size_m);
  cairo_fill(page);
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.cols; ++column) {
      if (cells(row, column) > 127) cairo_rectangle(page, x + column * cell, y + row * cell, cell, cell);
    }
  }
  cairo_set_source_rgb(page, 1, 1, 1);
  cairo_fill(page);
  cairo_set_source_rgb(page, 0, 0, 0);
  drawText(page, x, y + marker.size_m + cell + kTextHeight_m,
           fmt::format("{}  id {}  {:g} mm", dictionary, marker.id, 1e3 * marker.size_m));
}

void drawRuler(cairo_t* page, double x, double y) {
  cairo_set_line_width(page, kLine_m);
  cairo_move_to(page, x, y);
  cairo_line_to(page, x + kRuler_m, y);
  for (int i = 0; i <= 10; ++i) {
    cairo_move_to(page, x + 0.1 * i * kRuler_m, y);
    cairo_line_to(page, x + 0.1 * i * kRuler_m, y - (i % 5 == 0 ? 0.004 : 0.002));
  }
  cairo_stroke(page);
  drawText(page, x, y + 0.006,
           "Measure this line. If it is not 100 mm long, print again at 100 %, without fitting to the page.");
}

/// @param scale units of the cairo surface per metre.
void draw(const MarkerBoard& board, double scale, cairo_surface_t* surface) {
  const Context page(cairo_create(surface), &cairo_destroy);
  cairo_scale(page.get(), scale, scale);
  cairo_set_source_rgb(page.get(), 1, 1, 1);
  cairo_paint(page.get());
  cairo_select_font_face(page.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  for (const ToolMarker& marker : board.tool.markers) {
    const Eigen::Vector3d at = marker.T_tool_marker.translation();
    drawMarker(page.get(), board.tool.dictionary, marker,
               0.5 * (board.paper_width_m - marker.size_m) + at.x(),
               0.5 * (board.paper_height_m - marker.size_m) - at.y());
  }
  drawRuler(page.get(), 0.5 * (board.paper_width_m - kRuler_m), board.paper_height_m - kRulerFromBottom_m);
  cairo_show_page(page.get());
}

using Maker = cairo_surface_t* (*)(const char*, double, double);

void write(const MarkerBoard& board, const std::filesystem::path& path, Maker make) {
  StagedFile file(path);
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  {
    const Surface surface(make(file.path().c_str(), board.paper_width_m * kPointsPerMetre,
                               board.paper_height_m * kPointsPerMetre),
                          &cairo_surface_destroy);
    draw(board, kPointsPerMetre, surface.get());
    cairo_surface_finish(surface.get());
    status = cairo_surface_status(surface.get());
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written: {}", path.string(), cairo_status_to_string(status)));
  }
  file.commit();
}

}  // namespace

void writeBoardPdf(const MarkerBoard& board, const std::filesystem::path& path) {
  write(board, path, &cairo_pdf_surface_create);
}

void writeBoardSvg(const MarkerBoard& board, const std::filesystem::path& path) {
  write(board, path, &cairo_svg_surface_create);
}

cv::Mat1b boardImage(const MarkerBoard& board, double dots_per_inch) {
  const double scale = dots_per_inch / 0.0254;
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(board.paper_width_m * scale),
                                 static_cast<int>(board.paper_height_m * scale)),
      &cairo_surface_destroy);
  draw(board, scale, surface.get());
  cairo_surface_flush(surface.get());
  const cv::Mat4b pixels(cairo_image_surface_get_height(surface.get()),
                         cairo_image_surface_get_width(surface.get()),
                         reinterpret_cast<cv::Vec4b*>(cairo_image_surface_get_data(surface.get())),
                         static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())));
  cv::Mat1b gray(pixels.size());
  std::transform(pixels.begin(), pixels.end(), gray.begin(), [](const cv::Vec4b& p) { return p[1]; });
  return gray;
}

}  // namespace softbody
