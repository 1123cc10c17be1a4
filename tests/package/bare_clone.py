"""make bare-root FROM=clone: a clone in a Debian 12 in which nothing else is, to the first figure of a bridge of one's own; seconds and exit codes.

    python3 tests/package/bare_clone.py OUT [BASE]

OUT: where clone_steps.csv goes (step, seconds, exit_code, said). BASE: as in bare_root.py. The committed tree is cloned. Packages are installed as
root by `make deps`; the rest is done as an ordinary user. Exit code 1 if a step fails.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

import bare_root

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLONE = f"{bare_root.HOME}/twindeck"


def from_clone(root):
    root.runs("apt-get update, apt-get install git make", f"apt-get update -qq\n{bare_root.INSTALL} git make >/dev/null")
    root.as_engineer("git clone", f"git clone -q /srv/twindeck.git {CLONE}")
    root.runs("make deps", "make deps", where=CLONE)
    root.as_engineer("make look: step 1 is compiled, the study's first figure", "make look", CLONE)
    root.as_engineer("make new STUDY=my_bridge", "make new STUDY=my_bridge", CLONE)
    root.as_engineer("make look STUDY=my_bridge: the first figure of one's own", "make look STUDY=my_bridge", CLONE)
    root.as_engineer("make all STUDY=my_bridge: the other steps are compiled", "make all STUDY=my_bridge", CLONE)
    root.as_engineer("the report is there", "stat -c '%s bytes' results/my_bridge/report/report.html", CLONE)


def main():
    bare_root.needs_root(given := sys.argv[2] if len(sys.argv) > 2 else "")
    holder = pathlib.Path(tempfile.mkdtemp(prefix="twindeck_bare_"))
    try:
        root = bare_root.Root(holder / "root")
        bare_root.base(root.folder, given)
        bare_root.make_home(root)
        subprocess.run(["git", "clone", "-q", "--bare", "--no-hardlinks", str(ROOT), str(root.folder / "srv/twindeck.git")], check=True)
        subprocess.run(["chown", "-R", bare_root.USER, str(root.folder / "srv")], check=True)  # git refuses another user's
        from_clone(root)
    finally:
        shutil.rmtree(holder)
    return bare_root.written(root, pathlib.Path(sys.argv[1]) / "clone_steps.csv")


if __name__ == "__main__":
    sys.exit(main())
