#!/usr/bin/env python3
"""States have the topology of their revision and the volume of their stamp, in whatever order messages arrive."""
import sys
import unittest

import numpy as np
import rostest

import hand_made
from softbody.join import Joiner
from softbody.state import VolumeTopology
from softbody.wire import decode

FRAMES = 60


def decoded(message):
    return decode(message._type, message._md5sum, hand_made.data_of(message))


def stream(seed, revisions, delays, first=0):
    """(arrival, adder, message) of a run, sorted by arrival. @param delays: largest of each topic, in frames."""
    random = np.random.default_rng((seed, 9))
    topics = {"volume/topology": [], "volume/state": [], "surface/topology": [], "surface/state": []}
    for frame, revision in enumerate(revisions, first):
        if frame == first or revision != revisions[frame - first - 1]:
            topics["volume/topology"].append((frame, "add_topology", hand_made.volume_topology(seed, revision, frame)))
            topics["surface/topology"].append((frame, "add_topology", hand_made.surface_topology(seed, revision, frame)))
        topics["volume/state"].append((frame, "add_volume", hand_made.volume_state(seed, frame, revision)))
        topics["surface/state"].append((frame, "add_surface", hand_made.surface_state(seed, frame, revision)))
    arrivals = []
    for name, messages in topics.items():
        times = np.array([frame for frame, _, _ in messages]) + random.random(len(messages)) * delays.get(name, 0)
        times = np.maximum.accumulate(times)  # a topic keeps its order
        arrivals += [(time, len(arrivals), add, decoded(message)) for time, (_, add, message) in zip(times, messages)]
    return [(add, message) for _, _, add, message in sorted(arrivals, key=lambda item: item[:2])]


def random_revisions(seed):
    return np.cumsum(np.random.default_rng((seed, 8)).random(FRAMES) < 0.15).tolist()


class Join(unittest.TestCase):
    def feed(self, joiner, messages):
        return [state for add, message in messages for state in getattr(joiner, add)(message)]

    def feed_all(self, joiner, messages):
        return self.feed(joiner, messages) + joiner.finish()

    def expect_whole(self, state):
        self.assertEqual(state.revision, state.topology.revision)
        self.assertEqual(state.rest_vertices.shape, state.vertices.shape)
        if state.volume is not None:
            self.assertEqual(state.volume.topology.revision, state.revision)
            self.assertEqual(state.volume.vertices.shape, state.volume.topology.rest_vertices.shape)

    def test_any_order_of_arrival(self):
        """Nothing is lost, mixed or out of order, while delays are within the patience."""
        for seed in range(30):
            revisions = random_revisions(seed)
            delays = {"volume/topology": 2, "volume/state": 2, "surface/topology": 5, "surface/state": 1}
            states = self.feed_all(Joiner(patience=4), stream(seed, revisions, delays))
            self.assertEqual([state.stamp for state in states], [hand_made.stamp_of(k) for k in range(FRAMES)])
            self.assertEqual([state.revision for state in states], revisions)
            for frame, state in enumerate(states):
                self.expect_whole(state)
                expected = hand_made.volume_state(seed, frame, revisions[frame])
                np.testing.assert_array_equal(state.volume.vertices, hand_made.array(expected.vertices))

    def test_a_volume_that_is_late_is_not_another_one(self):
        for seed in range(10):
            states = self.feed_all(Joiner(patience=1), stream(seed, random_revisions(seed), {"volume/state": 20}))
            self.assertEqual(len(states), FRAMES)
            self.assertIn(None, [state.volume for state in states])
            for state in states:
                self.expect_whole(state)

    def test_without_volume_a_state_does_not_wait(self):
        joiner = Joiner(with_volume=False)
        for add, message in stream(1, [0, 0, 1], {}):
            if add != "add_volume" and not isinstance(message, VolumeTopology):
                self.assertEqual(len(getattr(joiner, add)(message)), 1 if add == "add_surface" else 0)

    def test_from_the_middle_of_a_run(self):
        """A state whose topology was sent before does not hold up later ones."""
        revisions = [0] * 5 + [1] * 5
        messages = [item for item in stream(1, revisions, {}) if item[1].stamp != hand_made.stamp_of(0)]
        states = self.feed_all(Joiner(), messages)
        self.assertEqual([state.revision for state in states], [1] * 5)

    def test_after_a_restart(self):
        """Revisions begin at 0 again. A state does not get a topology of the run before, which may look alike."""
        for seed in range(2, 12):
            joiner = Joiner()
            self.feed(joiner, stream(1, [0, 1, 2], {}))
            again = self.feed_all(joiner, stream(seed, [0, 1, 2, 2, 2], {"surface/topology": 2}))
            self.assertEqual([state.revision for state in again], [0, 1, 2, 2, 2])
            for state in again:
                self.expect_whole(state)
                rest = hand_made.array(hand_made.surface_topology(seed, state.revision).rest_vertices)
                np.testing.assert_array_equal(state.rest_vertices, rest)

    def test_a_volume_of_another_revision(self):
        """With the same stamp, it is not the state's volume, and there is nothing to wait for."""
        joiner = Joiner()
        for revision in (0, 1):
            joiner.add_topology(decoded(hand_made.volume_topology(1, revision)))
        joiner.add_topology(decoded(hand_made.surface_topology(1, 0)))
        joiner.add_volume(decoded(hand_made.volume_state(1, 5, 1)))
        state, = joiner.add_surface(decoded(hand_made.surface_state(1, 5, 0)))
        self.assertIsNone(state.volume)

    def test_memory_stays_bounded(self):
        joiner = Joiner()
        for add, message in stream(1, list(range(400)), {}):
            getattr(joiner, add)(message)
        kept = [joiner.surfaces.by_revision, joiner.volumes.by_revision, joiner.waiting, joiner.volume_states]
        self.assertLess(max(map(len, kept)), 5)
        for frame in range(400, 1000):
            joiner.add_surface(decoded(hand_made.surface_state(1, frame, 999)))
        self.assertLessEqual(len(joiner.waiting), 300)


if __name__ == "__main__":
    rostest.rosrun("softbody_python", "join", Join, sys.argv)
