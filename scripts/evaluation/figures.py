"""Figures from the reports of `evaluate`, by scene and kind of run."""

NOISE_FREE = ("bend", "push", "pull", "twist", "press")
MOVING = ("still", "bend", "push", "twist")
# Scenes with faults. Several seeds of wrong matches, because the error differs by a third between them.
WRONG_MATCH_SEEDS = {"bend": (1, 2, 3, 4), "push": (1, 2), "twist": (1, 2)}
DEPTH_HOLES, FEW_FEATURES = "30 % depth holes", "at most 50 features instead of 1000"

# Kang et al. 2022: section 6 (the mean error), Table 2 (times; "Init." is the first frame).
PAPER_MEAN_ERROR_MM = 2.56
PAPER_TIMES_MS = {
    "Feature-Point Tracking": {"sponge": 0.56, "doll": 0.67},
    "Soft-body Simulation": {"sponge": 10.62, "doll": 29.02},
    "Resolution Enhancement": {"sponge": 0.38, "doll": 2.81},
    "Feature-Point Tracking (first frame)": {"sponge": 15.51, "doll": 22.53},
    "Soft-body Simulation (first frame)": {"sponge": 21.22, "doll": 23.61},
    "Resolution Enhancement (first frame)": {"sponge": 18.41, "doll": 542.31},
}
PAPER_FRAME_MS = {"sponge": 11.56, "doll": 32.50}  # its "Total"


def wrong_matches(seed):
    return f"20 % wrong matches, seed {seed}"


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def percent(value, digits=1):
    return "-" if value is None else f"{100.0 * value:.{digits}f}"


def get(report, *keys):
    """A nested value of a report; None if it is missing."""
    for key in keys:
        if report is None:
            return None
        report = report.get(key) if isinstance(report, dict) else None
    return report


def of_kind(reports, kind):
    """Reports of one kind by name, in alphabetical order; the sponge first."""
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
    """Mean error with a moving camera over that with a fixed camera, by scene."""
    keys = ("vertex_error", "all", "mean_mm")
    return {name: get(moving, *keys) / get(reports[("scene", name)], *keys)
            for name, moving in of_kind(reports, "moving camera").items()}


def fault_times(reports, scene, fault):
    """Mean error with a fault over that without; None if one was not measured."""
    base, faulty = (get(reports.get(key), "vertex_error", "all", "mean_mm")
                    for key in (("scene", scene), ("fault", (scene, fault))))
    return None if base is None or faulty is None else faulty / base


def summary_line(reports):
    """One line with the mean error of each scene and fault."""
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
