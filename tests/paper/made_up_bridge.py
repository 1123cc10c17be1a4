"""Chords and dampers of a made-up pair of curved decks: arcs about one centre, forces that are constant along each chord."""
import numpy as np

RADII = {"foot": 80.0, "cycle": 100.0}
FORCES = {("foot", "bottom"): -1.0e6, ("foot", "top"): 4.0e5, ("cycle", "bottom"): 1.2e6, ("cycle", "top"): -3.0e5}
PIECES = 20
REACH = 0.7  # [rad] on either side of the middle


def write_members(write_rows, folder):
    """Top chords at R - 2 m and R + 2 m, 10 m up; the bottom chord at R, 1.5 m below."""
    rows = []
    for (deck, level), force in FORCES.items():
        for radius in ((RADII[deck],) if level == "bottom" else (RADII[deck] - 2.0, RADII[deck] + 2.0)):
            for angle in (np.arange(PIECES) + 0.5) / PIECES * 2 * REACH - REACH:
                rows.append([len(rows) + 1, f"{deck}_{level}_chord", radius * np.sin(angle), radius * np.cos(angle) - 60.0,
                             8.5 if level == "bottom" else 10.0, 2 * REACH * radius / PIECES, force])
    write_rows(folder / "member_forces.csv", ["element", "group", "x_m", "y_m", "z_m", "length_m", "axial_force_N"], rows)


def write_dampers(write_rows, folder, names):
    """At nodes of the strip, the A ones across it and the others upright."""
    write_rows(folder / "springs.csv", ["spring", "group", "node", "direction_x", "direction_y", "direction_z"],
               [[name, f"damper_{name[0]}", 3 + 4 * i, 0, int(name[0] == "A"), int(name[0] != "A")] for i, name in enumerate(names)]
               + [["bearing", "support", 1, 0, 0, 1]])
