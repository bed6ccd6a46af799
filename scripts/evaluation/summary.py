"""The ten figures of README.md, with those of Kang et al. 2022 beside them, from the reports of `evaluate`."""
from evaluation.figures import NOISE_FREE, PAPER_FRAME_MS, PAPER_MEAN_ERROR_MM, PAPER_TIMES_MS, get, number, worst
from evaluation.goals import verdict
from evaluation.tables import median_times
from markdown_lines import table


def frame_time(reports, body):
    """Sum over the paper's three stages of their median times [ms]; None if one was not measured."""
    times = median_times(reports)
    stages = [words for words in PAPER_TIMES_MS if not words.endswith("(first frame)")]
    values = [get(times, words, body) for words in stages]
    return None if None in values else sum(values)


def figures(reports):
    """(figure, goal, unit, value, the paper's value)."""
    def scene(name, *keys):
        return get(reports.get(("scene", name)), *keys)

    def worst_of(prefix, *keys):
        return worst(scene(prefix + name, "vertex_error", *keys) for name in NOISE_FREE)

    hidden = scene("occlude", "absences")
    error, scenes = PAPER_MEAN_ERROR_MM, ", ".join(NOISE_FREE)
    return [
        (f"sponge: mean error of all vertices, worst of {scenes}", f"<= {error}", "mm", worst_of("", "all", "mean_mm"),
         error),
        ("soft toy: the same", f"<= {error}", "mm", worst_of("doll_", "all", "mean_mm"), error),
        ("sponge: mean error of visible vertices, worst of the same", "<= 1.0", "mm",
         worst_of("", "visible", "mean_mm"), None),
        ("sponge: mean error of hidden vertices", "<= 2.0", "mm", worst_of("", "hidden", "mean_mm"), None),
        ("sponge: error that 95 % of the vertices do not exceed", "<= 3.0", "mm", worst_of("", "all", "p95_mm"), None),
        ("sponge behind a hand: mean error of the hidden part", "<= 4.0", "mm",
         get(hidden[0], "covered", "mean_mm") if hidden else None, None),
        ("sponge, cut: largest distance between the cut surface and the true one", "<= 2.0", "mm",
         worst(scene("cut", "cut_surface", way, "max_mm") for way in ("distance", "missed")), None),
        ("recorded toy, real camera: median distance from the measured depth", "<= 4.0", "mm",
         get(reports.get(("toys", "toys")), "depth_residual", "all", "residual", "median_mm"), None),
        *((f"{words}: time per frame, three stages", f"<= {PAPER_FRAME_MS[body]:.2f}", "ms", frame_time(reports, body),
           PAPER_FRAME_MS[body]) for words, body in (("sponge", "sponge"), ("soft toy", "doll"))),
    ]


def summary_table(reports):
    rows = [[figure, *verdict(goal, unit, value), "-" if paper is None else f"{number(paper)} {unit}"]
            for figure, goal, unit, value, paper in figures(reports)]
    return table(["figure", "goal", "measured", "reached", "paper"], rows)
