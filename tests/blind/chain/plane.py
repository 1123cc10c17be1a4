"""A plane structure of members and springs: the plan that a model folder is written from, and a truth of another class.

The plan (`Plan`) is the engineer's: straight Euler-Bernoulli members between nodes, bars that carry axial force alone. `truth_of` makes the real structure of it, by code that shares nothing
with the program: every member in three pieces, flexible in shear, with properties that vary along it, rigid joints where the plan has pins, stays that swing under their force.
Motion in the x-z plane, z up, z-x rotation positive from z to x. SI units.
"""
import dataclasses

import numpy as np
from scipy.linalg import eigh

PIECES = 3  # of each member in the truth
RADIUS_M = 0.08  # of gyration of members that the plan takes as pinned bars: their joints are rigid in the truth


@dataclasses.dataclass
class Member:
    ends: tuple
    group: str
    area: float
    inertia: float     # 0: a bar
    young: float
    density: float
    shear_area: float = 0.0  # of the truth alone; 0: rigid in shear
    pull: float = 0.0        # axial force of a stay [N], of the truth alone


@dataclasses.dataclass
class Plan:
    name: str
    nodes: dict     # number -> (x, z)
    members: list
    held: dict      # node -> directions of "xzr" that are held
    springs: list   # (name, node, direction "x", "z" or "r", stiffness): bearings and feet
    masses: list    # (group, node, kg)
    sensors: list   # (node, "x" or "z")
    length: float   # what "beside" is measured against [m]


@dataclasses.dataclass
class Truth:
    nodes: dict
    members: list
    plan: Plan


def truth_of(plan, random):
    """Severity is drawn: properties vary by 2 to 4 % along members, end pieces are up to 15 % stiffer (joints), bearings differ by up to a quarter."""
    nodes, members, following = dict(plan.nodes), [], max(plan.nodes) + 1
    vary, joint = random.uniform(0.02, 0.04), random.uniform(0.03, 0.15)
    for member in plan.members:
        (x1, z1), (x2, z2) = (np.array(plan.nodes[end]) for end in member.ends)
        chain = [member.ends[0]]
        for piece in range(1, PIECES):
            t = piece / PIECES
            nodes[following] = (x1 + t * (x2 - x1), z1 + t * (z2 - z1))
            chain.append(following)
            following += 1
        chain.append(member.ends[1])
        wave = random.standard_normal(2)
        for piece, ends in enumerate(zip(chain, chain[1:])):
            at = (piece + 0.5) / PIECES
            factor = 1.0 + vary * (wave[0] * np.cos(np.pi * at) + wave[1] * np.sin(np.pi * at))
            factor *= 1.0 + (joint if piece in (0, PIECES - 1) and member.pull == 0.0 else 0.0)
            inertia = member.inertia or (RADIUS_M**2 * member.area if member.pull == 0.0 else 0.0)  # members of a truss are joined rigidly
            members.append(dataclasses.replace(member, ends=ends, young=member.young * factor, inertia=inertia))
    springs = [(name, node, d, k * random.uniform(0.8, 1.25)) for name, node, d, k in plan.springs]
    return Truth(nodes, members, dataclasses.replace(plan, springs=springs))


def member_matrices(length, member):
    """(6 x 6) stiffness and mass in local axes u, w, rotation: Timoshenko for shear, consistent mass, and the string stiffness of its pull."""
    bend = member.young * member.inertia
    shear = 12.0 * bend / (member.young / 2.6 * member.shear_area * length**2) if member.shear_area > 0.0 else 0.0
    stiffness, mass = np.zeros((6, 6)), np.zeros((6, 6))
    stiffness[np.ix_((0, 3), (0, 3))] = member.young * member.area / length * np.array([[1, -1], [-1, 1]])
    l = length
    stiffness[np.ix_((1, 2, 4, 5), (1, 2, 4, 5))] = bend / (l**3 * (1.0 + shear)) * np.array(
        [[12, 6 * l, -12, 6 * l], [6 * l, (4 + shear) * l * l, -6 * l, (2 - shear) * l * l],
         [-12, -6 * l, 12, -6 * l], [6 * l, (2 - shear) * l * l, -6 * l, (4 + shear) * l * l]]
    )
    stiffness[np.ix_((1, 4), (1, 4))] += member.pull / l * np.array([[1, -1], [-1, 1]])
    per_m = member.density * member.area * l
    mass[np.ix_((0, 3), (0, 3))] = per_m / 6.0 * np.array([[2, 1], [1, 2]])
    if member.inertia > 0.0:
        mass[np.ix_((1, 2, 4, 5), (1, 2, 4, 5))] = per_m / 420.0 * np.array(
            [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l], [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]]
        )
    else:
        mass[np.ix_((1, 4), (1, 4))] = per_m / 6.0 * np.array([[2, 1], [1, 2]])
    return stiffness, mass


def modes(truth, highest_Hz):
    """(frequencies [Hz], motion at the nodes {node: (3 x modes)}) up to a frequency; mass normalised."""
    number = {node: i for i, node in enumerate(sorted(truth.nodes))}
    size = 3 * len(number)
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    for member in truth.members:
        start, end = (np.array(truth.nodes[n]) for n in member.ends)
        length = np.linalg.norm(end - start)
        c, s = (end - start) / length
        turn = np.kron(np.eye(2), np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))
        at = np.concatenate([3 * number[n] + np.arange(3) for n in member.ends])
        k, m = member_matrices(length, member)
        stiffness[np.ix_(at, at)] += turn.T @ k @ turn
        mass[np.ix_(at, at)] += turn.T @ m @ turn
    for _, node, direction, value in truth.plan.springs:
        at = 3 * number[node] + "xzr".index(direction)
        stiffness[at, at] += value
    for _, node, kg in truth.plan.masses:
        for k in (0, 1):
            mass[3 * number[node] + k, 3 * number[node] + k] += kg
    held = [3 * number[node] + "xzr".index(d) for node, directions in truth.plan.held.items() for d in directions]
    free = np.setdiff1d(np.arange(size), held)
    free = free[np.diag(stiffness)[free] > 0.0]
    k, m = stiffness[np.ix_(free, free)], mass[np.ix_(free, free)]
    light = np.diag(m) <= 0.0  # rotations of nodes that only stays meet
    if light.any():
        k = k[np.ix_(~light, ~light)] - k[np.ix_(~light, light)] @ np.linalg.solve(k[np.ix_(light, light)], k[np.ix_(light, ~light)])
        m, free = m[np.ix_(~light, ~light)], free[~light]
    squares, shapes = eigh(k, m)
    keep = squares < (2.0 * np.pi * highest_Hz) ** 2
    whole = np.zeros((size, keep.sum()))
    whole[free] = shapes[:, keep]
    return np.sqrt(squares[keep]) / (2.0 * np.pi), {node: whole[3 * i : 3 * i + 3] for node, i in number.items()}
