"""A scene as `voussoir check SCENE --json` prints it -> arrays, and the linear equilibrium of its blocks.

Unknown of every peer: the force of the first block on the second at each contact point, as (t1, t2, n) components, n >= 0.
Equilibrium of the free blocks:  A f + dead + lambda live = 0,  six rows a block (force, moment about its centre of mass).
Forces are counted in mean block weights and moments in those times a metre, so that no peer is handed badly scaled numbers.
"""

import json
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp


@dataclass
class Model:
    """Arrays over blocks (B), interfaces (I) and contact points (P)."""

    support: np.ndarray  # (B,) bool
    mass: np.ndarray  # (B,)
    centroid: np.ndarray  # (B, 3)
    dead: np.ndarray  # (B, 6) force, moment
    live: np.ndarray  # (B, 6)
    face: np.ndarray  # (P,) interface of the point
    point: np.ndarray  # (P, 3)
    first: np.ndarray  # (P,) block the normal points out of
    second: np.ndarray  # (P,) block that feels the force
    frame: np.ndarray  # (P, 3, 3) rows t1, t2, n
    mu: np.ndarray  # (P,)
    gravity: np.ndarray  # (3,)


def load(path):
    """Reads the printed model."""
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    assert data["format"] == "voussoir-model/1", data["format"]
    blocks, faces = data["blocks"], data["interfaces"]
    counts = [len(f["points"]) for f in faces]
    wrench = lambda key: np.array([b[key]["force"] + b[key]["moment"] for b in blocks])
    spread = lambda values: np.repeat(np.array(values, dtype=float), counts, axis=0)
    between = np.repeat(np.array([f["between"] for f in faces]), counts, axis=0)
    return Model(
        support=np.array([b["support"] for b in blocks]),
        mass=np.array([b["mass"] for b in blocks]),
        centroid=np.array([b["centroid"] for b in blocks]),
        dead=wrench("dead"),
        live=wrench("live"),
        face=np.repeat(np.arange(len(faces)), counts),
        point=np.concatenate([f["points"] for f in faces]),
        first=between[:, 0],
        second=between[:, 1],
        frame=spread([[f["t1"], f["t2"], f["n"]] for f in faces]),
        mu=spread([f["friction"] for f in faces]),
        gravity=np.array(data["gravity"]),
    )


def unit(model):
    """The unit of force: the mean weight of the free blocks, N."""
    return model.mass[~model.support].mean() * np.linalg.norm(model.gravity)


def equilibrium(model):
    """A (6F x 3P), dead and live load (6F), in units of `unit`."""
    free = np.cumsum(~model.support) - 1
    axes = model.frame  # (P, 3, 3): one row per unknown
    points = len(model.point)
    columns = np.repeat(3 * np.arange(points).reshape(-1, 1, 1) + np.arange(3).reshape(1, -1, 1), 6, axis=2)
    parts = []
    for block, sign in ((model.first, -1.0), (model.second, 1.0)):
        arm = model.point - model.centroid[block]
        moment = np.cross(arm[:, None, :], axes)
        values = sign * np.concatenate([axes, moment], axis=2)  # (P, 3, 6)
        rows = np.broadcast_to(6 * free[block].reshape(-1, 1, 1) + np.arange(6), values.shape)
        keep = np.broadcast_to(~model.support[block].reshape(-1, 1, 1), values.shape) & (values != 0.0)
        parts.append((values[keep], rows[keep], columns[keep]))
    values, rows, columns = (np.concatenate(x) for x in zip(*parts))
    count = int((~model.support).sum())
    a = sp.csc_matrix((values, (rows, columns)), shape=(6 * count, 3 * points))
    flat = lambda load: load[~model.support].reshape(-1) / unit(model)
    return a, flat(model.dead), flat(model.live)


def plane(model):
    """The same in the x-z plane: three rows a block (x, z, moment about y), two unknowns (t, n) a point, one point for each pair along y.

    Exact where scene and loads are mirrored about y = 0, as all scenes of this comparison are (averaging forces and their mirror image
    leaves their in-plane part alone). Returns A, dead, live and mu per point.
    """
    assert np.abs(model.frame[:, 2, 1]).max() < 1e-12, "a normal leaves the plane"
    assert np.abs(model.live[:, [1, 3, 5]]).max() < 1e-9 * unit(model), "the live load leaves the plane"
    across = np.round(model.point[:, [0, 2]], 9) + 0.0
    _, kept = np.unique(np.column_stack([model.face, across]), axis=0, return_index=True)
    kept.sort()
    normal = model.frame[kept, 2]
    tangent = np.column_stack([normal[:, 2], np.zeros(len(kept)), -normal[:, 0]])
    zero = np.zeros_like(normal)
    small = Model(**{**vars(model), "face": model.face[kept], "point": model.point[kept], "first": model.first[kept],
                     "second": model.second[kept], "frame": np.stack([tangent, zero, normal], axis=1), "mu": model.mu[kept]})
    a, dead, live = equilibrium(small)
    rows = np.flatnonzero(np.isin(np.arange(a.shape[0]) % 6, [0, 2, 4]))
    columns = np.flatnonzero(np.arange(a.shape[1]) % 3 != 1)
    return a[rows][:, columns], dead[rows], live[rows], small.mu
