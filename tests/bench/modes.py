"""Benchmarks of the finite elements and the modal solver, against SciPy on the same matrices and CalculiX on the same part of the
bridge; tests/bench/run.py runs it. Each run of either side is a process of its own, so that nothing is warm that would not be.
"""
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

import peers
import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "steps"))
import exchange_models  # noqa: E402

STUDY = "workflows/ponte_del_mare"
AIMS = {"SciPy eigsh": ">= 2.5", "SLEPc, MUMPS": ">= 1.5"}


def medians(runs):
    return {name: statistics.median(run[name] for run in runs) for name in runs[0]}


def median_child(command, runs, **how):
    return [statistics.median(values) for values in zip(*(table.run_child(command, **how) for _ in range(runs)))]


def step(binaries, out, *more):
    return [binaries / "s1_model", "--out", out, "--quiet", *more]


def of_the_study(binaries, out, *more):
    return step(binaries, out, "--study", STUDY, "--set", "meshes=[]", "--threads", "2", *more)


def whole_step(binaries, runs, folder):
    part = "step 1, two threads: reading, dead load, pulls, modes, writing"
    rows = []
    for name, aim, more in (("linear dead load", "<= 5 s", []), ("large displacements", "<= 12 s", ["--set", "displacements=large"])):
        wall, cpu, memory = median_child(of_the_study(binaries, folder / "step", *more), runs, cwd=ROOT, env=dict(table.os.environ))
        rows.append(table.row(part, name + ", elapsed", wall, "s", aim=aim, beside=f"{cpu:.2f} s of processor time, {memory:.0f} MB"))
    return rows


def against(part, us, program, peer):
    apart = max(abs(us[f"frequency_{i}_Hz"] / peer[f"frequency_{i}_Hz"] - 1) for i in range(1, 16))
    return [table.row(part, "15 modes, time", us["first_solve_s"], "s", peer["modes_s"], f"{program}, same K and M", aim=AIMS[program]),
            table.row(part, "15 modes, peak memory", us["peak_MB"], "MB", peer["peak_MB"], f"{program}; both with reading the files", aim="> 1"),
            table.row(part, "largest difference of frequencies", apart, "-", beside=f"relative, against {program}", aim="<= 1e-5")]


def modes_of_the_bridge(binaries, runs, folder):
    bench = binaries / "bench_modes"
    table.run_child(of_the_study(binaries, folder / "s1_model", "--export-matrices"), cwd=ROOT)
    scripts = peers.modes(peers.FROM_MATRIX_MARKET)
    ours, theirs, bridges = [], {program: [] for program in scripts}, []
    for _ in range(runs):  # by turns, so that all meet the same neighbours on the machine
        ours.append(table.measures(bench, "matrices", folder / "s1_model"))
        for program, script in scripts.items():
            theirs[program].append(table.measures(sys.executable, "-c", script, folder / "s1_model", environment=peers.environment()))
        bridges.append(table.measures(bench, "bridge", ROOT / "data" / "ponte_del_mare" / "bridge.toml"))
    us, bridge = medians(ours), medians(bridges)
    peer_medians = {program: medians(measured) for program, measured in theirs.items()}
    machine = table.measures(bench, "machine")
    first = us["first_solve_s"]
    arithmetic = us["factor_flops"] / machine["arithmetic_flop_s"]
    # Every solve reads the factor forwards and backwards, once for the four vectors of a block.
    traffic = us["solves"] / 4 * 2 * 8 * us["factor_entries"] / machine["bandwidth_B_s"]
    part = f"modes: {bridge['degrees_of_freedom']:.0f} degrees of freedom, processor time of one thread"
    return [
        *(row for program, peer in peer_medians.items() for row in against(part, us, program, peer)),
        table.row(part, "largest residual", us["residual"], "-", ratio=""),
        table.row(part, "after a 1 % change of all parameters, from the elements on", bridge["resolve_from_parameters_s"], "s",
                  beside="ratio: over assembling, prestress and the first solve",
                  ratio=bridge["resolve_from_parameters_s"] / (first + bridge["assemble_s"])),
        table.row(part, "Jacobian, 15 frequencies", bridge["jacobian_s"], "s",
                  beside=f"by {bridge['parameters']:.0f} parameters; ratio: over the first solve", ratio=bridge["jacobian_s"] / first, aim="<= 0.25"),
        table.row(part, "the same by forward differences", bridge["jacobian_s"], "s", bridge["jacobian_by_differences_s"], "solves of ours"),
        table.row(part, "Jacobian, 15 shapes at sensors too", bridge["channel_jacobian_s"] + bridge["jacobian_s"], "s",
                  beside="16 measured directions; ratio: over the first solve",
                  ratio=(bridge["channel_jacobian_s"] + bridge["jacobian_s"]) / first, aim="<= 2"),
        table.row(part, "bound: arithmetic of a factorisation", arithmetic, "s", us["factorise_s"],
                  f"peer: measured; {us['factor_flops'] / 1e9:.2f} Gflop at {machine['arithmetic_flop_s'] / 1e9:.0f} Gflop/s (dgemm)"),
        table.row(part, "bound: memory traffic of the solves", traffic, "s", first - us["factorise_s"],
                  f"peer: the rest of a solve; {us['solves']:.0f} solves by fours, {us['factor_entries'] * 8e-6:.0f} MB at "
                  f"{machine['bandwidth_B_s'] / 1e9:.0f} GB/s"),
        table.row(part, "bound: both", arithmetic + traffic, "s", first, "peer: measured; ratio: how far from the bound"),
        table.row(part, "assemble, prestress", bridge["assemble_s"], "s", beside=f"the mesh is made before, in {bridge['generate_s']:.2f} s"),
    ]


def against_calculix(binaries, runs, folder):
    ccx = shutil.which("ccx")
    part = "a shell-and-solid part of the bridge, 10 modes, whole run of either program, one thread"
    if ccx is None:
        return [table.row(part, "CalculiX is not installed", None, "")]
    exchange_models.bridge_part(folder / "part", folder / "s1_model" / "model")
    table.run_child(step(binaries, folder / "shells", "--model", folder / "part", "--set", "n_modes=10", "--export-inp"), cwd=ROOT)
    ours = median_child(step(binaries, folder / "again", "--model", folder / "part", "--set", "n_modes=10", "--threads", "1"), runs, cwd=ROOT)
    theirs = median_child([ccx, "-i", "model"], runs, cwd=folder / "shells")
    return [table.row(part, "elapsed", ours[0], "s", theirs[0], "CalculiX (it expands shells into solids)"),
            table.row(part, "processor time", ours[1], "s", theirs[1], "CalculiX"),
            table.row(part, "peak memory", ours[2], "MB", theirs[2], "CalculiX", aim="> 1")]


def rows(binaries, runs):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        return (modes_of_the_bridge(binaries, runs, folder) + whole_step(binaries, runs, folder) + against_calculix(binaries, runs, folder))
