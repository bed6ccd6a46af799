"""The goals, and whether they are reached."""
import math

from evaluation.figures import (CLUTTERED, DEPTH_HOLES, FEW_FEATURES, MOVING, NOISE_FREE, WRONG_MATCH_SEEDS,
                                cluttered_times, fault_times, get, moving_times, number, tracking_share, worst,
                                wrong_matches)
from evaluation.open_loop import open_loop_goals
from evaluation.world_goals import world_goals
from markdown_lines import table


class Values:
    """Values of the reports that several goals need; None: not measured."""

    def __init__(self, reports):
        self.reports = reports

    def scene(self, name, *keys):
        return get(self.reports.get(("scene", name)), *keys)

    def worst_of(self, kind, *keys):
        return worst(get(self.reports.get((kind, name)), "vertex_error", *keys) for name in NOISE_FREE)

    def fault(self, name):
        return worst(fault_times(self.reports, scene, name) for scene in WRONG_MATCH_SEEDS)

    def absence(self, name, *keys):
        found = self.scene(name, "absences")
        return get(found[0], *keys) if found else None

    def recovery(self, name):
        """Seconds; infinite: never."""
        if self.absence(name, "end_s") is None:
            return None
        seconds = self.absence(name, "recovery_s")
        return math.inf if seconds is None else seconds

    def toy(self, kind, *keys):
        return get(self.reports.get((kind, "toys")), "depth_residual", "all", *keys)

    def toy_tracking(self, kind):
        share = tracking_share(self.reports.get((kind, "toys")) or {})
        return None if share is None else 100.0 * share

    def toy_within(self, kind):
        """Of the worst window; a frame without a surface counts as 0 %."""
        windows = get(self.reports.get((kind, "toys")), "depth_residual", "windows") or []
        return min((100.0 * window["within_10mm"] * window["answered"] / window["frames"] for window in windows),
                   default=None)


def accuracy_goals(values):
    long = values.reports.get(("long", "bend"))
    return [
        (f"mean error of visible vertices, worst of {', '.join(NOISE_FREE)}; no noise", "<= 0.5", "mm",
         values.worst_of("noise off", "visible", "mean_mm")),
        ("the same, with noise", "<= 1.0", "mm", values.worst_of("scene", "visible", "mean_mm")),
        ("mean error of hidden vertices, worst of the same", "<= 2.0", "mm",
         values.worst_of("scene", "hidden", "mean_mm")),
        *((f"{name}: error of all vertices, p95", "<= 3.0", "mm", values.scene(name, "vertex_error", "all", "p95_mm"))
          for name in NOISE_FREE),
        ("bend for 60 s: mean error of the last 5 s over that of the first 5 s", "<= 1.1", "times",
         get(long, "vertex_error", "drift_ratio")),
        ("still: jitter, RMS", "<= 0.2", "mm", values.scene("still", "jitter", "per_vertex", "rms_mm")),
    ]


def robustness_goals(values):
    faulty = ", ".join(WRONG_MATCH_SEEDS)
    seeds = ", ".join(f"{name} ({len(drawn)} seeds)" for name, drawn in WRONG_MATCH_SEEDS.items())
    return [
        ("occlude: mean error of the hidden part", "<= 4.0", "mm", values.absence("occlude", "covered", "mean_mm")),
        ("occlude: time until the error is at most 1.2 times that without the hand", "<= 0.3", "s",
         values.recovery("occlude")),
        ("leave: time until the error is at most 1.2 times that before", "<= 1.0", "s", values.recovery("leave")),
        ("shake: frames with a mean error of at most 10 mm", ">= 100", "%",
         followed(values.reports.get(("scene", "shake")))),
        (f"{DEPTH_HOLES}: error divided by that without, worst of {faulty}", "<= 1.2", "times",
         values.fault(DEPTH_HOLES)),
        (f"20 % wrong matches: the same, worst of {seeds}", "<= 1.2", "times",
         worst(fault_times(values.reports, name, wrong_matches(seed))
               for name, drawn in WRONG_MATCH_SEEDS.items() for seed in drawn)),
        (f"{FEW_FEATURES}: the same, worst of {faulty}", "<= 1.2", "times", values.fault(FEW_FEATURES)),
        (f"moving camera: error over that of a fixed camera, worst of {', '.join(MOVING)}", "<= 1.2", "times",
         worst(moving_times(values.reports).get(name) for name in MOVING)),
        *((f"{scene}: error over that without the other things", "<= 1.2", "times",
           cluttered_times(values.reports, scene)) for scene in CLUTTERED),
    ]


