"""Frames of a recording with what was tracked in them."""
import dataclasses

import numpy as np
import softbody

from evaluation.bags import messages, places


@dataclasses.dataclass(frozen=True, eq=False)
class Moment:
    """One frame of a recording with its result. Positions are in the camera's frame [m]."""

    image: np.ndarray     # rows x columns x 3, RGB
    camera: np.ndarray    # 3 x 3 intrinsic matrix
    state: softbody.State
    origins: np.ndarray   # K x 3: where each feature was first seen
    features: np.ndarray  # K x 3: where it is now

    @property
    def cage(self):
        """Vertices and triangles of the low-resolution model."""
        return self.state.volume.vertices, self.state.volume.topology.surface_triangles

    @property
    def surface(self):
        """Vertices and triangles of the high-resolution model."""
        return self.state.vertices, self.state.topology.triangles


def read_features(result):
    """{stamp: {id: position}}"""
    found = {}
    kind = np.dtype([("place", "<f4", 3), ("id", "<i4"), ("pixel", "<f4", 2), ("confidence", "<f4")])
    for cloud in messages(result, "/softbody/features"):
        rows = np.frombuffer(cloud.data, kind, cloud.width * cloud.height)
        found[cloud.header.stamp] = dict(zip(rows["id"].tolist(), rows["place"]))
    return found


def read_blades(result):
    """{stamp: corners of the blade}"""
    return {message.header.stamp: places(message.polygon.points)
            for message in messages(result, "/softbody/tool/blade")}


def read_images(recording, stamps):
    """Colour images by stamp."""
    return {message.header.stamp: np.frombuffer(message.data, np.uint8).reshape(message.height, message.width, 3)
            for message in messages(recording, "/camera/color/image_raw") if message.header.stamp in stamps}


def most_deformed(states):
    """The first state, and the one that differs most from it."""
    return states[0], max(states, key=lambda state: np.square(state.vertices - states[0].vertices).sum())


def around_cut(states):
    """The first state after the first cut, and the last state."""
    return next(state for state in states if state.revision > 0), states[-1]


def around_tear(states):
    """The last state before the body tears, the first one after it, and the last of all."""
    torn = next(number for number, state in enumerate(states) if state.revision > 0)
    return states[torn - 1], states[torn], states[-1]


def moments(recording, result, choose=most_deformed):
    """The moments at the states that are chosen from all states with features."""
    features = read_features(result)
    states = choose([state for state in softbody.read(result) if features.get(state.stamp)])
    images = read_images(recording, {state.stamp for state in states})
    camera = np.array(next(messages(recording, "/camera/color/camera_info")).K).reshape(3, 3)
    return [moment(state, images[state.stamp], camera, features) for state in states]


def moment(state, image, camera, features):
    origins = {}
    for stamp in sorted(features):
        if stamp <= state.stamp:
            origins = {**features[stamp], **origins}
    now = features[state.stamp]
    return Moment(image, camera, state, np.array([origins[number] for number in now]), np.array(list(now.values())))
