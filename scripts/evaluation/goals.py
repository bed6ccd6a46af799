"""The goals: (metric, goal with its unit, value). Reached: the value is at most, or with >= at least, the goal."""
import math

from evaluation.figures import (ALL, CLUTTERED, DEPTH_HOLES, FEW_FEATURES, HIDDEN, MOVING, NOISE_FREE, P95,
                                PAPER_MEAN_ERROR_MM, VISIBLE, WRONG_MATCH_SEEDS, frames_of, get, of_kind, percents,
                                ratio, tracking_share, value_of, worst, worst_of, wrong_matches)
from evaluation.world_goals import world_goals
from pages import number

CUT_SURFACE = ("cut_surface.distance.max_mm", "cut_surface.missed.max_mm")


def absence(reports, scene, path):
    found = value_of(reports, "scene", scene, "absences")
    return get(found[0], path) if found else None


def recovery(reports, scene):
    """Seconds; infinite: never."""
    if absence(reports, scene, "end_s") is None:
        return None
    seconds = absence(reports, scene, "recovery_s")
    return math.inf if seconds is None else seconds


def cut_distance(reports, scene):
    return worst(value_of(reports, "scene", scene, path) for path in CUT_SURFACE)


def followed(report):
    """Share of all frames with a small error [%]; an unanswered frame counts as lost."""
    frames = frames_of(report)
    return 100.0 * sum(frame.mean <= 10.0 for frame in frames) / report["frames"]["expected"] if frames else None


def accuracy_goals(reports):
    return [
        (f"mean error of visible vertices, worst of {', '.join(NOISE_FREE)}; no noise", "<= 0.5 mm",
         worst_of(reports, "noise off", NOISE_FREE, VISIBLE)),
        ("the same, with noise", "<= 1.0 mm", worst_of(reports, "scene", NOISE_FREE, VISIBLE)),
        ("mean error of hidden vertices, worst of the same", "<= 2.0 mm",
         worst_of(reports, "scene", NOISE_FREE, HIDDEN)),
        *((f"{name}: error of all vertices, p95", "<= 3.0 mm",
           value_of(reports, "scene", name, P95)) for name in NOISE_FREE),
        ("bend for 60 s: mean error of the last 5 s over that of the first 5 s", "<= 1.1 times",
         value_of(reports, "long", "bend", "vertex_error.drift_ratio")),
        ("still: jitter, RMS", "<= 0.2 mm", value_of(reports, "scene", "still", "jitter.per_vertex.rms_mm")),
    ]


def robustness_goals(reports):
    def faulty(names, faults_of):
        return worst(ratio(reports, ("fault", (name, fault)), ("scene", name))
                     for name in names for fault in faults_of(name))

    names = ", ".join(WRONG_MATCH_SEEDS)
    seeds = ", ".join(f"{name} ({len(drawn)} seeds)" for name, drawn in WRONG_MATCH_SEEDS.items())
    return [
        ("occlude: mean error of the hidden part", "<= 4.0 mm", absence(reports, "occlude", "covered.mean_mm")),
        ("occlude: time until the error is at most 1.2 times that without the hand", "<= 0.3 s",
         recovery(reports, "occlude")),
        ("leave: time until the error is at most 1.2 times that before", "<= 1.0 s", recovery(reports, "leave")),
        ("shake: frames with a mean error of at most 10 mm", ">= 100 %", followed(reports.get(("scene", "shake")))),
        (f"{DEPTH_HOLES}: error divided by that without, worst of {names}", "<= 1.2 times",
         faulty(WRONG_MATCH_SEEDS, lambda name: [DEPTH_HOLES])),
        (f"20 % wrong matches: the same, worst of {seeds}", "<= 1.2 times",
         faulty(WRONG_MATCH_SEEDS, lambda name: map(wrong_matches, WRONG_MATCH_SEEDS[name]))),
        (f"{FEW_FEATURES}: the same, worst of {names}", "<= 1.2 times",
         faulty(WRONG_MATCH_SEEDS, lambda name: [FEW_FEATURES])),
        (f"moving camera: error over that of a fixed camera, worst of {', '.join(MOVING)}", "<= 1.2 times",
         worst(ratio(reports, ("moving camera", name), ("scene", name)) for name in MOVING)),
        *((f"{scene}: error over that without the other things", "<= 1.2 times",
           ratio(reports, ("cluttered", scene), ("uncluttered", scene))) for scene in CLUTTERED),
    ]


def cut_goals(reports):
    pieces = value_of(reports, "scene", "cut", "vertex_error.pieces") or []
    return [
        ("cut: largest distance between the cut surface and the true one", "<= 2.0 mm", cut_distance(reports, "cut")),
        ("cut: angle between the cut surface and the true one", "<= 2.0 deg",
         value_of(reports, "scene", "cut", "cut_surface.tilt_deg")),
        ("cut: mean error of the worse piece", "<= 2.5 mm", worst(piece["mean_mm"] for piece in pieces)),
        *(goal for scene in ("tear", "doll_tear") for goal in tear_goals(reports, scene)),
    ]


