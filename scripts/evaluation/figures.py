"""Figures from the reports of `evaluate`, by (kind of run, scene)."""
import collections
import math

NOISE_FREE = ("bend", "push", "pull", "twist", "press")
# Scenes with a body of one colour.
PLAIN = (*NOISE_FREE, "still", "rigid")
# Scenes with hands of the body's own colour: a plain hand has the same colour as a plain body.
OWN_COLOUR = ("touch", "squeeze")
# Scenes that every texture is measured in, with both bodies.
TEXTURED = tuple(body + scene for body in ("", "doll_") for scene in (*NOISE_FREE, "far", "fast", "table"))
TEXTURES = ("weak", "plain")
# Scenes with other things at the body from the first frame on, or that pass before it.
CLUTTERED = ("neighbour", "twin", "stack", "clutter", "held", "two_bodies", "arm")
SCANNED = ("flip", "turntable", "walk", "walk_hand")
FALSE_AFTER_S = 1.0
WRONG_MM = 15.0  # a vertex this far off is not tracked
STARTS = 20  # rough poses of each plain scene
MOVING = ("still", "bend", "push", "twist")
# Scenes with faults. Several seeds of wrong matches, because the error differs by a third between them.
WRONG_MATCH_SEEDS = {"bend": (1, 2, 3, 4), "push": (1, 2), "twist": (1, 2)}
DEPTH_HOLES, FEW_FEATURES = "30 % depth holes", "at most 50 features instead of 1000"

# Paths in a report.
MEANS = ALL, VISIBLE, HIDDEN = [f"vertex_error.{part}.mean_mm" for part in ("all", "visible", "hidden")]
P95 = "vertex_error.all.p95_mm"

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

# One frame of a report: time in the scene and since the first frame [s], state, errors of the vertices [mm].
Frame = collections.namedtuple("Frame", "time since state mean visible visible_most covered")


def wrong_matches(seed):
    return f"20 % wrong matches, seed {seed}"


def get(report, path):
    """A nested value of a report, by its keys with dots between them; None if it is missing."""
    for key in path.split("."):
        report = report.get(key) if isinstance(report, dict) else None
    return report


def value_of(reports, kind, name, path):
    """A nested value of one report; None if it was not measured."""
    return get(reports.get((kind, name)), path)


def worst_of(reports, kind, names, path):
    """The largest of several scenes; None if one was not measured."""
    return worst(value_of(reports, kind, name, path) for name in names)


def of_kind(reports, kind):
    """Reports of one kind by name, in alphabetical order; the sponge first."""
    chosen = {name: report for (its_kind, name), report in reports.items() if its_kind == kind}
    return dict(sorted(chosen.items(), key=lambda item: ("_" in item[0], item[0])))


def worst(values):
    """The largest; None if one was not measured."""
    values = list(values)
    return max(values) if values and all(value is not None for value in values) else None


def percents(share):
    """A share in percent; None if it was not measured."""
    return None if share is None else 100.0 * share


def answered(report):
    return f"{report['frames']['answered']} of {report['frames']['expected']}"


def tracking_share(report):
    states = get(report, "states")
    return states.get("tracking", 0) / sum(states.values()) if states else None


def ratio(reports, key, base, part="all"):
    """Mean error of one report over that of another; None if one was not measured."""
    mean, usual = (value_of(reports, *which, f"vertex_error.{part}.mean_mm") for which in (key, base))
    return mean / usual if mean is not None and usual else None


def frames_of(report):
    """The frames with a known error."""
    error = get(report, "vertex_error")
    if error is None:
        return []
    times = error["frame_times_s"]
    states = [*(report.get("frame_states") or []), *[None] * len(times)]
    columns = [error[f"frame_{name}_mm"] for name in ("mean", "visible_mean", "visible_max", "covered_mean")]
    return [Frame(error["first_time_s"] + time, time, *rest) for time, *rest in zip(times, states, *columns)]


def mean_within(report, column, first_s=0.0, last_s=math.inf):
    """Mean of a column of the frames at times of the scene from first_s to last_s; None if there is no value."""
    values = [getattr(frame, column) for frame in frames_of(report) if first_s <= frame.time <= last_s]
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def visible_while_tracking(report):
    """Of every frame called TRACKING: its largest error of a visible vertex [mm]."""
    return [frame.visible_most for frame in frames_of(report)
            if frame.state == "tracking" and frame.visible_most is not None]


def false_tracking(report):
    """Frames called TRACKING after the first second, of a result with a wrong object."""
    return [state for time, state in report["states_by_time"] if time >= FALSE_AFTER_S].count("tracking")


def wrong_after_start(report):
    """Frames called TRACKING after the first second with a visible vertex far off, of a body placed wrongly."""
    return sum(frame.since >= FALSE_AFTER_S and frame.state == "tracking" and (frame.visible_most or 0.0) > WRONG_MM
               for frame in frames_of(report))


def time_until_normal(report, unhidden, after_s):
    """Seconds from the first frame without hidden vertices, after a time, until the error stays at most 1.2 times that
    of the same motion without hands, for 0.2 s; infinite: never."""
    frames, usual = frames_of(report), {round(frame.time, 3): frame.mean for frame in frames_of(unhidden)}
    if not frames or not usual:
        return None
    gone = next((frame.time for frame in frames if frame.time >= after_s and frame.covered is None), math.inf)
    since = None
    for frame in frames:
        if frame.time < gone or frame.mean > 1.2 * usual.get(round(frame.time, 3), 0.0):
            since = None
        elif since is None:
            since = frame.time
        if since is not None and frame.time - since >= 0.2:
            return since - gone
    return math.inf


def calibration_bins(reports):
    """(standard deviation [mm], RMS error [mm]) of each bin over all scenes."""
    bins = {}
    for (kind, _), report in reports.items():
        for row in (get(report, "calibration.bins") or []) if kind in ("scene", *TEXTURES) else []:
            total = bins.setdefault(math.floor(2.0 * math.log2(max(row["predicted_rms_mm"], 1e-3))), [0, 0.0, 0.0])
            total[0] += row["count"]
            total[1] += row["count"] * row["predicted_rms_mm"] ** 2
            total[2] += row["count"] * row["error_rms_mm"] ** 2
    return [(math.sqrt(predicted / count), math.sqrt(error / count))
            for _, (count, predicted, error) in sorted(bins.items())]
