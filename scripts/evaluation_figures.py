"""Figures from the reports of `evaluate`, by scene and kind of run."""

NOISE_FREE = ("bend", "push", "pull", "twist", "press")
MOVING = ("still", "bend", "push", "twist")
# Scenes with faults. One draw of wrong matches says little: the error differs by a third between them.
WRONG_MATCH_SEEDS = {"bend": (1, 2, 3, 4), "push": (1, 2), "twist": (1, 2)}
DEPTH_HOLES, FEW_FEATURES = "30 % depth holes", "at most 50 features instead of at most 1000"


def wrong_matches(seed):
    return f"20 % wrong matches, seed {seed}"


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def percent(value, digits=1):
    return "-" if value is None else f"{100.0 * value:.{digits}f}"


def get(report, *keys):
    """A value deep in a report; None where there is none."""
    for key in keys:
        if report is None:
            return None
        report = report.get(key) if isinstance(report, dict) else None
    return report


def of_kind(reports, kind):
    """Reports of one kind by name, in alphabetical order; those of other bodies after the sponge's."""
    chosen = {name: report for (its_kind, name), report in reports.items() if its_kind == kind}
    return dict(sorted(chosen.items(), key=lambda item: ("_" in item[0], item[0])))


def frames(report):
    return f"{report['frames']['answered']} of {report['frames']['expected']}"


def tracking_share(report):
    states = report.get("states", {})
    return states.get("tracking", 0) / sum(states.values()) if states else None


def worst(values):
    """The largest; None if one was not measured."""
    values = list(values)
    return max(values) if values and all(value is not None for value in values) else None


def moving_times(reports):
    """Mean errors before a camera that moves as multiples of those before one at rest, by scene."""
    keys = ("vertex_error", "all", "mean_mm")
    return {name: get(moving, *keys) / get(reports[("scene", name)], *keys)
            for name, moving in of_kind(reports, "moving camera").items()}


def fault_times(reports, scene, fault):
    """Mean error with a fault as a multiple of that without; None if one was not measured."""
    base, faulty = (get(reports.get(key), "vertex_error", "all", "mean_mm")
                    for key in (("scene", scene), ("fault", (scene, fault))))
    return None if base is None or faulty is None else faulty / base


def in_words(reports):
    """One line on what has been measured, each scene and fault by its name."""
    words = []
    for (kind, name), report in reports.items():
        if not report:
            continue
        error = get(report, "vertex_error", "all", "mean_mm")
        what = ", ".join(name) if kind == "fault" else name if kind in ("scene", name) else f"{name}, {kind}"
        words.append(f"{what}: {number(error)} mm" if error is not None else
                     f"{what}: {number(get(report, 'depth_residual', 'all', 'residual', 'median_mm'))} mm "
                     "median depth residual")
    return "; ".join(words)
