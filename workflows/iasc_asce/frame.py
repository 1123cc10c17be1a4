"""The four-storey steel frame of the IASC-ASCE benchmark, phase I: its stiffness, mass and modes, sound and damaged.

Source: Johnson, Lam, Katafygiotis, Beck, "Phase I IASC-ASCE structural health monitoring benchmark problem using simulated data", J. Eng. Mech. 130 (2004)
3-15. Sizes, cases and damage patterns are theirs; the code is written anew from them.

Two bays of 1.25 m in x and in y, four storeys of 0.9 m, nine columns clamped at the ground. Each floor is rigid in its plane: it moves by x, y and a turn about
the vertical. Where floors are wholly rigid (cases 1, 3, 4) nodes neither turn about x and y nor move vertically: 12 degrees of freedom. Otherwise (cases 2 and 5) each of the
36 nodes does so by itself: 120. Members are Euler-Bernoulli; braces carry axial force alone; member masses are lumped at their ends, and a brace
that is cut keeps its mass. Slabs have mass in the plane of their floor alone: so the published frequencies have it (with vertical mass of slabs
those of 120 degrees of freedom are up to 0.4 % lower, without it they agree within 0.03 %). Turning nodes have no mass, so that their
rotations are condensed, which is exact.

Faces are named by where they stand: x0, x2 (x = 0 and 2.5 m, braces along y), y0, y2 (braces along x). Units: SI.
"""
import dataclasses

import numpy as np
from scipy.linalg import eigh

BAY_M, STOREY_M, FLOORS = 1.25, 0.9, 4
YOUNG_PA, POISSON, DENSITY_KG_M3 = 2.0e11, 0.3, 7800.0
SHEAR_PA = YOUNG_PA / (2.0 * (1.0 + POISSON))
# area [m^2], strong and weak second moment [m^4], torsion [m^4]
COLUMN = (1.133e-3, 1.97e-6, 0.664e-6, 8.01e-9)
BEAM = (1.430e-3, 1.22e-6, 0.249e-6, 3.82e-8)
BRACE = (0.141e-3, 0.0, 0.0, 0.0)
SLABS_KG = (800.0, 600.0, 600.0, 400.0)  # each of the four slabs of a floor, from floor 1
HEAVY_SLAB_KG = 550.0                    # the roof's slab nearest x = y = 0 in cases 4 and 5
DAMPING = 0.01


@dataclasses.dataclass(frozen=True)
class Case:
    nodes_free: bool  # nodes turn and move vertically: 120 degrees of freedom
    heavy_slab: bool
    load: str         # "floors": along y at the centre of each floor; "roof": along the diagonal at the roof's centre


CASES = {
    1: Case(False, False, "floors"), 2: Case(True, False, "floors"), 3: Case(False, False, "roof"),
    4: Case(False, True, "roof"), 5: Case(True, True, "roof"),
}


@dataclasses.dataclass(frozen=True)
class Loss:
    """Braces of one storey that lose stiffness together: what an answer has to find."""
    storey: int
    faces: tuple     # faces that lose
    remaining: float  # share of the stiffness that each of `braces` keeps
    braces: tuple    # 0, 1: the braces of a face, counted from its end with the smaller coordinate


@dataclasses.dataclass(frozen=True)
class Damage:
    losses: tuple = ()
    hinged: bool = False  # the beam of floor 1 from (1.25, 0) to (1.25, 1.25) m is hinged at its first end


ALL_FACES = ("x0", "x2", "y0", "y2")
_STOREY_1 = Loss(1, ALL_FACES, 0.0, (0, 1))
_ONE_BRACE = Loss(1, ("x2",), 0.0, (0,))
_ANOTHER = Loss(3, ("y0",), 0.0, (1,))
PATTERNS = {
    0: Damage(),
    1: Damage((_STOREY_1,)),
    2: Damage((_STOREY_1, dataclasses.replace(_STOREY_1, storey=3))),
    3: Damage((_ONE_BRACE,)),
    4: Damage((_ONE_BRACE, _ANOTHER)),
    5: Damage((_ONE_BRACE, _ANOTHER), hinged=True),
    6: Damage((dataclasses.replace(_ONE_BRACE, remaining=2.0 / 3.0),)),
}


def node(floor, i, j):
    """Number of the node at x = i bays, y = j bays of a floor (0: the ground)."""
    return floor * 9 + 3 * j + i


