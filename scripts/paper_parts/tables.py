"""The measured tables of docs/paper.md."""
from evaluation.figures import PAPER_MEAN_ERROR_MM, get, number, percent
from markdown_lines import paragraph, table
from paper_parts import methods
from paper_parts.methods import CUT_THROUGH, SCENES, TEAR, TIMED, compared, counts, parts
from paper_parts.runs import COARSE, Run

COARSE_SCENES = tuple(scene for scene in SCENES if scene.startswith("doll_"))
# Table 1 of the paper: vertices and polygons.
PAPER_SIZES = {"High-resolution": {"sponge": (522, 1040), "doll": (18650, 7190)},
               "Low-resolution": {"sponge": (132, 260), "doll": (128, 252)},
               "Volumetric": {"sponge": (132, 300), "doll": (154, 494)}}


def section(title, words, columns, rows):
    return [f"### {title}", "", *paragraph(words), "", *table(columns, rows)]


def error(report):
    return number(get(report, "vertex_error", "all", "mean_mm"))


def errors(reports, text):
    return [error(reports[Run(scene, text)]) for scene in SCENES]


def counted_features(reports, text):
    """Matched and bound features of each scene."""
    found = [reports[Run(scene, text)]["features"] for scene in SCENES]
    return [f"{number(count['matched'], 0)} of {number(count['bound'], 0)}" for count in found]


def accuracy(reports):
    rows = [["the paper's own recordings: one average", *[number(PAPER_MEAN_ERROR_MM), "", "", ""]]]
    rows += [[method, *errors(reports, text)] for method, text in compared().items()]
    return section("Accuracy", "Mean error of all vertices [mm]. \"As written\" is config/paper.yaml. Three parts of "
                               "it are ours: the first pose, the choice of features that can be seen, and the test "
                               "for outliers. The Newton step starts where inertia takes the body. Negative "
                               "eigenvalues of the stiffness are removed.",
                   ["method", *SCENES], rows)


def worth(reports):
    rows = [[words, *errors(reports, text)] for words, text in parts().items()]
    return section("What each part is worth", "Mean error of all vertices [mm]. Each row adds one part to the row "
                                              "above.", ["method", *SCENES], rows)


def simulators(reports):
    rows = [[words, *errors(reports, text)] for words, text in methods.simulators().items()]
    return section("Other simulators in the tracker's place", "Mean error of all vertices [mm] of the whole tracker "
                   "with another simulator inside: its shape is the prediction of the next frame. Targets, loads and "
                   "memory are the same. Mass-spring: springs along the edges of the tets. Their strains cannot be "
                   "smoothed, so finite elements without smoothing stand above them.",
                   ["simulator", *SCENES], rows)


def features(reports):
    rows = []
    for words, text in counts().items():
        cells = zip(errors(reports, text), counted_features(reports, text))
        rows.append([words, *(f"{error} ({found})" for error, found in cells)])
    return section("Number of features", "Mean error of all vertices [mm] for limits of `max_features`. In brackets: "
                                         "features *matched* in a frame, without outliers, *of* the features *bound* "
                                         "to the body (medians over the frames). Bound features may be on hidden "
                                         "sides. The limit is for those in view: so our tracker may bind more. It "
                                         "itself stops at four in view for each visible vertex of the volume, or at "
                                         "300. With features between frames, a limit of 1000 is the paper's N_p. At "
                                         "most so many are bound, and fewer are matched.",
                   ["features: error (matched of bound)", *SCENES], rows)


def sizes(reports):
    models = {body: reports[Run(scene)]["sizes"] for body, scene in TIMED.items()}
    rows = [[model, *(f"{of_paper[body][item]} / {models[body][model][item]}"
                      for body in ("sponge", "doll") for item in (0, 1))] for model, of_paper in PAPER_SIZES.items()]
    return section("Table 1: models", "Each cell: paper / ours. For the volume, polygons are tets.",
                   ["model", "sponge, vertices", "sponge, polygons", "doll, vertices", "doll, polygons"], rows)


