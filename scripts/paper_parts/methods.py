"""The methods that `make paper` compares, as parameters of `replay`."""
import re

from evaluation.runs import ROOT

OURS = "ours"
PAPER_FILE = ROOT / "config/paper.yaml"
PLAIN = {"lbfgs_history": 0, "strain_smoothing": 0.0, "load_fade_s": 0.0}
LINEAR_FEM = {"solver": "fem", "iterations": 1, "load_fade_s": 0.0}
SCENES = ("bend", "push", "doll_bend", "doll_push")
FEATURES = (0, 10, 25, 50, 100, 300, 1000)
FEATURES_ALONE = {"depth_targets": "false"}

# Text of a parameter file by method.
AS_WRITTEN = "as written: features, eq. 3-4, no simulation"
WITH_PD = "the same, plain projective dynamics (eq. 10-11)"
WITH_FEM = "the same, one linearised step of FEM (eq. 8-9)"


def parameters(tracker=None, simulator=None):
    sections = {"feature_tracker": tracker, "simulator": simulator}
    return "".join(f"{name}: {{{', '.join(f'{key}: {value}' for key, value in values.items())}}}\n"
                   for name, values in sections.items() if values)


def paper_tracker():
    """The section of the tracker in config/paper.yaml."""
    return re.search(r"^feature_tracker:\n(?: .*\n)+", PAPER_FILE.read_text(), re.MULTILINE)[0]


def compared():
    """The methods of the table of accuracy."""
    return {AS_WRITTEN: PAPER_FILE.read_text(),
            WITH_PD: paper_tracker() + parameters(simulator=PLAIN),
            WITH_FEM: paper_tracker() + parameters(simulator=LINEAR_FEM),
            OURS: ""}


def parts():
    """The parts of our method, one added after the other; the last row is ours."""
    no_loads = {"load_fade_s": 0.0}
    return {"features as material points, plain projective dynamics": parameters(FEATURES_ALONE, PLAIN),
            "+ L-BFGS": parameters(FEATURES_ALONE, {**no_loads, "strain_smoothing": 0.0}),
            "+ smoothed strains": parameters(FEATURES_ALONE, no_loads),
            "+ loads": parameters(FEATURES_ALONE),
            "+ depth": parameters({"outline_weight": 0.0}),
            "+ outline = ours": "",
            "ours with FEM instead of projective dynamics": parameters(simulator={"solver": "fem"})}


def counts():
    """Limits of the number of features."""
    return {f"at most {limit}": parameters({"max_features": limit}) for limit in FEATURES}
