"""The tracked soft body in Python: states as numpy arrays, live and from bags, and the graph's services as functions.

    for state in softbody.read("result.bag"): ...
    body = softbody.Body(); state = body.wait(); body.cut(point, normal)
"""
from softbody.bag import BagError, ResultBag, read
from softbody.body import Body
from softbody.errors import Cancelled, Refused
from softbody.plan import Plan
from softbody.state import State, SurfaceTopology, Volume, VolumeTopology

__all__ = ["BagError", "Body", "Cancelled", "Plan", "Refused", "ResultBag", "State", "SurfaceTopology", "Volume",
           "VolumeTopology", "read"]