def position(number):
    floor, rest = divmod(number, 9)
    return np.array([(rest % 3) * BAY_M, (rest // 3) * BAY_M, floor * STOREY_M])


def brace_ends(storey, face, which):
    """Nodes of a brace: from the face's corner on the floor below to its middle column on the floor above."""
    end, at = 2 * which, 0 if face[1] == "0" else 2
    below, above = (at, end), (at, 1)
    if face[0] == "y":
        below, above = below[::-1], above[::-1]
    return node(storey - 1, *below), node(storey, *above)


def columns(storey):
    return [(node(storey - 1, i, j), node(storey, i, j)) for j in range(3) for i in range(3)]


def beams(floor):
    return [(node(floor, i, j), node(floor, i + 1, j)) for j in range(3) for i in range(2)] + [
        (node(floor, i, j), node(floor, i, j + 1)) for j in range(2) for i in range(3)
    ]


def member_stiffness(length, section, hinged_first):
    """(12 x 12) in local axes: x along the member, bending in x-z by the strong moment, in x-y by the weak one."""
    area, strong, weak, torsion = section
    out = np.zeros((12, 12))
    for first, value in ((0, YOUNG_PA * area / length), (3, SHEAR_PA * torsion / length)):
        out[np.ix_((first, first + 6), (first, first + 6))] += value * np.array([[1, -1], [-1, 1]])
    for at, sign, moment in (((2, 4, 8, 10), -1.0, strong), ((1, 5, 7, 11), 1.0, weak)):
        a, b = 6.0 * length * sign, length * length
        bend = YOUNG_PA * moment / length**3 * np.array(
            [[12, a, -12, a], [a, 4 * b, -a, 2 * b], [-12, -a, 12, -a], [a, 2 * b, -a, 4 * b]]
        )
        if hinged_first and moment > 0.0:
            bend -= np.outer(bend[:, 1], bend[1]) / bend[1, 1]
        out[np.ix_(at, at)] += bend
    return out


def member_axes(start, end):
    """Rows: local x, y, z in global coordinates. Local z of beams is vertical, of columns global x (motion along x is the strong one)."""
    x = (end - start) / np.linalg.norm(end - start)
    z = np.array([0.0, 0.0, 1.0])
    if abs(x[2]) > 0.9:
        z = np.array([1.0, 0.0, 0.0])
    y = np.cross(z, x)
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def members(damage):
    """(nodes, section, share of its stiffness, hinged at its first end) of every member."""
    lost = {
        brace_ends(loss.storey, face, which): loss.remaining for loss in damage.losses for face in loss.faces for which in loss.braces
    }
    for floor in range(1, FLOORS + 1):
        yield from ((ends, COLUMN, 1.0, False) for ends in columns(floor))
        hinge = (node(1, 1, 0), node(1, 1, 1)) if damage.hinged else None
        yield from ((ends, BEAM, 1.0, ends == hinge) for ends in beams(floor))
        for face in ALL_FACES:
            for which in (0, 1):
                ends = brace_ends(floor, face, which)
                yield ends, BRACE, lost.get(ends, 1.0), False


def reduction(nodes_free):
    """(270 x degrees of freedom): what each of the six displacements of the 45 nodes is. Three columns a floor come first."""
    size = 3 * FLOORS + (27 * FLOORS if nodes_free else 0)
    out = np.zeros((6 * 9 * (FLOORS + 1), size))
    for number in range(9, 9 * (FLOORS + 1)):
        floor = number // 9 - 1
        x, y, _ = position(number) - BAY_M
        at, first = 6 * number, 3 * floor
        out[at, (first, first + 2)] = 1.0, -y
        out[at + 1, (first + 1, first + 2)] = 1.0, x
        out[at + 5, first + 2] = 1.0
        if nodes_free:
            own = 3 * FLOORS + 3 * (number - 9)
            out[(at + 2, at + 3, at + 4), (own, own + 1, own + 2)] = 1.0
    return out


def stiffness_and_mass(case, damage):
    """K and M over the degrees of freedom of `reduction`. The mass of rotations of nodes is zero."""
    size = 6 * 9 * (FLOORS + 1)
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    for (first, last), section, share, hinged in members(damage):
        start, end = position(first), position(last)
        length = np.linalg.norm(end - start)
        turn = np.kron(np.eye(4), member_axes(start, end))
        at = np.r_[6 * first : 6 * first + 6, 6 * last : 6 * last + 6]
        stiffness[np.ix_(at, at)] += share * turn.T @ member_stiffness(length, section, hinged) @ turn
        for number in (first, last):
            mass[6 * number : 6 * number + 3] += 0.5 * section[0] * length * DENSITY_KG_M3
    to = reduction(CASES[case].nodes_free)
    out = to.T @ (mass[:, None] * to)
    for floor, slab in enumerate(SLABS_KG):
        for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)):
            kg = HEAVY_SLAB_KG if CASES[case].heavy_slab and floor == FLOORS - 1 and (i, j) == (0, 0) else slab
            x, y = (i - 0.5) * BAY_M, (j - 0.5) * BAY_M
            moves = np.array([[1.0, 0.0, -y], [0.0, 1.0, x], [0.0, 0.0, BAY_M / 6.0**0.5]])  # the last: m a^2 / 6 about its own centre
            out[3 * floor : 3 * floor + 3, 3 * floor : 3 * floor + 3] += kg * moves.T @ moves
    return to.T @ stiffness @ to, out


@dataclasses.dataclass(frozen=True)
class Modes:
    frequencies_Hz: np.ndarray  # (modes)
    floors: np.ndarray          # (12 x modes): x, y and turn of each floor's centre, mass normalised


def modes(case, damage):
    """All modes with mass, by frequency."""
    stiffness, mass = stiffness_and_mass(case, damage)
    heavy = np.diag(mass) > 0.0
    light = ~heavy
    if light.any():
        follow = np.linalg.solve(stiffness[np.ix_(light, light)], stiffness[np.ix_(light, heavy)])
        stiffness = stiffness[np.ix_(heavy, heavy)] - stiffness[np.ix_(heavy, light)] @ follow
        mass = mass[np.ix_(heavy, heavy)]
    squares, shapes = eigh(stiffness, mass)
    return Modes(np.sqrt(squares) / (2.0 * np.pi), shapes[: 3 * FLOORS])


def sensors():
    """(channel, floor, node, direction as 0 for x and 1 for y) of the 16 accelerometers: the middle columns of the four faces."""
    for floor in range(1, FLOORS + 1):
        for face, place, along in (("y0", (1, 0), 0), ("y2", (1, 2), 0), ("x0", (0, 1), 1), ("x2", (2, 1), 1)):
            yield f"f{floor}_{face}", floor, node(floor, *place), along


def at_sensors(floors):
    """Motion of the sensors (16 x n) from that of the floors (12 x n)."""
    rows = []
    for _, floor, number, along in sensors():
        x, y, _ = position(number) - BAY_M
        first = 3 * (floor - 1)
        rows.append(floors[first + along] + (-y if along == 0 else x) * floors[first + 2])
    return np.array(rows)
