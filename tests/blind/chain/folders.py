"""Writes what an engineer has of a trial: the model's folder, and the records of two setups as a logger gives them."""
import numpy as np
from scipy.signal import cont2discrete, lfilter

import hidden
import plane

NOISE = 0.03          # of the median channel's RMS
DAMPING = (0.006, 0.015)
PERIODS, SHORTEST_S, LONGEST_S = 1500, 300.0, 900.0
OVERSAMPLING = 4.0    # rate over the highest frequency of interest, what a logger is set to
REFERENCES = 3
PUSHES = 8            # independent white forces at nodes that are drawn


def table(folder, name, header, rows):
    (folder / name).write_text(header + "\n" + "".join(row + "\n" for row in rows), encoding="utf-8")


def write_model(folder, plan):
    """The plan as a model folder in the x-z plane. Parameters: moduli within 15 %, bearings and feet within a factor of two, masses within 10 %."""
    folder.mkdir(parents=True, exist_ok=True)
    materials = {}
    for member in plan.members:
        materials.setdefault((member.young, member.density), f"material_{len(materials) + 1}")
    text = f'title = "{plan.name}"\n\n[formulation]\nlumped_mass = {"true" if plan.name == "truss" else "false"}\n'

    def parameter(name, target, of, unit, initial, spread):
        listed = ", ".join(f'"{part}"' for part in of)
        return (
            f'\n[[parameter]]\nname = "{name}"\ntarget = "{target}"\nof = [{listed}]\nunit = "{unit}"\ninitial = {initial:.12g}\n'
            f"lower = {initial * spread[0]:.12g}\nupper = {initial * spread[1]:.12g}\n"
        )

    for (young, _), name in materials.items():
        text += parameter(f"E_{name}", "youngs_modulus", [name], "Pa", young, (0.85, 1.15))
    text += parameter("k_supports", "spring_stiffness", [name for name, *_ in plan.springs], "-", 1.0, (0.5, 2.0))
    groups = sorted({group for group, *_ in plan.masses})
    if groups:
        text += parameter("m_added", "point_mass", groups, "-", 1.0, (0.9, 1.1))
    (folder / "model.toml").write_text(text, encoding="utf-8")
    table(folder, "nodes.csv", "node,x_m,y_m,z_m", [f"{n},{x:.12g},0,{z:.12g}" for n, (x, z) in plan.nodes.items()])
    rows, sections = [], {}
    for number, m in enumerate(plan.members, 1):
        upright = plan.nodes[m.ends[0]][0] == plan.nodes[m.ends[1]][0]
        section = sections.setdefault((m.area, m.inertia), f"section_{len(sections) + 1}")
        rows.append(f"{number},{'beam' if m.inertia else 'bar'},{m.group},{materials[m.young, m.density]},{section},{m.ends[0]},{m.ends[1]},{'1,0,0' if upright else '0,0,1'}")
    table(folder, "elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z", rows)
    table(folder, "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [f"{n},{e:g},0.3,{d:g}" for (e, d), n in materials.items()])
    table(
        folder, "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4",
        [f"{n},{a:g},{i:g},{i:g},{i:g}" for (a, i), n in sections.items()],
    )
    bent = {end for m in plan.members if m.inertia for end in m.ends}
    table(
        folder, "supports.csv", "support,node,x,y,z,rx,ry,rz",
        [f"s{n},{n},{int('x' in h)},1,{int('z' in h)},1,{int('r' in h or n not in bent)},1" for n in plan.nodes for h in [plan.held.get(n, "")]],
    )
    axes = {"x": "1,0,0,translation", "z": "0,0,1,translation", "r": "0,1,0,rotation"}
    table(folder, "springs.csv", "spring,group,node,direction_x,direction_y,direction_z,quantity,stiffness_N_m", [f"{s},{s},{n},{axes[d]},{k:g}" for s, n, d, k in plan.springs])
    if plan.masses:
        table(folder, "masses.csv", "group,node,mass_kg", [f"{g},{n},{kg:.12g}" for g, n, kg in plan.masses])


def setups(plan):
    """Two lists of sensors that share three: the first, the middle and the last."""
    count = len(plan.sensors)
    shared = [0, count // 2, count - 1]
    rest = [i for i in range(count) if i not in shared]
    return [shared + rest[k::2] for k in (0, 1)], shared


def motion(trial, structure, seconds, rate, random):
    """(samples x sensors) [m/s^2]"""
    frequencies, shapes = plane.modes(structure, 2.0 * trial.highest_Hz)
    loose = sorted(set(trial.plan.nodes) - set(trial.plan.held))
    nodes = random.choice(loose, min(PUSHES, len(loose)), replace=False)
    push = np.concatenate([shapes[n][:2] for n in nodes])  # both directions of each
    at = hidden.at_sensors(trial.plan, shapes)
    settle = int(10.0 / (0.01 * 2.0 * np.pi * frequencies[0]) * rate)
    forces = 1000.0 * random.standard_normal((int(seconds * rate) + settle, len(push)))
    out = np.zeros((len(forces), len(at)))
    damping = trial_damping(trial, len(frequencies))
    for f, zeta, shape, place in zip(frequencies, damping, push.T, at.T):
        omega = 2.0 * np.pi * f
        top, bottom, _ = cont2discrete(([1.0, 0.0, 0.0], [1.0, 2.0 * zeta * omega, omega**2]), 1.0 / rate, method="foh")
        out += np.outer(lfilter(top.ravel(), bottom, forces @ shape), place)
    out = out[settle:]
    return out + NOISE * np.median(np.std(out, axis=0)) * random.standard_normal(out.shape)


def trial_damping(trial, count):
    return np.random.default_rng([52, trial.seed]).uniform(*DAMPING, count)


def faulty(trial, samples):
    """What the logger writes where a sensor is turned, misread or exchanged."""
    names = [hidden.channel(*sensor) for sensor in trial.plan.sensors]
    for cause in trial.causes:
        if cause.kind in ("polarity", "gain"):
            samples[:, names.index(cause.place)] *= cause.size
        elif cause.kind == "swap":
            one, other = (names.index(name) for name in cause.place.split(","))
            samples[:, [one, other]] = samples[:, [other, one]]
    return samples


def write_campaign(folder, trial):
    folder.mkdir(parents=True, exist_ok=True)
    plan = trial.plan
    names = [hidden.channel(*sensor) for sensor in plan.sensors]
    groups, shared = setups(plan)
    table(
        folder, "channels.csv", "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role",
        [
            f"{name},n{node},{plan.nodes[node][0]:.12g},0,{plan.nodes[node][1]:.12g},{'1,0,0' if d == 'x' else '0,0,1'},acceleration,m/s^2,1,{int(i in shared)},response"
            for i, (name, (node, d)) in enumerate(zip(names, plan.sensors))
        ],
    )
    records = conditions = ""
    random = np.random.default_rng([53, trial.seed])
    rate = float(np.ceil(OVERSAMPLING * trial.highest_Hz))
    for condition, state, temperature, acts in trial.conditions():
        conditions += f"[{condition}]\n" + (f'state = "{state}"\n' if state else "") + (f"temperature_C = {temperature}\n" if temperature is not None else "") + "\n"
        structure = trial.structure(acts, temperature)
        first = plane.modes(structure, trial.highest_Hz)[0][0]
        seconds = float(np.clip(PERIODS / first, SHORTEST_S, LONGEST_S))
        for number, which in enumerate(groups, 1):
            samples = faulty(trial, motion(trial, structure, seconds, rate, random))[:, which]
            file = f"{condition}_setup{number}.npy"
            np.save(folder / file, samples)
            listed = ", ".join(f'"{names[i]}"' for i in which)
            records += (
                f'[[record]]\nsetup = "setup{number}"\nkind = "ambient"\nfile = "{file}"\nsampling_rate_Hz = {rate:g}\n'
                f'channels = [{listed}]\ncondition = "{condition}"\n\n'
            )
    (folder / "campaign.toml").write_text(records, encoding="utf-8")
    (folder / "conditions.toml").write_text(conditions, encoding="utf-8")
