"""What the steps of a campaign leave behind, made up: sensors (Table 3) and identified modes and stays (Tables 4 and 5). Invented
numbers that lie close to the invented paper's."""
import numpy as np

SETUPS = (("String 1", "ST1"), ("String 2", "ST2"), ("Carpet 1", "CP1"), ("Carpet 2", "CP2"), ("Dec 1", "DC1"), ("Dec 2", "DC2"))
STAYS = (("NE8", 80.0, 0.8), ("NE7", 70.0, 1.0), ("NE5", 55.0, 1.6))
CASES = {"without_sleeves": 1.0, "with_sleeves": 1.1}  # sleeves raise frequencies and damping by a tenth
DAMPING = (0.2, 0.5, 1.4)
CHANNELS = [(f"P{i}", 5.0 * i, 3.0 * (i % 2)) for i in range(4, 12)]


def write_paper(write_rows, folder):
    write_rows(folder / "table_03.csv", ["setup", "abbreviation", "R_k"], [[n, a, f"{0.1 + 0.01 * i:.4f}"] for i, (n, a) in enumerate(SETUPS)])
    write_rows(folder / "table_05.csv", ["case", "cable", "L_m", *(f"f{n}_Hz" for n in range(1, 6)), "damping_ratio_pct"],
               [[case, stay, f"{length:.2f}", *(f"{n * f * up:.2f}" for n in range(1, 6)), f"{zeta * up:.2f}"]
                for case, up in CASES.items() for (stay, length, f), zeta in zip(STAYS, DAMPING)])


def write_sensors(write_rows, folder):
    write_rows(folder / "setups.csv", ["setup", "family", "channels", "R_k", "rank"], [[a, "made up", 8, 0.05 * (i + 1), i + 1] for i, (_, a) in enumerate(SETUPS)])
    write_rows(folder / "layout.csv", ["setup", "channel", "point", "direction", "x_m", "y_m", "z_m", "dx", "dy", "dz"],
               [[setup, f"{point}z", point, "vertical", x, y, 10.0, 0, 0, 1] for setup in ("M", "ST1", "DC1") for point, x, y in CHANNELS])
    frequencies = [0.8, 1.5, 1.55]
    write_rows(folder / "blind_test.csv", ["setup", "mode", "frequency_Hz", "found", "identified_frequency_Hz"], [[s, i + 1, f, 1, f] for s in ("ST1", "DC1") for i, f in enumerate(frequencies)])
    write_rows(folder / "blind_psd.csv", ["setup", "channel", "frequency_Hz", "psd_m2_s3"],
               [[s, f"{p}z", f, 1e-4 / (1e-3 + (f - 1.5) ** 2)] for s in ("ST1", "DC1") for p, *_ in CHANNELS for f in np.linspace(0.1, 3.0, 30)])
    write_rows(folder / "blind_poles.csv",
               ["setup", "frame", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "cluster"],
               [["ST1", frame, order, f + 0.001 * frame, 1.0, 1, int(order > 10), int(order > 10), i + 1 if order > 10 else ""]
                for frame in (1, 2) for order in (10, 12, 14) for i, f in enumerate(frequencies)])


def write_identification(write_rows, read_rows, paper, folder):
    """Frequencies 0.1 % above the printed, damping 5 %; with dampers 0.2 % and 10 %; shapes half waves, the same in both."""
    for condition, words, up, more in (("without_dampers", "without", 1.001, 1.05), ("with_dampers", "with", 1.002, 1.1)):
        at = folder if words == "without" else folder / "conditions" / condition
        printed = read_rows(paper / "table_04.csv")
        modes = [[float(r[f"f_X_{words}_dampers_Hz"]) * up, float(r[f"zeta_{words}_dampers_pct"]) * more] for r in printed]
        write_rows(at / "modes.csv", ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"],
                   [[i + 1, repr(f), 0.002, repr(z), 0.1] for i, (f, z) in enumerate(modes)])
        write_rows(at / "shapes.csv", ["mode", "point", "direction", "value", "value_imag"],
                   [[m, p, f"{p}z", np.cos(m * i * np.pi / 8 + 0.3), 0.01] for m in range(1, len(modes) + 1) for i, (p, *_) in enumerate(CHANNELS)])
        write_rows(at / "poles.csv",
                   ["setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "mode", "condition"],
                   [["ST1", order, f, z, 1, 1, int(order > 20), i + 1 if order > 20 else "", condition]
                    for order in (20, 22, 24) for i, (f, z) in enumerate(modes)])
        write_rows(at / "psd.csv", ["channel", "frequency_Hz", "psd_m2_s3", "setup", "condition"],
                   [[f"{p}z", f, 1e-6 / (1e-3 + (f - 1.5) ** 2), "ST1", condition] for p, *_ in CHANNELS for f in np.linspace(0.1, 3.0, 30)])
    write_rows(folder / "amplitude.csv", ["source", "condition", "mode", "amplitude"],
               [["ambient", "with_dampers", i + 1, 0.01] for i in range(len(read_rows(paper / "table_04.csv")))])
    write_rows(folder / "features/channels.csv", ["channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz"],
               [[f"{p}z", p, x, y, 10.0, 0, 0, 1] for p, x, y in CHANNELS])
    write_rows(folder / "stays.csv", ["stay", "condition", "harmonic", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"],
               [[stay, case, n, repr(1.001 * n * f * up), 0.001, 1.04 * zeta * up, 0.05]
                for case, up in CASES.items() for (stay, _, f), zeta in zip(STAYS, DAMPING) for n in range(1, 6)])
    write_rows(folder / "stay_tensions.csv", ["stay", "condition", "length_m"], [[stay, case, length] for case in CASES for stay, length, _ in STAYS])
