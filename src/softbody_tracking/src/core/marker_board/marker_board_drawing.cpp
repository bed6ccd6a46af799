#include "marker_board/marker_board_drawing.h"

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

constexpr double kFaint = 0.6;          // grey of what is drawn on the free middle of a sheet
constexpr double kShortRuler_m = 0.05;  // [m] fits on the free middle of A5

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
}

void drawLabel(cairo_t* page, const std::string& dictionary, const ToolMarker& marker, double x, double y) {
  const double cell = marker.size_m / markerCells(dictionary, marker.id).cols;
  cairo_set_source_rgb(page, 0, 0, 0);
  drawText(page, x, y + marker.size_m + cell + kTextHeight_m,
           fmt::format("{}  id {}  {:g} mm", dictionary, marker.id, 1e3 * marker.size_m));
}

/// With a tick at each centimetre.
void drawRuler(cairo_t* page, double x, double y, double length_m) {
  cairo_set_line_width(page, kLine_m);
  cairo_move_to(page, x, y);
  cairo_line_to(page, x + length_m, y);
  for (int i = 0; 0.01 * i <= length_m + kLine_m; ++i) {
    cairo_move_to(page, x + 0.01 * i, y);
    cairo_line_to(page, x + 0.01 * i, y - (i % 5 == 0 ? 0.004 : 0.002));
  }
  cairo_stroke(page);
}

void drawBottom(cairo_t* page, const MarkerBoard& board) {
  const double x = 0.5 * (board.paper_width_m - kRuler_m), y = board.paper_height_m - kRulerFromBottom_m;
  drawRuler(page, x, y, kRuler_m);
  drawText(page, x, y + 0.006,
           "Measure this line. If it is not 100 mm long, print again at 100 %, without fitting to the page.");
}

/// Outline, text and ruler on the free middle, all in grey: the object lies there.
void drawFreeMiddle(cairo_t* page, const MarkerBoard& sheet) {
  constexpr double kInset = 0.005, kLineHeight = 0.005;  // [m]
  const double left = 0.5 * (sheet.paper_width_m - sheet.free_width_m),
               top = 0.5 * (sheet.paper_height_m - sheet.free_height_m);
  cairo_set_source_rgb(page, kFaint, kFaint, kFaint);
  cairo_set_line_width(page, kLine_m);
  cairo_rectangle(page, left, top, sheet.free_width_m, sheet.free_height_m);
  cairo_stroke(page);
  const double x = left + kInset;
  double y = top + kInset + kTextHeight_m;
  const std::string name =
      fmt::format("{}, id {} ..., {:g} mm", sheet.tool.dictionary, sheet.tool.markers.front().id,
                  1e3 * sheet.tool.markers.front().size_m);
  for (const std::string& line : {std::string("Put the object here."), name}) {
    drawText(page, x, y, line);
    y += kLineHeight;
  }
  y = top + sheet.free_height_m - kInset - 3.0 * kLineHeight;
  drawRuler(page, x, y, kShortRuler_m);
  for (const char* line :
       {"Measure: this line is 50 mm long.", "If not, print again at 100 %,", "without fitting to the page."})
    drawText(page, x, y += kLineHeight, line);
}

/// @param scale units of the cairo surface per metre.
void draw(const MarkerBoard& board, double scale, cairo_surface_t* surface) {
  const Context page(cairo_create(surface), &cairo_destroy);
  cairo_scale(page.get(), scale, scale);
  cairo_set_source_rgb(page.get(), 1, 1, 1);
  cairo_paint(page.get());
  cairo_select_font_face(page.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  const bool sheet = board.free_width_m > 0.0;
  for (const ToolMarker& marker : board.tool.markers) {
    const Eigen::Vector3d at = marker.T_tool_marker.translation();
    const double x = 0.5 * (board.paper_width_m - marker.size_m) + at.x(),
                 y = 0.5 * (board.paper_height_m - marker.size_m) - at.y();
    drawMarker(page.get(), board.tool.dictionary, marker, x, y);
    if (!sheet) drawLabel(page.get(), board.tool.dictionary, marker, x, y);
  }
  sheet ? drawFreeMiddle(page.get(), board) : drawBottom(page.get(), board);
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
