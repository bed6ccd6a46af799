"""The goals of scenes like the real world: hands, distance, speed, low light, bodies of one colour, wrong objects."""
from evaluation.figures import (OWN_COLOUR, PLAIN, PLAIN_MOTIONS, TEXTURES, WRONG_MM, false_tracking, get, mean_within,
                                of_kind, time_until_normal, visible_while_tracking, worst, wrong_after_start)

HELD_S = (1.5, 3.5)  # when the hands of `touch` and `squeeze` hold the body
MOVING_S, RESTED_S = (0.5, 5.0), 7.0  # of `far`; it has been at rest for 2 s


def largest(values):
    """The largest; None if there is none."""
    return max(values, default=None)


def volume(report):
    """The largest error of the volume [%]."""
    share = get(report, "volume", "largest_error")
    return None if share is None else 100.0 * abs(share)


def wrong_while_tracking(reports):
    """Frames called TRACKING with a visible vertex far off; None if no frame was called so."""
    errors = [error for report in reports for error in visible_while_tracking(report)]
    return sum(error > WRONG_MM for error in errors) if errors else None


def plain_goals(reports):
    def of(name, *keys):
        return get(reports.get(("plain", name)), "vertex_error", *keys)

    motions = ", ".join(PLAIN_MOTIONS)
    return [
        (f"one colour: mean error of visible vertices, worst of {motions}", "<= 1.0", "mm",
         worst(of(name, "visible", "mean_mm") for name in PLAIN_MOTIONS)),
        ("one colour: mean error of hidden vertices, worst of the same", "<= 2.5", "mm",
         worst(of(name, "hidden", "mean_mm") for name in PLAIN_MOTIONS)),
        ("one colour: still: mean error of all vertices", "<= 0.35", "mm", of("still", "all", "mean_mm")),
        ("one colour: still: mean error of the worst frame", "<= 0.5", "mm",
         largest(of("still", "frame_mean_mm") or [])),
        ("one colour: rigid: mean error of all vertices", "<= 0.6", "mm", of("rigid", "all", "mean_mm")),
        (f"one colour: mean distance between the results of 20 starts, worst frame of {', '.join(PLAIN)}", "<= 0.3",
         "mm", worst(get(reports.get(("starts", name)), "max_mm") for name in PLAIN))]


def hand_goals(reports):
    touch, squeeze = reports.get(("scene", "touch")), reports.get(("scene", "squeeze"))
    return [
        ("touch: mean error of visible vertices while held", "<= 1.0", "mm",
         mean_within(touch, "frame_visible_mean_mm", *HELD_S)),
        ("touch: mean error of the part that the hand hides", "<= 3.0", "mm",
         mean_within(touch, "frame_covered_mean_mm", *HELD_S)),
        ("touch: time until the error is at most 1.2 times that without the hand", "<= 0.2", "s",
         time_until_normal(touch, reports.get(("unhidden", "touch")), HELD_S[1])),
        ("squeeze: mean error of visible vertices", "<= 0.6", "mm",
         get(squeeze, "vertex_error", "visible", "mean_mm")),
        ("squeeze: mean error of hidden vertices", "<= 2.0", "mm", get(squeeze, "vertex_error", "hidden", "mean_mm")),
        ("squeeze: error of the volume", "<= 5", "%", volume(squeeze))]


def texture_goals(reports):
    def worst_of(kind, scenes):
        return worst(get(reports.get((kind, scene)), "vertex_error", "visible", "mean_mm") for scene in scenes)

    dolls = [f"doll_{name}" for name in PLAIN_MOTIONS]
    return [
        ("soft toy, one colour: mean error of visible vertices, worst of push, pull, twist", "<= 1.0", "mm",
         worst_of("plain", ("doll_push", "doll_pull", "doll_twist"))),
        (f"weak texture: mean error of visible vertices, worst of {', '.join(PLAIN_MOTIONS)}", "<= 1.0", "mm",
         worst_of("weak", PLAIN_MOTIONS)),
        ("soft toy, weak texture: the same", "<= 1.0", "mm", worst_of("weak", dolls)),
        ("one colour: far: mean error of visible vertices while the body moves", "<= 0.8", "mm",
         mean_within(reports.get(("plain", "far")), "frame_visible_mean_mm", *MOVING_S)),
        ("one colour: on a table with a shadow: mean error of visible vertices", "<= 1.0", "mm",
         worst_of("plain", ("table",)))]


def label_goals(reports):
    checked = [report for kind in ("scene", *TEXTURES) for report in of_kind(reports, kind).values()]
    shares = [get(report, "labels", "right") for report in checked]
    return [("labels: right pixels around the body, worst scene", ">= 98", "%",
             None if None in shares else min((100.0 * share for share in shares), default=None))]