def tear_goals(reports, scene):
    delay = value_of(reports, "scene", scene, "pieces.delay_s")
    return [
        (f"{scene}: time between the tear and the true one", "<= 0.15 s", None if delay is None else abs(delay)),
        (f"{scene}: largest distance between the torn surface and the true one", "<= 3.0 mm",
         cut_distance(reports, scene)),
        (f"{scene}: frames with the right number of pieces", ">= 95 %",
         percents(value_of(reports, "scene", scene, "pieces.frames_right"))),
    ]


def bound_goals(reports):
    found = [get(report, "calibration") for report in of_kind(reports, "scene").values() if get(report, "calibration")]
    shares = {which: [100.0 * calibration[f"within_90_{which}"] for calibration in found
                      if calibration[f"within_90_{which}"] is not None] for which in ("visible", "hidden")}
    return [
        *((f"{which} vertices within their 90 % bound, {name} of all scenes", goal, choose(shares[which], default=None))
          for which in ("visible", "hidden")
          for name, goal, choose in (("fewest", ">= 85 %", min), ("most", "<= 95 %", max))),
        ("90 % bound divided by the error, median, largest of all scenes", "<= 3 times",
         worst(calibration["median_ratio"] for calibration in found)),
    ]


def open_loop_goals(reports):
    found = of_kind(reports, "open loop")
    return [(f"last fifth predicted without images: mean error of all vertices, worst of {', '.join(found)}",
             "<= 1.0 mm", worst_of(reports, "open loop", found, "open_loop.all.mean_mm"))] if found else []


def toy_goals(reports):
    def within(kind):
        """Of the worst window; a frame without a surface counts as 0 %."""
        windows = value_of(reports, kind, "toys", "depth_residual.windows") or []
        return min((100.0 * window["within_10mm"] * window["answered"] / window["frames"] for window in windows),
                   default=None)

    return [
        ("recorded toy: frames called TRACKING", ">= 95 %", percents(tracking_share(reports.get(("toys", "toys"))))),
        ("recorded toy: depth residual, median", "<= 1.2 mm", toy_median(reports)),
        ("recorded toy: measured pixels within 10 mm, worst hundred frames", ">= 95 %", within("toys")),
        ("recorded toy without a rough pose: the same", ">= 95 %", within("no pose")),
    ]


def toy_median(reports):
    return value_of(reports, "toys", "toys", "depth_residual.all.residual.median_mm")


def verdict(goal, value):
    """The cells goal, measured and reached."""
    relation, limit, _ = goal.split()
    reached = value is not None and (value <= float(limit) if relation == "<=" else value >= float(limit))
    measured = "never" if value == math.inf else number(value)
    return [goal, measured, "-" if value is None else "yes" if reached else "no"]


def goal_rows(reports):
    parts = (accuracy_goals, robustness_goals, cut_goals, bound_goals, open_loop_goals, toy_goals, world_goals)
    return [[metric, *verdict(goal, value)] for part in parts for metric, goal, value in part(reports)]


def summary_rows(reports):
    """The metrics in README.md, with the scenes that they are of."""
    def worst_scene(prefix, path):
        """The largest, and the scene that it is of."""
        found = {prefix + name: value_of(reports, "scene", prefix + name, path) for name in NOISE_FREE}
        largest = worst(found.values())
        return largest, next((name for name, value in found.items() if value == largest), "")

    paper, scenes = f"<= {PAPER_MEAN_ERROR_MM} mm", ", ".join(NOISE_FREE)
    for metric, goal, value, name in (
            (f"sponge: mean error of all vertices, worst of {scenes}", paper, *worst_scene("", ALL)),
            ("soft toy: the same", paper, *worst_scene("doll_", ALL)),
            ("sponge: mean error of visible vertices, worst of the same", "<= 1.0 mm", *worst_scene("", VISIBLE)),
            ("sponge: mean error of hidden vertices", "<= 2.0 mm", *worst_scene("", HIDDEN)),
            ("sponge: error that 95 % of the vertices do not exceed", "<= 3.0 mm", *worst_scene("", P95)),
            ("sponge behind a hand: mean error of the hidden part", "<= 4.0 mm",
             absence(reports, "occlude", "covered.mean_mm"),
             "occlude"),
            ("sponge, cut: largest distance between the cut surface and the true one", "<= 2.0 mm",
             cut_distance(reports, "cut"), "cut"),
            ("toy recorded by [Petit et al. 2015](docs/evaluation.md#recorded-plush-toy) with a real camera: median "
             "distance from the measured depth", "<= 1.2 mm", toy_median(reports), "")):
        limit, measured, reached = verdict(goal, value)
        yield [metric, limit, f"{measured} ({name})" if name else measured, reached]
