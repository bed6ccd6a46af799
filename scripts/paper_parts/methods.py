"""The methods that `make paper` compares: texts of parameters of `replay`, or command lines of `paper_method`."""
OURS = "ours"
PAPER = "paper_method"  # the program of softbody_evaluation
PLAIN = {"lbfgs_history": 0, "strain_smoothing": 0.0, "volume_smoothing": 0.0, "load_fade_s": 0.0, "memory_s": 0.0}
UNSMOOTHED_FEM = {"solver": "fem", "strain_smoothing": 0.0, "volume_smoothing": 0.0}
NO_LOADS = {"load_fade_s": 0.0, "memory_s": 0.0}
TIMED = {"sponge": "bend", "doll": "doll_bend"}
CUT_THROUGH = ("cut", "doll_cut")
TEAR = "tear"
SCENES = ("bend", "push", "doll_bend", "doll_push")
MOST_FEATURES = 1000  # the default of max_features
FEATURES = (0, 10, 25, 50, 100, 300, MOST_FEATURES)
FEWEST_OF_PAPER = 50  # with fewer, most vertices have no feature within delta_k
FEATURES_ALONE = {"depth_weight": 1e-6, "outline_weight": 0.0}

WITH_PD = "the same, plain projective dynamics (eq. 10-11)"


def parameters(tracker=None, simulator=None):
    sections = {"feature_tracker": tracker, "simulator": simulator}
    return "".join(f"{name}: {{{', '.join(f'{key}: {value}' for key, value in values.items())}}}\n"
                   for name, values in sections.items() if values)


# The methods of the table of accuracy.
COMPARED = {"as written: ORB between frames, eq. 3-4, no simulation": PAPER,
            WITH_PD: f"{PAPER} --shape pd",
            "the same, one Newton step of FEM (eq. 8-9)": f"{PAPER} --shape fem",
            "our features, eq. 3-4, no simulation": f"{PAPER} --own-features",
            "our features, eq. 3-4, plain projective dynamics": f"{PAPER} --own-features --shape pd",
            OURS: ""}
# The methods of Table 2.
TIMED_KINDS = {"its method here": COMPARED[WITH_PD], "ours, features alone": parameters(FEATURES_ALONE), OURS: ""}
# The parts of our method, one added after the other; the last row is ours.
WORTH = {"features as material points, plain projective dynamics": parameters(FEATURES_ALONE, PLAIN),
         "+ L-BFGS": parameters(FEATURES_ALONE, {**NO_LOADS, "strain_smoothing": 0.0, "volume_smoothing": 0.0}),
         "+ smoothed strains": parameters(FEATURES_ALONE, NO_LOADS),
         "+ loads": parameters(FEATURES_ALONE),
         "+ depth": parameters({"outline_weight": 0.0}),
         "+ outline = ours": ""}
# Ours, with other simulators in the whole loop of tracking.
SIMULATORS = {"ours: projective dynamics with L-BFGS": "",
              "finite elements (Newton)": parameters(simulator={"solver": "fem"}),
              "finite elements (Newton), strains not smoothed": parameters(simulator=UNSMOOTHED_FEM),
              "mass-spring (Newton)": parameters(simulator={**UNSMOOTHED_FEM, "elasticity": "springs"})}
# Limits of the number of features, for our tracker and for the paper's.
COUNTS = {**{f"ours, at most {limit}": parameters({"max_features": limit}) if limit != MOST_FEATURES else ""
             for limit in FEATURES},
          **{f"as written, plain projective dynamics, at most {limit}": f"{PAPER} --shape pd --max-features {limit}"
             for limit in FEATURES if limit >= FEWEST_OF_PAPER}}
