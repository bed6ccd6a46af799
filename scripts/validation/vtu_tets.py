"""Tet meshes that `rosrun softbody_sim simulate` has written as VTU."""
import numpy as np


def column(vtu, mark, kind):
    text = vtu.read_text()
    return np.array(text[text.index(mark):].split(">", 1)[1].split("<", 1)[0].split(), dtype=kind)


def positions(vtu):
    """The vertices of a VTU that the tool has written."""
    return column(vtu, 'NumberOfComponents="3"', float).reshape(-1, 3)


def cells(vtu):
    """The tets of a VTU that the tool has written."""
    return column(vtu, 'Name="connectivity"', int).reshape(-1, 4)


def second_moment(vertices, tets, axis):
    """The integral of squared distance from the centroid along an axis, exactly, over tets."""
    x, volumes = vertices[tets][:, :, axis], np.linalg.det(vertices[tets[:, 1:]] - vertices[tets[:, :1]]) / 6.0
    x = x - (volumes @ x.mean(axis=1)) / volumes.sum()
    return (volumes * ((x**2).sum(axis=1) + x.sum(axis=1)**2)).sum() / 20.0
