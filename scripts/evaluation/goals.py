"""The goals: (metric, goal with its unit, value). Reached: the value is at most, or with >= at least, the goal."""
import math

from evaluation.figures import (ALL, CLUTTERED, DEPTH_HOLES, FEW_FEATURES, HIDDEN, MOVING, NOISE_FREE, OWN_COLOUR, P95,
                                PAPER_MEAN_ERROR_MM, PLAIN, STARTS, TEXTURES, VISIBLE, WRONG_MATCH_SEEDS, WRONG_MM,
                                false_tracking, frames_of, get, mean_within, of_kind, percents, ratio,
                                time_until_normal, tracking_share, value_of, visible_while_tracking, worst, worst_of,
                                wrong_after_start, wrong_matches)
from pages import number

CUT_SURFACE = ("cut_surface.distance.max_mm", "cut_surface.missed.max_mm")
HELD_S = (1.5, 3.5)  # when the hands of `touch` and `squeeze` hold the body
MOVING_S, RESTED_S = (0.5, 5.0), 7.0  # of `far`; it has been at rest for 2 s
OFF = f"frames called TRACKING with a visible vertex more than {WRONG_MM:.0f} mm off"


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


def volume_error(reports, scene):
    """The largest error of the volume [%]."""
    share = value_of(reports, "scene", scene, "volume.largest_error")
    return None if share is None else 100.0 * abs(share)


def wrong_while_tracking(reports):
    """Frames called TRACKING with a visible vertex far off; None if no frame was called so."""
    errors = [error for report in reports for error in visible_while_tracking(report)]
    return sum(error > WRONG_MM for error in errors) if errors else None


def checked(reports):
    return [report for kind in ("scene", *TEXTURES) for report in of_kind(reports, kind).values()]


def plain_goals(reports):
    still = frames_of(reports.get(("plain", "still")))
    return [
        (f"one colour: mean error of visible vertices, worst of {', '.join(NOISE_FREE)}", "<= 1.0 mm",
         worst_of(reports, "plain", NOISE_FREE, VISIBLE)),
        ("one colour: mean error of hidden vertices, worst of the same", "<= 2.5 mm",
         worst_of(reports, "plain", NOISE_FREE, HIDDEN)),
        ("one colour: still: mean error of all vertices", "<= 0.35 mm", value_of(reports, "plain", "still", ALL)),
        ("one colour: still: mean error of the worst frame", "<= 0.5 mm",
         max((frame.mean for frame in still), default=None)),
        ("one colour: rigid: mean error of all vertices", "<= 0.6 mm", value_of(reports, "plain", "rigid", ALL)),
        (f"one colour: mean distance between the results of {STARTS} starts, worst frame of {', '.join(PLAIN)}",
         "<= 0.3 mm", worst_of(reports, "starts", PLAIN, "max_mm"))]


def hand_goals(reports):
    touch = reports.get(("scene", "touch"))
    return [
        ("touch: mean error of visible vertices while held", "<= 1.0 mm", mean_within(touch, "visible", *HELD_S)),
        ("touch: mean error of the part that the hand hides", "<= 3.0 mm", mean_within(touch, "covered", *HELD_S)),
        ("touch: time until the error is at most 1.2 times that without the hand", "<= 0.2 s",
         time_until_normal(touch, reports.get(("unhidden", "touch")), HELD_S[1])),
        ("squeeze: mean error of visible vertices", "<= 0.6 mm", value_of(reports, "scene", "squeeze", VISIBLE)),
        ("squeeze: mean error of hidden vertices", "<= 2.0 mm", value_of(reports, "scene", "squeeze", HIDDEN)),
        ("squeeze: error of the volume", "<= 5 %", volume_error(reports, "squeeze"))]


def own_colour_goals(reports):
    held = [reports.get(("plain", name)) for name in OWN_COLOUR]
    return [
        *((f"one colour, hands too: {name}: mean error of visible vertices while held", "<= 1.0 mm",
           mean_within(report, "visible", *HELD_S)) for name, report in zip(OWN_COLOUR, held)),
        (f"one colour, hands too: {OFF}", "<= 0 frames", wrong_while_tracking(held) if all(held) else None)]


