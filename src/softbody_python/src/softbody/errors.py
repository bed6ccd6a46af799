"""What can go wrong with a request to the graph."""


class Refused(Exception):
    """The graph has refused a request. The message is its reason."""


class Cancelled(Exception):
    """A prediction was cancelled, or another one has replaced it."""
