"""The same modes by the peers: programs that read K and M from a folder and print seconds, memory and frequencies."""
import pathlib
import subprocess
import sys

import table

FROM_NPY = """
import sys
import numpy as np, scipy.sparse as sp
def matrix(name):
    values, rows, begins = (np.load(f"{sys.argv[1]}/{name}_{part}.npy")[:, 0] for part in ("values", "rows", "begins"))
    n = len(begins) - 1
    lower = sp.csc_matrix((values, rows.astype(np.int32), begins.astype(np.int32)), (n, n))
    return (lower + sp.tril(lower, -1).T).tocsc()
"""
FROM_MATRIX_MARKET = """
import sys
import scipy.io
def matrix(name):
    return scipy.io.mmread(f"{sys.argv[1]}/{name}.mtx").tocsc()
"""
SHOW = """
import resource, time
k, m = matrix("K"), matrix("M")
def show(seconds, values):
    print("modes_s", seconds)
    print("peak_MB", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    for i, value in enumerate(sorted(values)[:15]):
        print(f"frequency_{i + 1}_Hz", value ** 0.5 / 6.283185307179586)
"""
SCIPY = SHOW + """
import scipy.sparse.linalg
start = time.process_time()
values = scipy.sparse.linalg.eigsh(k, 15, m, sigma=0.0, which="LM", return_eigenvectors=True)[0]
show(time.process_time() - start, values)
"""
SLEPC = SHOW + """
from petsc4py import PETSc
from slepc4py import SLEPc
def petsc(a):
    a = a.tocsr()
    one = PETSc.Mat().createAIJ(a.shape, csr=(a.indptr, a.indices, a.data))
    one.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    one.setOption(PETSc.Mat.Option.SPD, True)
    return one
k, m = petsc(k), petsc(m)
start = time.process_time()
solver = SLEPc.EPS().create()
solver.setOperators(k, m)
solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
solver.setDimensions(15)
solver.setTarget(0.0)
solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
shift = solver.getST()
shift.setType(SLEPc.ST.Type.SINVERT)
shift.getKSP().setType("preonly")
shift.getKSP().getPC().setType("cholesky")
shift.getKSP().getPC().setFactorSolverType("mumps")
solver.setFromOptions()
solver.solve()
show(time.process_time() - start, [solver.getEigenvalue(i).real for i in range(solver.getConverged())])
"""


def environment():
    """One thread; and where Debian's python3-slepc4py finds itself without the development packages of PETSc and SLEPc."""
    found = {name: sorted(pathlib.Path("/usr/lib").glob(pattern)) for name, pattern in (("PETSC_DIR", "petscdir/petsc*/*-real"), ("SLEPC_DIR", "slepcdir/slepc*/*-real"))}
    return table.ONE_THREAD | {name: str(folders[-1]) for name, folders in found.items() if folders}


def modes(matrices):
    """{program: script} of the peers that are installed; matrices: how the folder holds K and M (FROM_NPY, FROM_MATRIX_MARKET)."""
    found = {"SciPy eigsh": matrices + SCIPY}
    if subprocess.run([sys.executable, "-c", "import slepc4py"], capture_output=True, env=environment()).returncode == 0:
        found["SLEPc, MUMPS"] = matrices + SLEPC
    else:
        print("bench: SLEPc is not here and left out: apt-get install --no-install-recommends python3-slepc4py python3-mpi4py", file=sys.stderr)
    return found
