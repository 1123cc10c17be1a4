"""Models of OpenSeesPy, and matrices saved as .npz, as matrix models that every step reads (docs/my_model.md, section 3).

OpenSeesPy does not say sections and materials of its elements again, so what is taken of a live model is its stiffness and mass over the free degrees of
freedom, at the state that it is in: after a gravity analysis they are those of the loaded structure.
"""
import zipfile
from pathlib import Path

import numpy as np

from .errors import InputError
from .writing import toml_text, write_files

_LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
_POUND = 4.4482216152605
_FORCES = {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": _POUND, "kip": 1e3 * _POUND, "kgf": 9.80665}

# Directions of a node's degrees of freedom by the dimension of space and their number.
_DIRECTIONS = {(3, 6): "x y z rx ry rz", (3, 3): "x y z", (2, 3): "x y rz", (2, 2): "x y", (1, 1): "x"}
_ALL_DIRECTIONS = "x y z rx ry rz".split()

_ASYMMETRY = 1e-8  # [-] of the largest entry: rounding of a symmetric matrix that was summed element by element


def write_openseespy(folder, ops, *, length: str, force: str, title: str = "from OpenSeesPy") -> Path:
    """Writes a live OpenSeesPy model as a matrix model.

    Parameters
    ----------
    folder : path
        Where `model.toml`, `dofs.csv`, `K.mtx` and `M.mtx` are written.
    ops : module
        `openseespy.opensees`, with the model built. Its analysis is wiped; nodes, elements and their state stay.
    length, force : str
        Units of the model: m, cm, mm, in, ft and N, kN, MN, lbf, kip, kgf. The mass belongs to them (force · s² / length): a weight has to be
        divided by g before.

    Raises
    ------
    InputError
        For a unit that is not known, nodes whose degrees of freedom have no name here, a matrix that is not symmetric, or a model without mass.
    """
    scale_m, scale_n = _factor(_LENGTHS, length, "length"), _factor(_FORCES, force, "force")
    stiffness, mass = _matrix_of(ops, 0.0, 0.0, 1.0), _matrix_of(ops, 1.0, 0.0, 0.0)
    names = _names_of_equations(ops, len(stiffness))
    ops.wipeAnalysis()
    return _write(folder, names, stiffness, mass, scale_m, scale_n, title)


def write_npz(folder, file, *, length: str, force: str, title: str = "") -> Path:
    """Writes matrices that were saved by `numpy.savez` as a matrix model.

    The file holds `K` and `M` (n × n), `nodes` (one row a node: number, x, y, z) and `dofs` (one row an equation: number of the node, direction 1 to 6 for
    x y z rx ry rz), in the order of the matrices.
    """
    scale_m, scale_n = _factor(_LENGTHS, length, "length"), _factor(_FORCES, force, "force")
    try:
        with np.load(file, allow_pickle=False) as arrays:
            held = {name: arrays[name] for name in arrays.files}
    except (OSError, ValueError, zipfile.BadZipFile) as error:
        raise InputError(f"{file}: is no .npz file of plain arrays ({error}); save it by numpy.savez") from error
    for name in ("K", "M", "nodes", "dofs"):
        if name not in held:
            raise InputError(f"{file}: has no array '{name}'; it holds {', '.join(held) or 'nothing'}; save K, M, nodes and dofs")
    nodes = np.atleast_2d(held["nodes"])
    if nodes.shape[1] != 4:
        raise InputError(f"{file}: nodes has {nodes.shape[1]} columns, expected number, x, y, z")
    places = {int(row[0]): tuple(float(v) for v in row[1:]) for row in nodes}
    names = []
    for node, direction in np.atleast_2d(held["dofs"]):
        if int(node) not in places or not 1 <= int(direction) <= 6:
            raise InputError(f"{file}: dofs names node {int(node)}, direction {int(direction)}; expected a node of `nodes` and a direction from 1 to 6")
        names.append((int(node), _ALL_DIRECTIONS[int(direction) - 1], places[int(node)]))
    return _write(folder, names, _square(held["K"], "K", len(names)), _square(held["M"], "M", len(names)), scale_m, scale_n, title or Path(file).stem)


def _factor(table: dict, unit: str, what: str) -> float:
    if unit not in table:
        raise InputError(f"{what}: '{unit}' is no unit that is known; give one of {', '.join(table)}")
    return table[unit]


def _matrix_of(ops, mass: float, damping: float, stiffness: float) -> np.ndarray:
    """The matrix that OpenSees forms with these factors of M, C and K."""
    ops.wipeAnalysis()
    ops.system("FullGeneral")
    ops.numberer("Plain")
    ops.constraints("Transformation")
    ops.algorithm("Linear")
    ops.integrator("GimmeMCK", mass, damping, stiffness)
    ops.analysis("Transient")
    ops.analyze(1, 0.0)
    size = int(ops.systemSize())
    return _square(np.array(ops.printA("-ret"), dtype=float).reshape(size, size), "the matrix of OpenSees", size)


def _square(matrix, name: str, size: int) -> np.ndarray:
    matrix = np.asarray(matrix, dtype=float)
    if matrix.shape != (size, size):
        raise InputError(f"{name} has the shape {matrix.shape}, expected {size} rows and columns, one a degree of freedom")
    if not np.all(np.isfinite(matrix)):
        raise InputError(f"{name} holds values that are no numbers")
    if np.abs(matrix - matrix.T).max(initial=0.0) > _ASYMMETRY * max(np.abs(matrix).max(initial=0.0), 1e-300):
        raise InputError(f"{name} is not symmetric; modes of follower loads and unsymmetric materials are not computed")
    return 0.5 * (matrix + matrix.T)


def _names_of_equations(ops, size: int) -> list:
    """Node, direction and place of each equation, in the order of the matrices."""
    dimension = int(ops.getNDM()[0] if isinstance(ops.getNDM(), (list, tuple)) else ops.getNDM())
    names = [None] * size
    for node in ops.getNodeTags():
        equations = [int(e) for e in ops.nodeDOFs(node)]
        words = _DIRECTIONS.get((dimension, len(equations)))
        if words is None:
            raise InputError(f"node {node} has {len(equations)} degrees of freedom in {dimension} dimensions; expected one of "
                             + ", ".join(f"{n} in {d}" for d, n in _DIRECTIONS))
        place = tuple(float(v) for v in ops.nodeCoord(node))
        place += (0.0,) * (3 - len(place))
        for direction, equation in zip(words.split(), equations):
            if 0 <= equation < size and names[equation] is None:  # fixed and dependent ones have numbers below 0
                names[equation] = (int(node), direction, place)
    if None in names:
        raise InputError(f"equation {names.index(None)} belongs to no node; take out Lagrange multipliers (constraints('Transformation') is used here)")
    return names


def _write(folder, names: list, stiffness: np.ndarray, mass: np.ndarray, scale_m: float, scale_n: float, title: str) -> Path:
    turns = np.array([direction.startswith("r") for _, direction, _ in names])
    # A displacement d of the deck is d · scale_m; an angle stays. K: force per displacement, M: force · s² per displacement.
    per_unit = np.where(turns, 1.0, scale_m)
    work = scale_n * scale_m
    k, m = (work * matrix / np.outer(per_unit, per_unit) for matrix in (stiffness, mass))
    if not np.trace(m) > 0.0:
        raise InputError("the model has no mass; give nodes or elements their mass before its modes are asked for")
    rows = [f"{i + 1},{node},{direction}," + ",".join(f"{v * scale_m:.12g}" for v in place) for i, (node, direction, place) in enumerate(names)]
    folder = Path(folder)
    write_files(folder, {"dofs.csv": "\n".join(["dof,node,direction,x_m,y_m,z_m", *rows]) + "\n", "K.mtx": _market(k), "M.mtx": _market(m),
                         "model.toml": toml_text({"title": title, "matrices": {"K": "K.mtx", "M": "M.mtx"}})})
    return folder


def _market(matrix: np.ndarray) -> str:
    """Lower triangle as Matrix Market."""
    rows, columns = np.nonzero(np.tril(matrix))
    lines = [f"{i + 1} {j + 1} {matrix[i, j]:.17g}" for i, j in zip(rows, columns)]
    return "\n".join(["%%MatrixMarket matrix coordinate real symmetric", f"{len(matrix)} {len(matrix)} {len(lines)}", *lines]) + "\n"
