"""make bare-root: the packages in a Debian 12 in which nothing else of twindeck is; seconds and exit codes.

    python3 tests/package/bare_root.py PACKAGES OUT [BASE]

PACKAGES: folder of the .deb files; OUT: where steps.csv goes (step, seconds, exit_code, said). BASE: a minimal Debian 12 that is copied; without it
debootstrap makes one. Needs root, and debootstrap. apt and dpkg run in the root as root; what an engineer does runs there as an ordinary user:
a study of one's own from the template to its report, then every command of the tutorial as the installed page has it, with what it is said to print.
Exit code 1 if a step fails.
"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "steps"))
import guide  # noqa: E402

SUITE, MIRROR = "bookworm", "http://deb.debian.org/debian"
USER, HOME = "1000:1000", "/home/engineer"
# Name spaces of their own: what is mounted for a command is gone with it. /proc and /dev are what apt and Python ask for; without
# /dev/pts what a package's script says is an error of input and output.
ENTER = 'mount -t proc proc "$0/proc" && mount --bind /dev "$0/dev" && mount -t devpts devpts "$0/dev/pts" && exec chroot "$@"'
INSTALL = "DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends"


class Root:
    """A Debian below a folder. What is done there is a row."""

    def __init__(self, folder):
        self.folder, self.rows = folder, []

    def enter(self, command, user, where):
        """Runs lines of shell in the root."""
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": HOME if user == USER else "/root", "LC_ALL": "C.UTF-8"}
        environment |= {k: v for k, v in os.environ.items() if k.lower() in ("http_proxy", "https_proxy", "no_proxy")}
        return subprocess.run(["unshare", "-m", "-p", "-f", "sh", "-c", ENTER, self.folder, f"--userspec={user}", self.folder, "sh", "-e", "-c",
                               f"cd {where}\n{command}"], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def runs(self, what, command, user="0:0", where="/"):
        """Runs lines of shell as a row, with what they print last."""
        started = time.monotonic()
        done = self.enter(command, user, where)
        lines = (done.stdout if done.returncode == 0 else done.stderr or done.stdout).strip().splitlines()
        self.add(what, time.monotonic() - started, done.returncode, lines[-1] if lines else "")

    def add(self, what, seconds, code, said):
        self.rows.append([what, f"{seconds:.1f}", code, said])
        print(f"bare-root: {what}: {seconds:.1f} s, exit code {code}" + (f": {said}" if code else ""), flush=True)

    def as_engineer(self, what, command, where=HOME):
        self.runs(what, command, USER, where)


def base(folder, given):
    """A minimal Debian; the source tree is not in it."""
    if given:
        subprocess.run(["cp", "-a", given, folder], check=True)
    else:
        subprocess.run(["debootstrap", "--variant=minbase", SUITE, folder, MIRROR], check=True, stdout=subprocess.DEVNULL)


def install(root, packages):
    """apt installs the packages; then there is a user."""
    (root.folder / "packages").mkdir()
    for file in packages:
        shutil.copy(file, root.folder / "packages")
    root.runs("apt-get update", "apt-get update -qq")
    root.runs("apt-get install ./twindeck.deb", f"{INSTALL} /packages/twindeck_*.deb >/install.log\ngrep -c '^Setting up' /install.log")
    make_home(root)


def make_home(root):
    """Of the ordinary user."""
    home = root.folder / HOME[1:]
    home.mkdir(parents=True)
    os.chown(home, *map(int, USER.split(":")))


def own_study(root):
    root.as_engineer("twindeck --version", "twindeck --version")
    root.as_engineer("twindeck new my_bridge", "twindeck new my_bridge")
    root.as_engineer("twindeck run my_bridge look", "twindeck run my_bridge look && ls results/my_bridge/look/fig_05.png")
    root.as_engineer("twindeck run my_bridge", "twindeck run my_bridge")
    root.as_engineer("the report is there", "stat -c '%s bytes' results/my_bridge/report/report.html")
    root.as_engineer("twindeck run again: nothing to do", "twindeck run my_bridge && twindeck why s9")


def tutorial(root, page):
    """Follows an installed page; what its commands print is compared as make test does in the source tree."""
    started, failed, commands, wrong, printed = time.monotonic(), 0, 0, [], ""
    place = root.folder / HOME[1:] / "tutorial"
    place.mkdir(exist_ok=True)
    for language, name, content in guide.blocks((root.folder / "usr/share/doc/twindeck/docs" / page).read_text(encoding="utf-8")):
        if name:
            (place / name).parent.mkdir(exist_ok=True)
            (place / name).write_text(content, encoding="utf-8")
        for path in (place, *place.rglob("*")):
            os.chown(path, *map(int, USER.split(":")))
        if language == "sh":
            done = root.enter(content, USER, f"{HOME}/tutorial")
            printed, failed, commands = done.stdout, failed or done.returncode, commands + len(content.strip().splitlines())
        elif language == "text":
            wrong += guide.differences(content, printed)
    root.add(f"{page}: {commands} commands", time.monotonic() - started, failed or int(bool(wrong)),
             "; ".join(wrong)[:300] if wrong else "prints what the page says")


def needs_root(given):
    if os.geteuid() != 0 or not shutil.which("unshare") or not (given or shutil.which("debootstrap")):
        raise SystemExit("bare-root: needs root and debootstrap: apt-get install --no-install-recommends debootstrap")


def written(root, file):
    """Writes the rows. @return 1 if a step failed"""
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([["step", "seconds", "exit_code", "said"], *root.rows])
    return int(any(row[2] for row in root.rows))


def main():
    packages, out, given = sorted(pathlib.Path(sys.argv[1]).glob("*.deb")), pathlib.Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else ""
    needs_root(given)
    if not packages:
        raise SystemExit(f"bare-root: no packages in {sys.argv[1]}: make package")
    holder = pathlib.Path(tempfile.mkdtemp(prefix="twindeck_bare_"))
    try:
        root = Root(holder / "root")
        base(root.folder, given)
        install(root, packages)
        own_study(root)
        root.runs("python3-numpy, python3-scipy for the tutorial's scripts", f"{INSTALL} python3-numpy python3-scipy >/dev/null")
        tutorial(root, "tutorial.md")
        tutorial(root, "tutorial_diagnosis.md")
        root.runs("apt-get install ./twindeck-data.deb", f"{INSTALL} /packages/twindeck-data_*.deb >/dev/null")
        root.as_engineer("twindeck studies, copy, check", "mkdir study && cd study && twindeck studies && twindeck copy ponte_del_mare && twindeck run ponte_del_mare check")
        root.as_engineer("twindeck run ponte_del_mare look", "twindeck run ponte_del_mare look", f"{HOME}/study")
        root.runs("apt-get remove twindeck", "apt-get remove -y -qq twindeck >/dev/null && ! ls /usr/bin/twindeck /usr/share/twindeck/Makefile 2>/dev/null")
    finally:
        shutil.rmtree(holder)
    return written(root, out / "steps.csv")


if __name__ == "__main__":
    sys.exit(main())
