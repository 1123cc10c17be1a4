"""The strong earthquakes in two parts: windows.py CAMPAIGN OUT writes a campaign in which each of them is its strong part (5 to 95 % of the
squared acceleration of the deck's middle, and the second before) and what follows; the weak ones stay whole.

A model that is identified from a whole record is a mean over strong and weak motion. Here each part is identified by itself, and its
amplitude is that of the samples it was identified from."""
import pathlib
import shutil
import sys
import tomllib

import numpy as np

from campaign import write_record
from make_model import MIDDLE

STRONG = ("nov1987_237", "oct1979_484", "dec2009_498")
LEAD_S, LEAST_S = 1.0, 9.0  # least: 25 periods


def main(campaign, out):
    out.mkdir(parents=True, exist_ok=True)
    shutil.copy(campaign / "channels.csv", out)
    with open(campaign / "campaign.toml", "rb") as stream:
        records = tomllib.load(stream)["record"]
    text, conditions = "", ""
    for record in records:
        samples, rate = np.load(campaign / record["file"]), record["sampling_rate_Hz"]
        parts = {record["condition"]: samples}
        if record["condition"] in STRONG:
            middle = samples[:, record["channels"].index(MIDDLE)]
            grown = np.cumsum((middle - middle.mean()) ** 2)
            first, last = np.searchsorted(grown, (0.05 * grown[-1], 0.95 * grown[-1]))
            parts = {"strong": samples[max(0, first - round(LEAD_S * rate)) : last], "after": samples[last:]}
            parts = {f"{record['condition']}_{name}": part for name, part in parts.items() if len(part) >= LEAST_S * rate}
        for name, part in parts.items():
            text += write_record(out, name, part, rate, record["channels"])
            conditions += f"[{name}]\n"
    (out / "campaign.toml").write_text(text)
    (out / "conditions.toml").write_text(conditions)


if __name__ == "__main__":
    main(*(pathlib.Path(a) for a in sys.argv[1:3]))
