#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "softbody_common/files/staged_output.h"
#include "softbody_common/run_tool.h"
#include "softbody_tracking/marker_board/marker_board.h"
#include "softbody_tracking/marker_board/marker_board_drawing.h"
#include "softbody_tracking/tool/marker_detector.h"

int main(int argc, char** argv) {
  std::vector<int> ids;
  double size_mm = 64.0;
  std::string dictionary = "DICT_4X4_50", paper = "a4", output;
  CLI::App app(
      "Makes a sheet of markers to print: OUTPUT.pdf and OUTPUT.svg, to scale, and the tool YAML "
      "OUTPUT.yaml");
  app.add_option("--id", ids, "ids of the markers, all different")->required();
  app.add_option("--size-mm", size_mm, "side of a marker's black square [mm]")
      ->check(CLI::Range(3.0, 1000.0))
      ->capture_default_str();
  app.add_option("--dictionary", dictionary,
                 "an OpenCV name (DICT_...), or a dictionary file in OpenCV's format")
      ->capture_default_str();
  app.add_option("--paper", paper, "size of the sheet")
      ->check(CLI::IsMember(softbody::paperNames()))
      ->capture_default_str();
  app.add_option("--output", output, "path of the output files, without an extension")->required();
  return softbody::runTool(&app, argc, argv, [&] {
    const softbody::MarkerBoard board = softbody::layOutBoard(dictionary, ids, 1e-3 * size_mm, paper);
    softbody::writeBoardPdf(board, output + ".pdf");
    softbody::writeBoardSvg(board, output + ".svg");
    softbody::replaceFile(output + ".yaml", softbody::boardYaml(board));
    fmt::print("wrote {0}.pdf, {0}.svg, {0}.yaml\n", output);
    return 0;
  });
}
