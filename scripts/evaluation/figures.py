"""Figures from the reports of `evaluate`, by scene and kind of run."""

import math

NOISE_FREE = ("bend", "push", "pull", "twist", "press")
# Scenes with a body of one colour.
PLAIN_MOTIONS = ("bend", "push", "pull", "twist", "press")
PLAIN = (*PLAIN_MOTIONS, "still", "rigid")
# Scenes with hands of the body's own colour: a plain hand has the same colour as a plain body.
OWN_COLOUR = ("touch", "squeeze")
# Scenes that every texture is measured in, with both bodies.
TEXTURED = tuple(body + scene for body in ("", "doll_") for scene in (*NOISE_FREE, "far", "fast", "table"))
TEXTURES = ("weak", "plain")
# Scenes with other things at the body from the first frame on, or that pass before it.
CLUTTERED = ("neighbour", "twin", "stack", "clutter", "held", "two_bodies", "arm")
FALSE_AFTER_S = 1.0
WRONG_MM = 15.0  # a vertex this far off is not tracked
STARTS = 20  # rough poses of each plain scene
MOVING = ("still", "bend", "push", "twist")
# Scenes with faults. Several seeds of wrong matches, because the error differs by a third between them.
WRONG_MATCH_SEEDS = {"bend": (1, 2, 3, 4), "push": (1, 2), "twist": (1, 2)}
DEPTH_HOLES, FEW_FEATURES = "30 % depth holes", "at most 50 features instead of 1000"

# Kang et al. 2022: section 6 (the mean error), Table 2 (times; "Init." is the initialization).
PAPER_MEAN_ERROR_MM = 2.56
PAPER_TIMES_MS = {
    "Feature-Point Tracking": {"sponge": 0.56, "doll": 0.67},
    "Soft-body Simulation": {"sponge": 10.62, "doll": 29.02},
    "Resolution Enhancement": {"sponge": 0.38, "doll": 2.81},
    "Feature-Point Tracking (initialization)": {"sponge": 15.51, "doll": 22.53},
    "Soft-body Simulation (initialization)": {"sponge": 21.22, "doll": 23.61},
    "Resolution Enhancement (initialization)": {"sponge": 18.41, "doll": 542.31},
}


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


def cluttered_times(reports, scene, part="all"):
    """Mean error with other things over that of the same motion without them; None if one was not measured."""
    cluttered, alone = (get(reports.get((kind, scene)), "vertex_error", part, "mean_mm")
                        for kind in ("cluttered", "uncluttered"))
    return cluttered / alone if cluttered is not None and alone else None


def fault_times(reports, scene, fault):
    """Mean error with a fault over that without; None if one was not measured."""
    base, faulty = (get(reports.get(key), "vertex_error", "all", "mean_mm")
                    for key in (("scene", scene), ("fault", (scene, fault))))
    return None if base is None or faulty is None else faulty / base


def within(report, key, first_s=0.0, last_s=math.inf):
    """Values of a list by frame, at times of the scene from first_s to last_s; without missing ones."""
    error = get(report, "vertex_error")
    if error is None:
        return []
    return [value for time, value in zip(error["frame_times_s"], error[key])
            if value is not None and first_s <= error["first_time_s"] + time <= last_s]


def mean_within(report, key, first_s=0.0, last_s=math.inf):
    values = within(report, key, first_s, last_s)
    return sum(values) / len(values) if values else None


def visible_while_tracking(report):
    """Of every frame called TRACKING: its largest error of a visible vertex [mm]."""
    return [largest for state, largest in zip(get(report, "frame_states") or [],
                                              get(report, "vertex_error", "frame_visible_max_mm") or [])
            if state == "tracking" and largest is not None]


def false_tracking(report):
    """Frames called TRACKING after the first second, of a result with a wrong object."""
    return [state for time, state in report["states_by_time"] if time >= FALSE_AFTER_S].count("tracking")


def wrong_after_start(report):
    """Frames called TRACKING after the first second with a visible vertex far off, of a body placed wrongly."""
    rows = zip(report["vertex_error"]["frame_times_s"], report["frame_states"],
               report["vertex_error"]["frame_visible_max_mm"])
    return sum(time >= FALSE_AFTER_S and state == "tracking" and largest is not None and largest > WRONG_MM
               for time, state, largest in rows)


def time_until_normal(report, unhidden, after_s):
    """Seconds from the first frame without hidden vertices, after a time, until the error stays at most 1.2 times that
    of the same motion without hands, for 0.2 s; infinite: never."""
    error, normal = get(report, "vertex_error"), get(unhidden, "vertex_error")
    if error is None or normal is None:
        return None
    times = [error["first_time_s"] + time for time in error["frame_times_s"]]
    usual = dict(zip((round(normal["first_time_s"] + time, 3) for time in normal["frame_times_s"]),
                     normal["frame_mean_mm"]))
    gone = next((time for time, covered in zip(times, error["frame_covered_mean_mm"])
                 if time >= after_s and covered is None), None)
    if gone is None:
        return math.inf
    since = None
    for time, mean in zip(times, error["frame_mean_mm"]):
        if time < gone:
            continue
        if mean > 1.2 * usual.get(round(time, 3), 0.0):
            since = None
        elif since is None:
            since = time
        if since is not None and time - since >= 0.2:
            return since - gone
    return math.inf


def calibration_bins(reports):
    """{bin: [count, sum of squared predictions, sum of squared errors]} over all scenes [mm^2]."""
    bins = {}
    for (kind, _), report in reports.items():
        for row in (get(report, "calibration", "bins") or []) if kind in ("scene", *TEXTURES) else []:
            total = bins.setdefault(math.floor(2.0 * math.log2(max(row["predicted_rms_mm"], 1e-3))), [0, 0.0, 0.0])
            total[0] += row["count"]
            total[1] += row["count"] * row["predicted_rms_mm"] ** 2
            total[2] += row["count"] * row["error_rms_mm"] ** 2
    return dict(sorted(bins.items()))


def summary_line(reports):
    """One line with the mean error of each scene and fault."""
    words = []
    for (kind, name), report in reports.items():
        if not report:
            continue
        if kind == "starts":
            words.append(f"{name}, {STARTS} starts: {number(report['max_mm'])} mm apart")
            continue
        if kind == "placed":
            words.append(f"{name}: {wrong_after_start(report)} frames tracking and wrong")
            continue
        if kind == "wrong":
            words.append(f"{name}: {number(false_tracking(report), 0)} frames tracking")
            continue
        error = get(report, "vertex_error", "all", "mean_mm")
        what = ", ".join(name) if kind == "fault" else name if kind in ("scene", name) else f"{name}, {kind}"
        words.append(f"{what}: {number(error)} mm" if error is not None else
                     f"{what}: {number(get(report, 'depth_residual', 'all', 'residual', 'median_mm'))} mm "
                     "median depth residual")
    return "; ".join(words)
