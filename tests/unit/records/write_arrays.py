"""Writes the samples of same_samples_test.cpp as SciPy writes MAT files, and as h5py writes HDF5 where it is installed.

    write_arrays.py FOLDER

The samples: 400 x 4, sample t of channel c is ((37 t + 1001 c) mod 4096 - 2048) / 64.
"""
import pathlib
import sys

import numpy as np
import scipy.io

folder = pathlib.Path(sys.argv[1])
t, c = np.arange(400)[:, None], np.arange(4)[None, :]
samples = ((37 * t + 1001 * c) % 4096 - 2048) / 64.0
names = np.array(["A_x", "B_x", "C_z", "Brücke"], dtype=object)
fs = 128.0
scipy.io.savemat(folder / "scipy_4.mat", {"acc": samples, "fs": fs}, format="4")
for name, compressed in (("scipy_5.mat", False), ("scipy_5_compressed.mat", True)):
    scipy.io.savemat(folder / name, {"acc": samples, "fs": fs}, do_compression=compressed)
scipy.io.savemat(folder / "scipy_5_fortran.mat", {"acc": np.asfortranarray(samples), "fs": fs})
for compressed in (False, True):
    ending = "_compressed.mat" if compressed else ".mat"
    scipy.io.savemat(folder / f"transposed{ending}", {"acc": samples.T, "fs": fs}, do_compression=compressed)
    scipy.io.savemat(folder / f"single{ending}", {"acc": samples.astype(np.float32), "fs": fs}, do_compression=compressed)
    scipy.io.savemat(folder / f"whole{ending}", {"acc": (64 * samples).astype(np.int16), "fs": fs}, do_compression=compressed)
    scipy.io.savemat(folder / f"structure{ending}", {"run": {"fs": fs, "acc": samples, "names": names, "note": "still air"}}, do_compression=compressed)
    vectors = {f"a{k + 1}": samples[:, k:k + 1] for k in range(4)}
    scipy.io.savemat(folder / f"vectors{ending}", {"names": names, "t": np.arange(400)[:, None] / fs, **vectors}, do_compression=compressed)
try:
    import h5py
except ImportError:
    sys.exit(0)
with h5py.File(folder / "h5py.h5", "w") as file:
    data = file.create_dataset("acc", data=samples, compression="gzip")
    data.attrs["fs"] = fs
