"""The measured tables of docs/paper.md."""
import os
import re

from evaluation.figures import PAPER_MEAN_ERROR_MM, PAPER_TIMES_MS, get, number
from markdown_lines import paragraph, table
from paper_parts.methods import OURS, SCENES, compared, counts, parts

FIRST = " (first frame)"
STAGES = ("Feature-Point Tracking", "Soft-body Simulation", "Resolution Enhancement")
# Table 1 of the paper: vertices and polygons.
PAPER_SIZES = {"High-resolution": {"sponge": (522, 1040), "doll": (18650, 7190)},
               "Low-resolution": {"sponge": (132, 260), "doll": (128, 252)},
               "Volumetric": {"sponge": (132, 300), "doll": (154, 494)}}


def section(title, words, columns, rows):
    return [f"### {title}", "", *paragraph(words), "", *table(columns, rows)]


def errors(reports, text):
    return [number(get(reports[(scene, text)], "vertex_error", "all", "mean_mm")) for scene in SCENES]


def found_features(reports, text):
    return [number(get(reports[(scene, text)], "features", "median"), 0) for scene in SCENES]


def accuracy(reports):
    rows = [["the paper's own recordings: one average", *[number(PAPER_MEAN_ERROR_MM), "", "", ""]]]
    rows += [[method, *errors(reports, text)] for method, text in compared().items()]
    return section("Accuracy", "Mean error of all vertices [mm]. \"As written\" is config/paper.yaml. Our tracker "
                               "lends it the first pose, which features can be seen, and the test for outliers. The "
                               "Newton step starts where inertia takes the body. Negative eigenvalues of the "
                               "stiffness are removed.",
                   ["method", *SCENES], rows)


def worth(reports):
    rows = [[words, *errors(reports, text)] for words, text in parts().items()]
    return section("What each part is worth", "Mean error of all vertices [mm]. Each row adds one part to the row "
                                              "above. The last row is another simulator under the same targets.",
                   ["method", *SCENES], rows)


def features(reports):
    rows = []
    for words, text in counts().items():
        cells = zip(errors(reports, text), found_features(reports, text))
        rows.append([words, *(f"{error} ({found})" for error, found in cells)])
    return section("Number of features", "Mean error of all vertices [mm] for limits of `max_features`. In brackets: "
                                         "the median number of features found in a frame. Our tracker itself stops "
                                         "at four features for each visible vertex of the volume, or at 300.",
                   ["features", *SCENES], rows)


def sizes(models):
    rows = [[model, *(f"{of_paper[body][item]} / {models[body][model][item]}"
                      for body in ("sponge", "doll") for item in (0, 1))] for model, of_paper in PAPER_SIZES.items()]
    return section("Table 1: models", "Each cell: paper / ours. For the volume, polygons are tets.",
                   ["model", "sponge, vertices", "sponge, polygons", "doll, vertices", "doll, polygons"], rows)


def stage_time(report, stage, initialization):
    """Median [ms] of a stage; None if it was not measured."""
    return next((entry["median_ms"] for entry in report.get("stages", [])
                 if entry["stage"] == stage and entry["initialization"] == initialization), None)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    return f"{found[1] if found else 'unknown processor'}, {os.cpu_count()} cores"


def sum_of(values):
    return None if None in values else sum(values)


def time_rows(timed, words, initialization):
    """Rows of the paper's three stages and their total."""
    rows, totals = [], [[] for _ in range(6)]
    for stage in STAGES:
        cells = []
        for body in ("sponge", "doll"):
            cells += [PAPER_TIMES_MS[stage + FIRST * initialization][body],
                      *(stage_time(timed[(body, kind)], stage, initialization) for kind in ("features alone", OURS))]
        for total, cell in zip(totals, cells):
            total.append(cell)
        rows.append([words, stage, *map(number, cells)])
    rows.append([words, "Total", *(number(sum_of(total)) for total in totals)])
    return rows, [sum_of(total) for total in totals]


def times(timed):
    initial, _ = time_rows(timed, "Init.", True)
    per_frame, totals = time_rows(timed, "per frame", False)
    registration = [stage_time(timed[(body, kind)], "Model Registration", True)
                    for body in ("sponge", "doll") for kind in ("features alone", OURS)]
    found = ["-", *map(number, registration[:2]), "-", *map(number, registration[2:])]
    rates = [number(None if not total else 1000 / total, 0) for total in totals]
    columns = ["", "stage", *(f"{body}, {whose}" for body in ("sponge", "doll")
                              for whose in ("paper", "ours, features alone", "ours"))]
    return section("Table 2: times", f"Median time of a frame [ms] of scenes bend and doll_bend, on {processor()}, no "
                                     "GPU. The paper: Intel Core i7-6700K with GeForce GTX 1080 Ti. The paper's "
                                     "tracking uses no depth between features; \"features alone\" does not, either. "
                                     "Registration is on a line of its own because the paper sets the rotation by "
                                     "hand. Init. of the simulation is only the first step. Not counted, because "
                                     "they happen before the first image: building the simulator, and OpenCV's tables "
                                     "of colours in the tracker (about 0.1 s).",
                   columns, [*initial, ["Init.", "Model Registration", *found], *per_frame,
                             ["", "frames a second", *rates]])
