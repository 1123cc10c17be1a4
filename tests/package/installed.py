"""The product as `make install` lays it out below a temporary folder, and commands that are run there with the source tree out of reach."""
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve().parent


def install(destination):
    """Installs into destination/usr and returns that prefix. Nothing is compiled: the build lies there."""
    done = subprocess.run(["cmake", "--install", BUILD, "--prefix", "/usr"], env={**os.environ, "DESTDIR": str(destination)}, capture_output=True,
                          text=True, timeout=120)
    if done.returncode != 0:
        raise AssertionError(f"cmake --install: {done.stderr}")
    return destination / "usr"


def can_hide():
    """Whether an empty file system can be laid over the source tree for a command (as root, where the kernel allows it)."""
    if os.geteuid() != 0 or not shutil.which("unshare"):
        return False
    return subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "none", ROOT], capture_output=True).returncode == 0


class Place:
    """A folder of the user's, with the installed programs first on the PATH."""

    def __init__(self, prefix, folder, hidden):
        self.prefix, self.folder, self.hidden = prefix, folder, hidden
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, *command, timeout=300):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "PYTHONPATH", "TWINDECK_BIN")}
        environment |= {"PATH": f"{self.prefix}/bin:{os.environ['PATH']}", "PYTHONPATH": str(self.prefix / "lib/python3/dist-packages")}
        if self.hidden:
            command = ["unshare", "-m", "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', ROOT, *command]
        return subprocess.run([*map(str, command)], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=timeout)
