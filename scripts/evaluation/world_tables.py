"""The rows of the tables in docs/evaluation.md on bodies of one colour, predicted errors and wrong objects."""
from evaluation.figures import (FALSE_AFTER_S, MEANS, OWN_COLOUR, PLAIN, TEXTURED, TEXTURES, calibration_bins,
                                false_tracking, frames_of, get, of_kind)
from evaluation.tables import beside, numbers, tracked
from pages import ROOT, number, percent
from plots import log_plot


def plain_bodies(reports):
    return [[name, *tracked(report), *numbers(report, *MEANS), number(max(frame.mean for frame in frames_of(report))),
             *numbers(report, "jitter.per_vertex.rms_mm"), *beside(reports, ("starts",), name, "mean_mm", "max_mm")]
            for name, report in of_kind(reports, "plain").items() if name in (*PLAIN, *OWN_COLOUR)]


def textures(reports):
    kinds = ("scene", *TEXTURES)
    return [[scene, *beside(reports, kinds, scene, *MEANS[1:])] for scene in TEXTURED
            if any((kind, scene) in reports for kind in TEXTURES)]


def predicted_errors(reports):
    words = {"scene": "", "plain": ", one colour", "weak": ", weak texture"}
    return [[name + words[kind],
             *(percent(get(report, f"calibration.within_90_{part}")) for part in ("visible", "hidden")),
             *numbers(report, "calibration.median_ratio")]
            for kind in words for name, report in of_kind(reports, kind).items()]


def wrong_objects(reports):
    for what, report in of_kind(reports, "wrong").items():
        late = [state for time, state in report["states_by_time"] if time >= FALSE_AFTER_S]
        yield [what, late[0], f"{false_tracking(report)} of {len(late)}", "-"]
    for what, report in of_kind(reports, "placed").items():
        late = [frame for frame in frames_of(report) if frame.since >= FALSE_AFTER_S]
        yield [what, late[0].state, f"{sum(frame.state == 'tracking' for frame in late)} of {len(late)}",
               number(max(frame.visible_most for frame in late if frame.visible_most is not None))]


def plot_calibration(reports):
    """RMS error over predicted standard deviation; nothing without predictions."""
    bins = calibration_bins(reports)
    if bins:
        log_plot(ROOT / "docs/images/calibration.svg", ("predicted standard deviation [mm]", "RMS error [mm]"),
                 [("each bin of predictions", bins, {"marker": "o", "linestyle": ""}),
                  ("as predicted", [(0.01, 0.01), (100.0, 100.0)], {"color": "#888"})], size=(6.5, 4.5))
