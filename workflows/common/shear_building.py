"""A building that bends in shear alone, as a matrix model: one mass a floor, one stiffness a storey, each storey a parameter."""


def write_lower_triangle(path, size, entries):
    """Writes a symmetric matrix. @param entries  (row, column) from 1, column <= row -> value"""
    path.write_text(
        f"%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {len(entries)}\n"
        + "".join(f"{i} {j} {value:.17g}\n" for (i, j), value in sorted(entries.items()))
    )


def parameter_table(name, initial, lower, upper):
    """The table of model.toml for the stiffness in K_<name>.mtx."""
    return (
        f'\n[[parameter]]\nname = "{name}"\nmatrix = "K_{name}.mtx"\ntarget = "stiffness"\ninitial = {initial}\n'
        f"lower = {lower}\nupper = {upper}\n"
    )


def write_shear_building(folder, title, floor_kg, storey_N_m, lower, upper):
    """K = sum theta_i K_i over the storeys from below, each theta 1 as given, within [lower, upper]. Drawn with storeys of 1 m, which
    nothing but the drawing uses."""
    folder.mkdir(parents=True, exist_ok=True)
    size = len(floor_kg)
    digits = len(str(size))
    text = f'title = "{title}"\n[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'
    write_lower_triangle(folder / "K0.mtx", size, {})
    write_lower_triangle(folder / "M0.mtx", size, {(i, i): mass for i, mass in enumerate(floor_kg, 1)})
    for i, stiffness in enumerate(storey_N_m, 1):
        entries = {(i, i): stiffness}
        if i > 1:
            entries |= {(i - 1, i - 1): stiffness, (i, i - 1): -stiffness}
        name = f"storey{i:0{digits}d}"
        write_lower_triangle(folder / f"K_{name}.mtx", size, entries)
        text += parameter_table(name, 1.0, lower, upper)
    (folder / "dofs.csv").write_text(
        "dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i},floor{i:0{digits}d},x,0,0,{i}\n" for i in range(1, size + 1))
    )
    (folder / "model.toml").write_text(text)
