"""The figures of `make evaluate` in README.md, from the reports of `evaluate`."""
from evaluation.figures import NOISE_FREE, PAPER_MEAN_ERROR_MM, get, worst
from evaluation.goals import verdict
from markdown_lines import table


def figures(reports):
    """(figure, goal, unit, value, scene that it is of)."""
    def scene(name, *keys):
        return get(reports.get(("scene", name)), *keys)

    def worst_of(prefix, *keys):
        """The largest, and the scene that it is of."""
        found = {prefix + name: scene(prefix + name, "vertex_error", *keys) for name in NOISE_FREE}
        largest = worst(found.values())
        return largest, next((name for name, value in found.items() if value == largest), "")

    hidden = scene("occlude", "absences")
    error, scenes = PAPER_MEAN_ERROR_MM, ", ".join(NOISE_FREE)
    return [
        (f"sponge: mean error of all vertices, worst of {scenes}", f"<= {error}", "mm", *worst_of("", "all", "mean_mm")),
        ("soft toy: the same", f"<= {error}", "mm", *worst_of("doll_", "all", "mean_mm")),
        ("sponge: mean error of visible vertices, worst of the same", "<= 1.0", "mm",
         *worst_of("", "visible", "mean_mm")),
        ("sponge: mean error of hidden vertices", "<= 2.0", "mm", *worst_of("", "hidden", "mean_mm")),
        ("sponge: error that 95 % of the vertices do not exceed", "<= 3.0", "mm", *worst_of("", "all", "p95_mm")),
        ("sponge behind a hand: mean error of the hidden part", "<= 4.0", "mm",
         get(hidden[0], "covered", "mean_mm") if hidden else None, "occlude"),
        ("sponge, cut: largest distance between the cut surface and the true one", "<= 2.0", "mm",
         worst(scene("cut", "cut_surface", way, "max_mm") for way in ("distance", "missed")), "cut"),
        ("toy recorded by [Petit et al. 2015](docs/evaluation.md#recorded-plush-toy) with a real camera: median "
         "distance from the measured depth", "<= 1.2", "mm",
         get(reports.get(("toys", "toys")), "depth_residual", "all", "residual", "median_mm"), ""),
    ]


def summary_table(reports):
    rows = []
    for figure, goal, unit, value, name in figures(reports):
        limit, measured, reached = verdict(goal, unit, value)
        rows.append([figure, limit, f"{measured} ({name})" if name else measured, reached])
    return table(["metric", "goal", "measured (scene)", "reached"], rows)
