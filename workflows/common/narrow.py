"""A model as a fit leaves it, as what a diagnosis starts from: narrow.py MODEL OUT

Each parameter keeps its fitted value and may move by 20 % (prior deviation 10 %) about it: that is what one test of a structure differs from
another by (temperature, moisture, what the soil went through before, joints that settle), and several times what the fit leaves open of the
frequency. A cause that acts on a part scales it as the model has it before any fit, so that a factor means a ratio to the fitted part
as long as the part stays near that."""
import pathlib
import re
import shutil
import sys

REACH = 0.2

if __name__ == "__main__":
    model, out = map(pathlib.Path, sys.argv[1:3])
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(model, out)
    text, value = "", 1.0
    for line in (model / "model.toml").read_text(encoding="utf-8").splitlines(keepends=True):
        if found := re.match(r"initial *= *(\S+)", line):
            value = float(found[1])
        line = re.sub(r"^lower *=.*", lambda _: f"lower = {(1.0 - REACH) * value:.12g}", line)
        text += re.sub(r"^upper *=.*", lambda _: f"upper = {(1.0 + REACH) * value:.12g}", line)
    (out / "model.toml").write_text(text, encoding="utf-8")
