"""A girder of three spans with one soft pier, and a logger's record of it with one accelerometer mounted upside down.

The girder itself is a beam of 140 elements in NumPy (vertical motion, cubic shape functions, consistent mass; with shear where asked
for). The model that its owner has is a folder of 28 beams with both piers as drawn, symmetric about the middle. Nothing here comes from
the programs under test.
"""
import csv

import numpy as np

SPANS = (20.0, 30.0, 20.0)          # m
LENGTH = sum(SPANS)
PIERS = {"W": 20.0, "E": 50.0}      # m
E, G, AREA, INERTIA, DENSITY = 34e9, 14e9, 2.4, 0.42, 2500.0
SHEAR_AREA = 0.4 * AREA
PIER = 2e8                          # N/m, a pier with its bearing
SENSORS = {"A1": 5.0, "A2": 10.0, "A3": 15.0, "A4": 27.5, "A5": 35.0, "A6": 42.5, "A7": 55.0, "A8": 60.0, "A9": 65.0}
DAMPING = 0.01
RATE, SECONDS = 64.0, 1200.0        # Hz, s
HIGHEST = 30.0                      # Hz, of the modes that the record holds


def modes(softer=None, shear=False, n=140):
    """Frequencies in Hz and mass-normalised deflections at the nodes, of modes up to HIGHEST. softer: {"W": 0.6}, factors of the piers."""
    h = LENGTH / n
    ei, mu = E * INERTIA, DENSITY * AREA
    phi = 12 * ei / (G * SHEAR_AREA * h * h) if shear else 0.0
    ke = ei / (h**3 * (1 + phi)) * np.array([[12, 6 * h, -12, 6 * h], [6 * h, (4 + phi) * h * h, -6 * h, (2 - phi) * h * h],
                                             [-12, -6 * h, 12, -6 * h], [6 * h, (2 - phi) * h * h, -6 * h, (4 + phi) * h * h]])
    me = mu * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                  [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    k, m = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for i in range(n):
        k[2 * i:2 * i + 4, 2 * i:2 * i + 4] += ke
        m[2 * i:2 * i + 4, 2 * i:2 * i + 4] += me
    for name, x in PIERS.items():
        at = 2 * round(x / h)
        k[at, at] += PIER * (softer or {}).get(name, 1.0)
    free = [d for d in range(2 * n + 2) if d not in (0, 2 * n)]  # abutments hold the ends
    factor = np.linalg.inv(np.linalg.cholesky(m[np.ix_(free, free)]))
    values, vectors = np.linalg.eigh(factor @ k[np.ix_(free, free)] @ factor.T)
    frequency = np.sqrt(values) / (2 * np.pi)
    kept = frequency < HIGHEST
    shapes = np.zeros((2 * n + 2, int(kept.sum())))
    shapes[free] = factor.T @ vectors[:, kept]
    return frequency[kept], shapes[0::2]


def record(seed, softer=None, shear=False, reversed_channels=()):
    """Accelerations (n_samples x n_sensors) in m/s2 under wind and traffic that push at eleven places at random; 1 % noise of each channel."""
    random = np.random.default_rng(seed)
    frequency, shapes = modes(softer, shear)
    nodes = len(shapes)
    node_of = lambda x: round(x / LENGTH * (nodes - 1))  # noqa: E731
    samples = int(RATE * SECONDS)
    s = 2j * np.pi * np.fft.rfftfreq(samples, 1 / RATE)
    pushed = [node_of(x) for x in np.linspace(3.0, LENGTH - 3.0, 11)]
    forces = np.fft.rfft(random.normal(size=(len(pushed), samples)) * 2000.0)
    sensors = [node_of(x) for x in SENSORS.values()]
    spectrum = np.zeros((len(sensors), len(s)), dtype=complex)
    for f, shape in zip(frequency, shapes.T):
        omega = 2 * np.pi * f
        spectrum += np.outer(shape[sensors], shape[pushed] @ forces * s**2 / (omega**2 + 2 * DAMPING * omega * s + s**2))
    response = np.fft.irfft(spectrum, samples)
    response += 0.01 * response.std(axis=1, keepdims=True) * random.normal(size=response.shape)
    for i, name in enumerate(SENSORS):
        if name in reversed_channels:
            response[i] *= -1.0
    return response.T


def table(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])


