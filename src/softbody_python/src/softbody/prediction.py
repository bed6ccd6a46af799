"""Results of the service simulator/predict and of the action simulator/predict_plans."""
import collections

import numpy as np

# At one time of one plan. time [s] from the present, vertices #V by 3 [m], converged, reactions: name -> (force [N],
# torque about the frame's origin [N m]), contacts: list of Contact.
Prediction = collections.namedtuple("Prediction", "time vertices converged reactions contacts")

# A connected part of the surface that presses on an obstacle. name of the obstacle, place [m], normal of the obstacle,
# towards the body, force of the body on the obstacle [N], torque about the place [N m].
Contact = collections.namedtuple("Contact", "name place normal force torque")


class Predictions(list):
    """Per plan a list with a Prediction per time. stamp and revision of the present state, frame of the results."""

    def __init__(self, answer, time_count):
        """@param answer: of the service or of the action."""
        predictions = [_prediction(state) for state in answer.states]
        super().__init__(predictions[k:k + time_count] for k in range(0, len(predictions), time_count))
        self.stamp, self.frame, self.revision = answer.header.stamp, answer.header.frame_id, answer.revision


def _prediction(state):
    reactions = {name: (_vector(reaction.force), _vector(reaction.torque))
                 for name, reaction in zip(state.names, state.reactions)}
    contacts = [Contact(patch.name, *map(_vector, (patch.place, patch.normal, patch.force, patch.torque)))
                for patch in state.contacts]
    return Prediction(state.time, np.array([[p.x, p.y, p.z] for p in state.vertices]), state.converged, reactions, contacts)


def _vector(v):
    return np.array([v.x, v.y, v.z])