def texture_goals(reports):
    return [
        ("soft toy, one colour: mean error of visible vertices, worst of push, pull, twist", "<= 1.0 mm",
         worst_of(reports, "plain", ("doll_push", "doll_pull", "doll_twist"), VISIBLE)),
        (f"weak texture: mean error of visible vertices, worst of {', '.join(NOISE_FREE)}", "<= 1.0 mm",
         worst_of(reports, "weak", NOISE_FREE, VISIBLE)),
        ("soft toy, weak texture: the same", "<= 1.0 mm",
         worst_of(reports, "weak", [f"doll_{name}" for name in NOISE_FREE], VISIBLE)),
        ("one colour: far: mean error of visible vertices while the body moves", "<= 0.8 mm",
         mean_within(reports.get(("plain", "far")), "visible", *MOVING_S)),
        ("one colour: on a table with a shadow: mean error of visible vertices", "<= 1.0 mm",
         value_of(reports, "plain", "table", VISIBLE))]


def label_goals(reports):
    shares = [get(report, "labels.right") for report in checked(reports)]
    return [("labels: right pixels around the body, worst scene", ">= 98 %",
             None if None in shares else percents(min(shares, default=None)))]


def camera_goals(reports):
    far, dim = reports.get(("scene", "far")), reports.get(("scene", "dim"))
    return [
        ("far: mean error of visible vertices while the body moves", "<= 0.8 mm",
         mean_within(far, "visible", *MOVING_S)),
        ("far: the same, after 2 s at rest", "<= 0.5 mm", mean_within(far, "visible", RESTED_S)),
        ("fast: mean error of visible vertices", "<= 0.8 mm", value_of(reports, "scene", "fast", VISIBLE)),
        ("roll: mean error of visible vertices", "<= 0.7 mm", value_of(reports, "scene", "roll", VISIBLE)),
        ("dim: mean error of visible vertices", "<= 0.6 mm", value_of(reports, "scene", "dim", VISIBLE)),
        ("dim: largest error of a visible vertex in frames called TRACKING", "<= 10 mm",
         max(visible_while_tracking(dim), default=None))]


def doll_goals(reports):
    dolls = ("doll_bend", "doll_twist")
    return [
        ("soft toy: mean error of all vertices, worst of bend, twist", "<= 1.8 mm",
         worst_of(reports, "scene", dolls, ALL)),
        ("soft toy: error of the volume, worst of the same", "<= 4 %",
         worst(volume_error(reports, doll) for doll in dolls))]


def solid_goals(reports, words="", body=""):
    """Of scenes whose truth is an elastic body."""
    grip, stamp = f"{body}grip", f"{body}stamp"
    within = percents(value_of(reports, "scene", stamp, "forces.within_90"))
    return [
        (f"{words}grip: mean error of hidden vertices", "<= 1.2 mm", value_of(reports, "scene", grip, HIDDEN)),
        (f"{words}grip: error of all vertices, p95", "<= 3.5 mm",
         value_of(reports, "scene", grip, P95)),
        (f"{words}grip: {OFF}", "<= 0 frames", wrong_while_tracking([reports.get(("scene", grip))])),
        (f"{words}stamp: mean error of visible vertices", "<= 0.35 mm", value_of(reports, "scene", stamp, VISIBLE)),
        (f"{words}stamp: mean error of hidden vertices", "<= 0.6 mm", value_of(reports, "scene", stamp, HIDDEN)),
        (f"{words}stamp: frames whose force is within 10 % or 0.1 N", ">= 95 %",
         percents(value_of(reports, "scene", stamp, "forces.right"))),
        (f"{words}stamp: place of the force, p95", "<= 10 mm",
         value_of(reports, "scene", stamp, "forces.place.p95_mm")),
        *((f"{words}stamp: forces within their 90 % bound", goal, within) for goal in (">= 85 %", "<= 95 %"))]


def honest_goals(reports):
    return [
        (f"{OFF}, all scenes", "<= 0 frames", wrong_while_tracking(checked(reports))),
        *((f"{what}: frames called TRACKING after 1 s", "<= 0 frames", false_tracking(report))
          for what, report in of_kind(reports, "wrong").items()),
        *((f"{what}: {OFF.replace('with', 'after 1 s with', 1)}", "<= 0 frames", wrong_after_start(report))
          for what, report in of_kind(reports, "placed").items())]


def verdict(goal, value):
    """The cells goal, measured and reached."""
    relation, limit, _ = goal.split()
    reached = value is not None and (value <= float(limit) if relation == "<=" else value >= float(limit))
    measured = "never" if value == math.inf else number(value)
    return [goal, measured, "-" if value is None else "yes" if reached else "no"]


def goal_rows(reports):
    parts = (accuracy_goals, robustness_goals, cut_goals, bound_goals, open_loop_goals, toy_goals, plain_goals,
             hand_goals, own_colour_goals, texture_goals, label_goals, camera_goals, doll_goals, solid_goals,
             lambda reports: solid_goals(reports, "soft toy, ", "doll_"), honest_goals)
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