def cut_goals(values):
    pieces = [piece["mean_mm"] for piece in values.scene("cut", "vertex_error", "pieces") or []]
    return [
        ("cut: largest distance between the cut surface and the true one", "<= 2.0", "mm",
         worst(values.scene("cut", "cut_surface", way, "max_mm") for way in ("distance", "missed"))),
        ("cut: angle between the cut surface and the true one", "<= 2.0", "deg",
         values.scene("cut", "cut_surface", "tilt_deg")),
        ("cut: mean error of the worse piece", "<= 2.5", "mm", worst(pieces)),
        *(goal for scene in ("tear", "doll_tear") for goal in tear_goals(values, scene)),
    ]


def tear_goals(values, scene):
    delay = values.scene(scene, "pieces", "delay_s")
    right = values.scene(scene, "pieces", "frames_right")
    return [
        (f"{scene}: time between the tear and the true one", "<= 0.15", "s", None if delay is None else abs(delay)),
        (f"{scene}: largest distance between the torn surface and the true one", "<= 3.0", "mm",
         worst(values.scene(scene, "cut_surface", way, "max_mm") for way in ("distance", "missed"))),
        (f"{scene}: frames with the right number of pieces", ">= 95", "%", None if right is None else 100.0 * right),
    ]


def bound_goals(values):
    found = [get(report, "calibration") for (kind, _), report in values.reports.items()
             if kind == "scene" and get(report, "calibration")]
    shares = {which: [100.0 * calibration[f"within_90_{which}"] for calibration in found
                      if calibration[f"within_90_{which}"] is not None] for which in ("visible", "hidden")}
    return [
        *((f"{which} vertices within their 90 % bound, {name} of all scenes", goal, "%", choose(shares[which], default=None))
          for which in ("visible", "hidden")
          for name, goal, choose in (("fewest", ">= 85", min), ("most", "<= 95", max))),
        ("90 % bound divided by the error, median, largest of all scenes", "<= 3", "times",
         worst(calibration["median_ratio"] for calibration in found)),
    ]


def toy_goals(values):
    return [
        ("recorded toy: frames called TRACKING", ">= 95", "%", values.toy_tracking("toys")),
        ("recorded toy: depth residual, median", "<= 1.2", "mm", values.toy("toys", "residual", "median_mm")),
        ("recorded toy: measured pixels within 10 mm, worst hundred frames", ">= 95", "%", values.toy_within("toys")),
        ("recorded toy without a rough pose: the same", ">= 95", "%", values.toy_within("no pose")),
    ]


def goals(reports):
    """(figure, goal, unit, value): reached if the value is at most, or for a goal with >= at least, the goal."""
    values = Values(reports)
    return [*accuracy_goals(values), *robustness_goals(values), *cut_goals(values), *bound_goals(values),
            *open_loop_goals(reports), *toy_goals(values)]


def followed(report):
    """Share of all frames with a small error [%]; an unanswered frame counts as lost."""
    means = get(report, "vertex_error", "frame_mean_mm")
    return None if means is None else 100.0 * sum(mean <= 10.0 for mean in means) / report["frames"]["expected"]


def verdict(goal, unit, value):
    """The cells goal, measured and reached."""
    relation, limit = goal.split()
    reached = value is not None and (value <= float(limit) if relation == "<=" else value >= float(limit))
    measured = "never" if value == math.inf else number(value)
    return [f"{goal} {unit}", measured, "-" if value is None else "yes" if reached else "no"]


def goal_table(reports):
    rows = [[figure, *verdict(goal, unit, value)]
            for figure, goal, unit, value in [*goals(reports), *world_goals(reports)]]
    return table(["metric", "goal", "measured", "reached"], rows)
