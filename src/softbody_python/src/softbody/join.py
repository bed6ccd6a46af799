"""Joins positions with their topologies, and the surface with the volume. Free of ROS connections."""
from softbody.state import State, Volume, VolumeTopology

MOST_WAITING = 300  # states without a topology: 10 s at 30 Hz


class Topologies:
    """The topologies of one mesh that may still be needed, by revision."""

    def __init__(self):
        self.by_revision = {}

    def add(self, topology):
        # A lower revision than before: the graph has started again, and higher ones are of its last life.
        self.by_revision = {revision: known for revision, known in self.by_revision.items()
                            if revision < topology.revision}
        self.by_revision[topology.revision] = topology

    def of(self, positions):
        """The topology of these positions, or None."""
        topology = self.by_revision.get(positions.revision)
        fits = topology is not None and len(topology.rest_vertices) == len(positions.vertices)
        return topology if fits else None

    def forget_before(self, revision):
        self.by_revision = {known: topology for known, topology in self.by_revision.items() if known >= revision}


class Joiner:
    """Takes messages as they arrive, and gives complete states in the order of the surface's.

    A surface state waits for its topology, and for the volume state of the same stamp. It goes without volume if
    `patience` later surface states are there.
    """

    def __init__(self, with_volume=True, patience=3):
        self.with_volume, self.patience = with_volume, patience
        self.surfaces, self.volumes = Topologies(), Topologies()
        self.waiting = []         # surface positions in order of arrival
        self.volume_states = {}   # volume positions by stamp, in order of arrival

    def add_topology(self, topology):
        """Returns the states that are complete now."""
        known = self.volumes if isinstance(topology, VolumeTopology) else self.surfaces
        known.add(topology)
        return self._take()

    def add_surface(self, positions):
        """Returns the states that are complete now."""
        if self.waiting and positions.stamp < self.waiting[-1].stamp:
            self.waiting.clear()  # time has jumped back: what still waits is of the last life
        self.waiting.append(positions)
        del self.waiting[:-MOST_WAITING]
        return self._take()

    def add_volume(self, positions):
        """Returns the states that are complete now."""
        if self.volume_states and positions.stamp < next(reversed(self.volume_states)):
            self.volume_states.clear()
        self.volume_states[positions.stamp] = positions
        while len(self.volume_states) > MOST_WAITING:
            del self.volume_states[next(iter(self.volume_states))]
        return self._take()

    def finish(self):
        """The states that still wait for a volume, which will not come."""
        self.patience = 0
        return self._take()

    def _take(self):
        states = []
        while True:
            # Topologies come in order. If that of a later state is here, the earlier one is not to come.
            first = next((k for k, positions in enumerate(self.waiting) if self.surfaces.of(positions)), None)
            if first is None:
                return states
            del self.waiting[:first]
            positions = self.waiting[0]
            volume = self._volume_of(positions)
            if volume is None and self._may_get_volume(positions):
                return states
            states.append(State(topology=self.surfaces.of(positions), volume=volume, **vars(self.waiting.pop(0))))
            self._forget_before(positions)

    def _volume_of(self, positions):
        volume = self.volume_states.get(positions.stamp)
        if volume is None or volume.revision != positions.revision or volume.frame != positions.frame:
            return None
        topology = self.volumes.of(volume)
        return topology and Volume(volume.vertices, volume.confidence, volume.standard_deviation, topology)

    def _may_get_volume(self, positions):
        """Whether it is worth to wait: nothing later has come, and what has come is not of another revision."""
        if not self.with_volume or len(self.waiting) > self.patience:
            return False
        volume = self.volume_states.get(positions.stamp)
        if volume is not None:
            return volume.revision == positions.revision and volume.frame == positions.frame
        return all(stamp < positions.stamp for stamp in self.volume_states)

    def _forget_before(self, positions):
        self.surfaces.forget_before(positions.revision)
        self.volumes.forget_before(positions.revision)
        self.volume_states = {stamp: volume for stamp, volume in self.volume_states.items() if stamp > positions.stamp}
