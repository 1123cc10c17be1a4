"""The published matrices of a steel pedestrian bridge (946 degrees of freedom, 17 parts of the stiffness), and what they tell of its geometry.

No coordinates are published. The matrices hold them: without its springs the structure moves as a rigid body along y and z and turns about x and y (two joints of one
height are held along x). A joint is a block of six degrees of freedom, five where x is held, in any order inside. In a turn about x by one radian a joint at (x, y, z)
moves by (0, -z, y), in one about y by (z, 0, -x), and its rotations show one.

Units are kip, inch and second; frequencies are in Hz.
"""
import dataclasses
import functools
import os
import pathlib

import numpy as np
import scipy.io
import scipy.linalg
import scipy.sparse.linalg

ROOT = pathlib.Path(__file__).resolve().parents[3]
DATA = pathlib.Path(os.environ.get("TWINDECK_DATA", ROOT.parent / "shared" / "data")) / "gt_pedestrian_bridge"
SPRINGS = ("y1", "y2", "z1", "z2")
X, Y, Z, RX, RY, RZ = range(6)


def is_at_hand():
    return (DATA / "M0.mtx").is_file()


@dataclasses.dataclass(frozen=True)
class Bridge:
    stiffness: dict         # part -> (n_dofs x n_dofs) [kip/in]
    mass: np.ndarray        # (n_dofs) lumped: zero at rotations
    measured: list          # degrees of freedom of the published channels, counted from 0
    joint_of: np.ndarray    # (n_dofs)
    direction: np.ndarray   # (n_dofs) X to RZ
    place: np.ndarray       # (n_joints x 3) [in]

    @property
    def length(self):
        return float(np.ptp(self.place[:, 0]))

    def dofs_of(self, joint, *directions):
        """Those that are not held."""
        return [int(i) for i in np.flatnonzero(self.joint_of == joint) if self.direction[i] in directions]

    def total_mass(self):
        """Along one direction [kip s^2/in]."""
        return float(self.mass[self.direction == Z].sum())

    @functools.cached_property
    def roots(self):
        """part -> (its degrees of freedom, square root of its stiffness on them); springs to the ground have no inside and are left out."""
        found = {}
        for part, matrix in self.stiffness.items():
            if part not in SPRINGS:
                rows = np.flatnonzero(np.abs(matrix).sum(axis=1))
                values, vectors = np.linalg.eigh(matrix[np.ix_(rows, rows)])
                values[values < 1e-9 * values[-1]] = 0.0
                found[part] = (rows, (vectors * np.sqrt(values)) @ vectors.T)
        return found


def blocks_of_joints(mass):
    """(n_dofs) joint of each: blocks of three rotations without mass and of translations that have one mass."""
    joints, start = [], 0
    while start < len(mass):
        sizes = [n for n in (6, 5) if start + n <= len(mass) and is_joint(mass[start : start + n])]
        if not sizes:
            raise ValueError(f"degrees of freedom from {start + 1} on are no joint")
        joints += [len(set(joints))] * sizes[0]
        start += sizes[0]
    return np.array(joints)


def is_joint(mass):
    carried = mass[mass > 0.0]
    return np.sum(mass == 0.0) == 3 and np.ptp(carried) < 1e-9 * carried[0]


def turn(rigid, at_one, at_zero):
    """The rigid motion that is one at some degrees of freedom and zero at others."""
    wanted = np.concatenate([np.ones(len(at_one)), np.zeros(len(at_zero))])
    return rigid @ np.linalg.lstsq(rigid[np.concatenate([at_one, at_zero])], wanted, rcond=None)[0]


def geometry(stiffness, mass, joint_of):
    """(direction of each degree of freedom, places of joints)"""
    values, vectors = np.linalg.eigh(sum(matrix for part, matrix in stiffness.items() if part not in SPRINGS))
    rigid = vectors[:, np.abs(values) < 1e-6]
    if rigid.shape[1] != 4:
        raise ValueError(f"{rigid.shape[1]} rigid motions, expected 4")
    spring = {part: np.flatnonzero(np.diag(stiffness[part])) for part in SPRINGS}
    along_y, along_z = np.concatenate([spring["y1"], spring["y2"]]), np.concatenate([spring["z1"], spring["z2"]])
    move_y, move_z = turn(rigid, along_y, along_z), turn(rigid, along_z, along_y)
    direction = np.where(move_y > 0.5, Y, np.where(move_z > 0.5, Z, np.where(mass > 0.0, X, RZ)))
    # What is left turns about x and y. About x, degrees of freedom along y move in one proportion to the rotations about x, about y those along x.
    both = np.linalg.qr(np.column_stack([move_y, move_z]))[0]
    turns = np.linalg.svd(rigid - both @ (both.T @ rigid), full_matrices=False)[0][:, :2]
    heights = turns[direction == Y] - turns[direction == Y].mean(axis=0)
    about_x = np.linalg.svd(heights, full_matrices=False)[2][0]  # values of a rotation about x in the two motions, up to a factor
    rotations = np.flatnonzero((mass == 0.0) & (np.linalg.norm(turns, axis=1) > 1e-9))
    aligned = np.abs(turns[rotations] @ about_x) / np.linalg.norm(turns[rotations], axis=1) > 1.0 - 1e-6
    direction[rotations[aligned]], direction[rotations[~aligned]] = RX, RY
    turn_x, turn_y = turn(turns, rotations[aligned], rotations[~aligned]), turn(turns, rotations[~aligned], rotations[aligned])
    place = np.zeros((joint_of.max() + 1, 3))
    for dof, joint in enumerate(joint_of):
        if direction[dof] == Z:
            place[joint, :2] = -turn_y[dof], turn_x[dof]
        elif direction[dof] == Y:
            place[joint, 2] = -turn_x[dof]
    return direction, np.round(place - place.min(axis=0), 3)  # free of rounding, so that draws do not depend on the threads of a library


@functools.lru_cache(maxsize=1)
def read_bridge(data=DATA):
    stiffness = {file.stem[2:]: scipy.io.mmread(file).toarray() for file in sorted(pathlib.Path(data).glob("K_*.mtx"))}
    mass = scipy.io.mmread(data / "M0.mtx").diagonal()
    measured = [int(float(line)) - 1 for line in (data / "meas_dofs.csv").read_text(encoding="utf-8").split()[1:]]
    joint_of = blocks_of_joints(mass)
    return Bridge(stiffness, mass, measured, joint_of, *geometry(stiffness, mass, joint_of))


def modes(stiffness, mass, count):
    """(frequencies [Hz], shapes (n x count), mass-normalised) of the lowest modes. K is positive definite, M may be singular: M phi = 1/omega^2 K phi."""
    low = np.linalg.cholesky(stiffness)

    def product(v):
        half = scipy.linalg.solve_triangular(low, v, trans="T", lower=True, check_finite=False)
        return scipy.linalg.solve_triangular(low, mass @ half, lower=True, check_finite=False)

    size = len(stiffness)
    operator = scipy.sparse.linalg.LinearOperator((size, size), matvec=product, dtype=float)
    values, vectors = scipy.sparse.linalg.eigsh(operator, k=count, which="LA", v0=np.cos(np.arange(size)), tol=1e-12)
    order = np.argsort(-values)
    omega = 1.0 / np.sqrt(values[order])
    shapes = scipy.linalg.solve_triangular(low, vectors[:, order], trans="T", lower=True) * omega
    return omega / (2.0 * np.pi), shapes
