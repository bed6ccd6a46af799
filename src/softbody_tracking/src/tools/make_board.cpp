#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "marker_board/marker_board.h"
#include "marker_board/marker_board_drawing.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_tracking/tool/marker_detector.h"

int main(int argc, char** argv) {
  std::vector<int> ids;
  bool sheet = false;
  double size_mm = 0.0;
  std::string dictionary, paper = "a4", output;
  CLI::App app(
      "Makes a sheet of markers to print: OUTPUT.pdf and OUTPUT.svg, to scale, and the tool YAML "
      "OUTPUT.yaml");
  app.add_flag("--sheet", sheet,
               "a ring of markers along the edges; an object to scan lies in the free middle");
  app.add_option("--id", ids, "ids of the markers, all different; with --sheet default: from 50 on");
  app.add_option("--size-mm", size_mm,
                 "side of a marker's black square [mm]; default: 64, with --sheet 2/15 of the paper's width")
      ->check(CLI::Range(3.0, 1000.0));
  app.add_option("--dictionary", dictionary,
                 "an OpenCV name (DICT_...), or a dictionary file in OpenCV's format; default: DICT_4X4_50, "
                 "with --sheet DICT_4X4_100");
  app.add_option("--paper", paper, "size of the sheet")
      ->check(CLI::IsMember(softbody::paperNames()))
      ->capture_default_str();
  app.add_option("--output", output, "path of the output files, without an extension")->required();
  app.callback([&] {
    if (ids.empty() && !sheet) throw CLI::RequiredError("--id (or --sheet)");
  });
  return softbody::runTool(&app, argc, argv, [&] {
    if (dictionary.empty()) dictionary = sheet ? "DICT_4X4_100" : "DICT_4X4_50";
    if (size_mm == 0.0 && !sheet) size_mm = 64.0;
    const softbody::MarkerBoard board = sheet ? softbody::layOutSheet(dictionary, ids, 1e-3 * size_mm, paper)
                                              : softbody::layOutBoard(dictionary, ids, 1e-3 * size_mm, paper);
    softbody::writeBoardPdf(board, output + ".pdf");
    softbody::writeBoardSvg(board, output + ".svg");
    softbody::replaceFile(output + ".yaml", softbody::boardYaml(board));
    fmt::print("wrote {0}.pdf, {0}.svg, {0}.yaml\n", output);
    return 0;
  });
}