def own_colour_goals(reports):
    held = [reports.get(("plain", name)) for name in OWN_COLOUR]
    return [
        *((f"one colour, hands too: {name}: mean error of visible vertices while held", "<= 1.0", "mm",
           mean_within(report, "frame_visible_mean_mm", *HELD_S)) for name, report in zip(OWN_COLOUR, held)),
        (f"one colour, hands too: frames called TRACKING with a visible vertex more than {WRONG_MM:.0f} mm off", "<= 0",
         "frames", wrong_while_tracking(held) if all(held) else None)]


def camera_goals(reports):
    far, dim = reports.get(("scene", "far")), reports.get(("scene", "dim"))

    def visible(name):
        return get(reports.get(("scene", name)), "vertex_error", "visible", "mean_mm")

    return [
        ("far: mean error of visible vertices while the body moves", "<= 0.8", "mm",
         mean_within(far, "frame_visible_mean_mm", *MOVING_S)),
        ("far: the same, after 2 s at rest", "<= 0.5", "mm", mean_within(far, "frame_visible_mean_mm", RESTED_S)),
        ("fast: mean error of visible vertices", "<= 0.8", "mm", visible("fast")),
        ("roll: mean error of visible vertices", "<= 0.7", "mm", visible("roll")),
        ("dim: mean error of visible vertices", "<= 0.6", "mm", visible("dim")),
        ("dim: largest error of a visible vertex in frames called TRACKING", "<= 10", "mm",
         largest(visible_while_tracking(dim)))]


def doll_goals(reports):
    dolls = [reports.get(("scene", name)) for name in ("doll_bend", "doll_twist")]
    return [
        ("soft toy: mean error of all vertices, worst of bend, twist", "<= 1.8", "mm",
         worst(get(doll, "vertex_error", "all", "mean_mm") for doll in dolls)),
        ("soft toy: error of the volume, worst of the same", "<= 4", "%", worst(volume(doll) for doll in dolls))]


def honest_goals(reports):
    checked = [report for kind in ("scene", *TEXTURES) for report in of_kind(reports, kind).values()]
    wrong = of_kind(reports, "wrong")
    return [
        (f"frames called TRACKING with a visible vertex more than {WRONG_MM:.0f} mm off, all scenes", "<= 0", "frames",
         wrong_while_tracking(checked)),
        *((f"{what}: frames called TRACKING after 1 s", "<= 0", "frames", false_tracking(report))
          for what, report in wrong.items()),
        *((f"{what}: frames called TRACKING after 1 s with a visible vertex more than {WRONG_MM:.0f} mm off", "<= 0",
           "frames", wrong_after_start(report)) for what, report in of_kind(reports, "placed").items())]


def solid_goals(reports):
    """Of scenes whose truth is an elastic body."""
    goals = []
    for words, body in (("", ""), ("soft toy, ", "doll_")):
        grip, stamp = reports.get(("scene", f"{body}grip")), reports.get(("scene", f"{body}stamp"))
        right, within = (None if share is None else 100.0 * share
                         for share in (get(stamp, "forces", key) for key in ("right", "within_90")))
        goals += [
            (f"{words}grip: mean error of hidden vertices", "<= 1.2", "mm",
             get(grip, "vertex_error", "hidden", "mean_mm")),
            (f"{words}grip: error of all vertices, p95", "<= 3.5", "mm", get(grip, "vertex_error", "all", "p95_mm")),
            (f"{words}grip: frames called TRACKING with a visible vertex more than {WRONG_MM:.0f} mm off", "<= 0",
             "frames", wrong_while_tracking([grip])),
            (f"{words}stamp: mean error of visible vertices", "<= 0.35", "mm",
             get(stamp, "vertex_error", "visible", "mean_mm")),
            (f"{words}stamp: mean error of hidden vertices", "<= 0.6", "mm",
             get(stamp, "vertex_error", "hidden", "mean_mm")),
            (f"{words}stamp: frames whose force is within 10 % or 0.1 N", ">= 95", "%", right),
            (f"{words}stamp: place of the force, p95", "<= 10", "mm", get(stamp, "forces", "place", "p95_mm")),
            *((f"{words}stamp: forces within their 90 % bound", goal, "%", within) for goal in (">= 85", "<= 95"))]
    return goals


def world_goals(reports):
    return [*plain_goals(reports), *hand_goals(reports), *own_colour_goals(reports), *texture_goals(reports),
            *label_goals(reports), *camera_goals(reports), *doll_goals(reports), *solid_goals(reports),
            *honest_goals(reports)]
