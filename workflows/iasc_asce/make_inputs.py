"""Writes the engineer's model of the frame: floors that are rigid in every way, 12 degrees of freedom, symmetric masses.

    python3 make_inputs.py "" OUT

It is the undamaged frame of case 1 in every run: exact in cases 1 and 3, without the heavy slab in case 4, wrong in form in case 2 (nodes of the frame
turn), in both in case 5. The first argument, the folder of outside data, is not used.

Groups are what an engineer would name: columns_1 … columns_4, and the two braces of each face of each storey, braces_1_x0 … braces_4_y2 (x0: the
face x = 0, whose braces work along y).

Parameters and their bounds, stated before any record: the steel of columns 0.8 to 1.1 (a column that is not fully clamped is softer, never much stiffer),
of braces 0.9 to 1.1 (bolted ends), the mass of slabs 0.9 to 1.1 (weighed in place with what is fixed to them).
"""
import pathlib
import sys

import frame

PARAMETERS = (
    ("E_columns", "youngs_modulus", "column_steel", "Pa", frame.YOUNG_PA, 0.8, 1.1),
    ("E_braces", "youngs_modulus", "brace_steel", "Pa", frame.YOUNG_PA, 0.9, 1.1),
    ("m_slabs", "point_mass", "slabs", "-", 1.0, 0.9, 1.1),
)
CORNERS = ((0, 0), (1, 0), (0, 1), (1, 1))


def element_rows():
    """Columns (local z along x: bending along x is the strong one) and braces."""
    rows = []
    for storey in range(1, frame.FLOORS + 1):
        rows += [(f"columns_{storey}", "beam,{},column_steel,column", ends) for ends in frame.columns(storey)]
        for face in frame.ALL_FACES:
            rows += [(f"braces_{storey}_{face}", "bar,{},brace_steel,brace", frame.brace_ends(storey, face, which)) for which in (0, 1)]
    return [
        f"{number},{kind.format(group)},{ends[0] + 1},{ends[1] + 1},1,0,0" for number, (group, kind, ends) in enumerate(rows, 1)
    ]


def write(folder, name, header, rows):
    (folder / name).write_text(header + "\n" + "\n".join(rows) + "\n", encoding="utf-8")


def write_model(folder):
    folder.mkdir(parents=True, exist_ok=True)
    text = 'title = "Four-storey steel frame, floors rigid"\n\n[formulation]\nlumped_mass = true\n'
    for name, target, of, unit, initial, lower, upper in PARAMETERS:
        text += (
            f'\n[[parameter]]\nname = "{name}"\ntarget = "{target}"\nof = ["{of}"]\nunit = "{unit}"\n'
            f"initial = {initial:.12g}\nlower = {lower * initial:.12g}\nupper = {upper * initial:.12g}\n"
        )
    (folder / "model.toml").write_text(text, encoding="utf-8")
    count = 9 * (frame.FLOORS + 1)
    nodes = [tuple(frame.position(i)) for i in range(count)]
    slabs = [((i + 0.5) * frame.BAY_M, (j + 0.5) * frame.BAY_M, floor * frame.STOREY_M) for floor in range(1, frame.FLOORS + 1) for i, j in CORNERS]
    write(folder, "nodes.csv", "node,x_m,y_m,z_m", ["{},{:.12g},{:.12g},{:.12g}".format(i, *at) for i, at in enumerate(nodes + slabs, 1)])
    write(folder, "elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z", element_rows())
    steel = f"{frame.YOUNG_PA:.12g},{frame.POISSON},{frame.DENSITY_KG_M3}"
    write(folder, "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [f"{kind}_steel,{steel}" for kind in ("column", "brace")])
    area, strong, weak, torsion = frame.COLUMN
    write(
        folder, "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4",
        [f"column,{area:g},{strong:g},{weak:g},{torsion:g}", f"brace,{frame.BRACE[0]:g},0,0,0"],
    )
    centres = [frame.node(floor, 1, 1) + 1 for floor in range(1, frame.FLOORS + 1)]
    write(
        folder, "supports.csv", "support,node,x,y,z,rx,ry,rz",
        [f"foot_{i},{i},1,1,1,1,1,1" for i in range(1, 10)] + [f"level_{i},{node},0,0,1,1,1,0" for i, node in enumerate(centres, 1)],
    )
    links, masses = [], []
    for floor, centre in enumerate(centres, 1):
        own = [i + 1 for i in range(9 * floor, 9 * floor + 9)]
        plates = [count + 4 * (floor - 1) + i for i in range(1, 5)]
        links += [f"floor_{floor}_{i},{centre},{i}" for i in own + plates if i != centre]
        masses += [f"slabs,{i},{frame.SLABS_KG[floor - 1]:g},{frame.SLABS_KG[floor - 1] * frame.BAY_M**2 / 6.0:.12g}" for i in plates]
        half = 0.5 * frame.BEAM[0] * frame.BAY_M * frame.DENSITY_KG_M3
        masses += [f"beams,{i},{half * sum(i - 1 in ends for ends in frame.beams(floor)):.12g},0" for i in own]
    write(folder, "links.csv", "link,master,slave", links)
    write(folder, "masses.csv", "group,node,mass_kg,inertia_z_kg_m2", masses)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit('iasc_asce: usage: make_inputs.py "" OUT')
    write_model(pathlib.Path(sys.argv[2]) / "model")