def peers(compared_bodies):
    """One row for each simulator."""
    cells = {body: {words: [number(row["mean_mm"]), number(row["median_ms"])] for words, row in rows.items()}
             for body, rows in compared_bodies.items()}
    rows = [[words, *(cell for body in cells for cell in cells[body][words])] for words in next(iter(cells.values()))]
    return section("Peers", "Two hands bend sponge and soft toy up to a curvature of 5 1/m, in 60 frames: they hold "
                            "the ends, and finite elements (stable neo-Hookean) on tets eight times as fine give the "
                            "true shape between them. Each simulator gets the same targets: the vertices of the upper "
                            "side, with a noise of 0.5 mm. Mean error of all vertices of the volume, and median time "
                            "of a step. \"Ours\" is the default: projective dynamics with L-BFGS, smoothed strains "
                            "and loads. Mass-spring is a plain implementation with the same number of iterations. "
                            "As-rigid-as-possible: projective dynamics without a volume term. Loads explain what is "
                            "hidden only if forces made the shape: of a thick body that a formula bends, the others "
                            "are more accurate. The program is src/softbody_sim/bench/compare_peers.cpp.",
                   ["simulator", *(f"{body}, {what}" for body in cells for what in ("error [mm]", "time [ms]"))], rows)


def cutting(reports):
    """One row for each scene."""
    rows = []
    for scene in CUT_THROUGH:
        report = reports[Run(scene)]
        quality, surface = report["quality"], report["cut_surface"]
        sides = quality["before"], quality["after"], quality["faces"]
        rows.append([scene, " / ".join(str(side["triangles"]) for side in sides),
                     " / ".join(number(side["least_deg"]) for side in sides),
                     " / ".join(percent(side["sharp_share"]) for side in sides),
                     " / ".join(percent(side["narrow_share"]) for side in sides),
                     number(1e6 * quality["volume_change"]), quality["holes"], quality["cuts"],
                     f"{number(quality['median_ms'])} / {number(quality['worst_ms'])}",
                     f"{number(get(surface, 'distance', 'mean_mm'))} / {number(get(surface, 'distance', 'max_mm'))}"])
    return section("Cutting", "Before: triangles of the uncut surface, split by one plane through the cut. After: "
                              "triangles of the skin that touch the tracked cut. Faces: triangles that fill the cut. "
                              "Volume: change by the cut, in parts per million. Holes: edges that do not have exactly "
                              "two triangles. Time: of the frames in which the knife cut. Error: distance of the cut "
                              "surface from the true one.",
                   ["scene", "triangles, before / after / faces", "least angle, before / after / faces [degrees]",
                    "below 10 degrees, before / after / faces [%]", "below 20 degrees, before / after / faces [%]",
                    "volume [ppm]", "holes", "cuts", "time, median / worst [ms]", "error, mean / max [mm]"], rows)


def tearing(reports):
    report = reports[Run(TEAR)]
    times, surface = report["times"], report["cut_surface"]
    pieces = report["pieces"]
    rows = [[number(times["truth_s"]), ", ".join(number(time) for time in times["tears_s"]),
             f"{pieces['true_pieces']} / {pieces['result_pieces']}", percent(pieces["frames_right"]),
             f"{number(get(surface, 'distance', 'mean_mm'))} / {number(get(surface, 'distance', 'max_mm'))}",
             number(surface["tilt_deg"]), number(get(report, "vertex_error", "visible", "mean_mm"))]]
    return section("Tearing", "Scene `tear` of the virtual camera, with config/tear.yaml: the sponge is pulled at both "
                              "ends until it is 1.5 times as long in one section, and tears there. The body tears when "
                              "its stretch is surely beyond the limit, or when the features on both sides have parted: "
                              "later than the truth. The features also say where.",
                   ["true time [s]", "tears [s]", "pieces, true / found", "frames with the right number [%]",
                    "distance from the true surface, mean / max [mm]", "tilt [degrees]",
                    "error of visible vertices [mm]"], rows)


def coarse_doll(reports):
    found = [reports[Run(scene, model=COARSE)] for scene in COARSE_SCENES]
    models = found[0]["sizes"]
    rows = [[models["Low-resolution"][0], models["Volumetric"][1], *map(error, found)]]
    return section("The doll with the paper's resolution", "Mean error of all vertices [mm] of the doll with "
                   "`prepare_model --cage-vertices 128`, found without a rough pose. The paper's doll has 128 vertices "
                   "and 494 tets. Our mesher adds inner vertices, so it has more tets.",
                   ["cage vertices", "tets", *COARSE_SCENES], rows)
