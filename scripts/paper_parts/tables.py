"""The rows of the measured tables in docs/paper.md, and of that in README.md."""
import json

from evaluation.figures import PAPER_MEAN_ERROR_MM, get
from pages import number, percent
from paper_parts.methods import COMPARED, COUNTS, CUT_THROUGH, OURS, SCENES, TEAR, TIMED, WITH_PD
from paper_parts.runs import COARSE, Run
from paper_parts.time_table import PAPER, totals
from tools import tool

COARSE_SCENES = tuple(scene for scene in SCENES if scene.startswith("doll_"))
# Table 1 of the paper: vertices and polygons.
PAPER_SIZES = {"High-resolution": {"sponge": (522, 1040), "doll": (18650, 7190)},
               "Low-resolution": {"sponge": (132, 260), "doll": (128, 252)},
               "Volumetric": {"sponge": (132, 300), "doll": (154, 494)}}
WORDS = {"sponge": "sponge", "doll": "soft toy"}
SHOWN = {PAPER: PAPER, "its method here": WITH_PD, OURS: OURS}  # in README.md: kind of time, method of accuracy


def error(report):
    return number(get(report, "vertex_error.all.mean_mm"))


def errors(reports, text):
    return [error(reports[Run(scene, text)]) for scene in SCENES]


def error_rows(reports, texts):
    return [[words, *errors(reports, text)] for words, text in texts.items()]


def accuracy(reports):
    return [["the paper's own recordings: one average", number(PAPER_MEAN_ERROR_MM), "", "", ""],
            *error_rows(reports, COMPARED)]


def features(reports):
    """Errors, with the features that are matched and bound."""
    def cell(report):
        count = report["features"]
        return f"{error(report)} ({number(count['matched'], 0)} of {number(count['bound'], 0)})"

    return [[words, *(cell(reports[Run(scene, text)]) for scene in SCENES)] for words, text in COUNTS.items()]


def sizes(reports):
    models = {body: reports[Run(scene)]["sizes"] for body, scene in TIMED.items()}
    return [[model, *(f"{of_paper[body][item]} / {models[body][model][item]}"
                      for body in ("sponge", "doll") for item in (0, 1))] for model, of_paper in PAPER_SIZES.items()]


def peers(_):
    """One row for each simulator."""
    bodies = json.loads(tool("compare_peers", package="development/softbody_sim")).values()
    return [[words, *(number(body[words][key]) for body in bodies for key in ("mean_mm", "median_ms"))]
            for words in next(iter(bodies))]


def cutting(reports):
    """One row for each scene."""
    for scene in CUT_THROUGH:
        report = reports[Run(scene)]
        quality = report["quality"]
        columns = (("triangles", str), ("least_deg", number), ("sharp_share", percent), ("narrow_share", percent))
        yield [scene, *(" / ".join(shown(quality[side][key]) for side in ("before", "after", "faces"))
                        for key, shown in columns),
               number(1e6 * quality["volume_change"]), quality["holes"], quality["cuts"],
               f"{number(quality['median_ms'])} / {number(quality['worst_ms'])}", surface_distance(report)]


def surface_distance(report):
    return " / ".join(number(get(report, f"cut_surface.distance.{key}_mm")) for key in ("mean", "max"))


def tearing(reports):
    report = reports[Run(TEAR)]
    times, pieces = report["times"], report["pieces"]
    return [[number(times["truth_s"]), ", ".join(map(number, times["tears_s"])),
             f"{pieces['true_pieces']} / {pieces['result_pieces']}", percent(pieces["frames_right"]),
             surface_distance(report), number(report["cut_surface"]["tilt_deg"]),
             number(get(report, "vertex_error.visible.mean_mm"))]]


def coarse_doll(reports):
    found = [reports[Run(scene, model=COARSE)] for scene in COARSE_SCENES]
    models = found[0]["sizes"]
    return [[models["Low-resolution"][0], models["Volumetric"][1], *map(error, found)]]


def readme_rows(reports):
    """The paper's figures beside ours. Errors: one row for each body, of the two scenes that it has."""
    for words, scenes in zip(WORDS.values(), (SCENES[:2], SCENES[2:])):
        ours = (" / ".join(error(reports[Run(scene, COMPARED[method])]) for scene in scenes)
                for kind, method in SHOWN.items() if kind != PAPER)
        yield [f"{words}, mean error of scenes {' / '.join(scenes)} [mm]", number(PAPER_MEAN_ERROR_MM), *ours]
    for what, initialization in (("time of a frame", False), ("initialization without the search", True)):
        times = totals(reports, initialization)
        yield [f"{' / '.join(WORDS.values())}, {what} [ms]",
               *(" / ".join(number(times[(body, kind)]) for body in WORDS) for kind in SHOWN)]
