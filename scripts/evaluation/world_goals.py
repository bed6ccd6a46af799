"""The goals of scenes like the real world: hands, distance, speed, low light, bodies of one colour, wrong objects."""
from evaluation.figures import (ALL, HIDDEN, NOISE_FREE, OWN_COLOUR, P95, PLAIN, STARTS, TEXTURES, VISIBLE, WRONG_MM,
                                false_tracking, frames_of, get, mean_within, of_kind, percents, time_until_normal,
                                value_of, visible_while_tracking, worst, worst_of, wrong_after_start)

HELD_S = (1.5, 3.5)  # when the hands of `touch` and `squeeze` hold the body
MOVING_S, RESTED_S = (0.5, 5.0), 7.0  # of `far`; it has been at rest for 2 s
OFF = f"frames called TRACKING with a visible vertex more than {WRONG_MM:.0f} mm off"


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


def solid_goals(reports, words, body):
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


def world_goals(reports):
    return [*plain_goals(reports), *hand_goals(reports), *own_colour_goals(reports), *texture_goals(reports),
            *label_goals(reports), *camera_goals(reports), *doll_goals(reports), *solid_goals(reports, "", ""),
            *solid_goals(reports, "soft toy, ", "doll_"), *honest_goals(reports)]