def write_campaign(folder, seed, **truth):
    """What the logger left, and the three small files that its owner writes about it."""
    (folder / "records").mkdir(parents=True)
    response = record(seed, **truth)
    with open(folder / "records" / "traffic.csv", "w", encoding="utf-8") as stream:
        stream.write("time_s," + ",".join(SENSORS) + "\n")
        for i, row in enumerate(response):
            stream.write(f"{i / RATE:.6f}," + ",".join(f"{v:.5e}" for v in row) + "\n")
    table(folder / "channels.csv", "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role",
          [[name, name, x, 0, 0, 0, 0, 1, "acceleration", "m/s2", 1, 1, "response"] for name, x in SENSORS.items()])
    names = ", ".join(f'"{name}"' for name in SENSORS)
    (folder / "campaign.toml").write_text('[[record]]\nsetup = "S1"\nkind = "ambient"\nfile = "records/traffic.csv"\n'
                                          f'sampling_rate_Hz = {RATE}\nchannels = [{names}]\ncondition = "as_found"\n')
    (folder / "conditions.toml").write_text("[as_found]\ntemperature_C = 14.0\n")


def write_model(folder, bounds=(0.75, 1.3), shared_name=False, beams=28):
    """The owner's model: 28 beams (a multiple of 7), both piers alike. bounds: of the piers' factors; None: the piers are no parameters.
    shared_name: the piers' rows in supports.csv bear the names of their springs."""
    folder.mkdir(parents=True)
    at = np.linspace(0.0, LENGTH, beams + 1)
    table(folder / "nodes.csv", "node,x_m,y_m,z_m", [[i + 1, x, 0, 0] for i, x in enumerate(at)])
    table(folder / "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [["concrete", E, 0.2, DENSITY]])
    table(folder / "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4", [["girder", AREA, INERTIA, 2.0, 0.3]])

    def span(x):
        return "span_W" if x < PIERS["W"] else "span_main" if x < PIERS["E"] else "span_E"

    table(folder / "elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z",
          [[i + 1, "beam", span(0.5 * (a + b)), "concrete", "girder", i + 1, i + 2, 0, 0, 1] for i, (a, b) in enumerate(zip(at, at[1:]))])
    pier_at = {round(x / LENGTH * beams): f"pier_{name}" for name, x in PIERS.items()}
    held = {0: "abutment_W", beams: "abutment_E"} | (pier_at if shared_name else {})
    table(folder / "supports.csv", "support,node,x,y,z,rx,ry,rz",
          [[held.get(i, "plane"), i + 1, 1, 1, int(i in (0, beams)), 1, 0, 1] for i in range(beams + 1)])
    table(folder / "springs.csv", "spring,group,node,direction_x,direction_y,direction_z,quantity,stiffness_N_m",
          [[name, name, i + 1, 0, 0, 1, "translation", PIER] for i, name in pier_at.items()])
    parameters = [("E_concrete", "youngs_modulus", "concrete", "Pa", E, 0.9 * E, 1.1 * E)]
    if bounds:
        parameters += [(f"k_{name}", "spring_stiffness", name, "-", 1.0, *bounds) for name in pier_at.values()]
    (folder / "model.toml").write_text('title = "girder of three spans"\n' + "".join(
        f'[[parameter]]\nname = "{name}"\ntarget = "{target}"\nof = ["{of}"]\nunit = "{unit}"\ninitial = {initial}\n'
        f"lower = {lower}\nupper = {upper}\n" for name, target, of, unit, initial, lower, upper in parameters))
