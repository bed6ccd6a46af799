"""The rows of the measured tables in docs/paper.md."""
from evaluation.figures import PAPER_MEAN_ERROR_MM, get
from pages import number, percent
from paper_parts import methods
from paper_parts.methods import CUT_THROUGH, SCENES, TEAR, TIMED, compared, counts, parts
from paper_parts.runs import COARSE, Run

COARSE_SCENES = tuple(scene for scene in SCENES if scene.startswith("doll_"))
# Table 1 of the paper: vertices and polygons.
PAPER_SIZES = {"High-resolution": {"sponge": (522, 1040), "doll": (18650, 7190)},
               "Low-resolution": {"sponge": (132, 260), "doll": (128, 252)},
               "Volumetric": {"sponge": (132, 300), "doll": (154, 494)}}


def error(report):
    return number(get(report, "vertex_error.all.mean_mm"))


def errors(reports, text):
    return [error(reports[Run(scene, text)]) for scene in SCENES]


def counted_features(reports, text):
    """Matched and bound features of each scene."""
    found = [reports[Run(scene, text)]["features"] for scene in SCENES]
    return [f"{number(count['matched'], 0)} of {number(count['bound'], 0)}" for count in found]


def accuracy(reports):
    rows = [["the paper's own recordings: one average", *[number(PAPER_MEAN_ERROR_MM), "", "", ""]]]
    rows += [[method, *errors(reports, text)] for method, text in compared().items()]
    return rows


def worth(reports):
    return [[words, *errors(reports, text)] for words, text in parts().items()]


def simulators(reports):
    return [[words, *errors(reports, text)] for words, text in methods.simulators().items()]


def features(reports):
    rows = []
    for words, text in counts().items():
        cells = zip(errors(reports, text), counted_features(reports, text))
        rows.append([words, *(f"{error} ({found})" for error, found in cells)])
    return rows


def sizes(reports):
    models = {body: reports[Run(scene)]["sizes"] for body, scene in TIMED.items()}
    return [[model, *(f"{of_paper[body][item]} / {models[body][model][item]}"
                      for body in ("sponge", "doll") for item in (0, 1))] for model, of_paper in PAPER_SIZES.items()]


def peers(compared_bodies):
    """One row for each simulator."""
    cells = {body: {words: [number(row["mean_mm"]), number(row["median_ms"])] for words, row in rows.items()}
             for body, rows in compared_bodies.items()}
    rows = [[words, *(cell for body in cells for cell in cells[body][words])] for words in next(iter(cells.values()))]
    return rows


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
                     f"{number(get(surface, 'distance.mean_mm'))} / {number(get(surface, 'distance.max_mm'))}"])
    return rows


def tearing(reports):
    report = reports[Run(TEAR)]
    times, surface = report["times"], report["cut_surface"]
    pieces = report["pieces"]
    return [[number(times["truth_s"]), ", ".join(number(time) for time in times["tears_s"]),
             f"{pieces['true_pieces']} / {pieces['result_pieces']}", percent(pieces["frames_right"]),
             f"{number(get(surface, 'distance.mean_mm'))} / {number(get(surface, 'distance.max_mm'))}",
             number(surface["tilt_deg"]), number(get(report, "vertex_error.visible.mean_mm"))]]


def coarse_doll(reports):
    found = [reports[Run(scene, model=COARSE)] for scene in COARSE_SCENES]
    models = found[0]["sizes"]
    return [[models["Low-resolution"][0], models["Volumetric"][1], *map(error, found)]]
